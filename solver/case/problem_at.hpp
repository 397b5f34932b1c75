#pragma once

#include <string>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// What is wrong with a key of an entry of the case. @param name  of the key; empty: of the entry itself
[[nodiscard]] inline Problem problem_at(const Case& c, const Origin& origin, const std::string& name,
                                        const std::string& what, const std::string& allowed, const std::string& given) {
  const std::string key = origin.key.empty() || name.empty() ? origin.key + name : origin.key + "." + name;
  return {c.file.string(), origin.line, key, what, allowed, given};
}

}  // namespace breccia::case_
