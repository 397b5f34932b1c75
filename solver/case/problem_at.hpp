#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// Where a key of an entry was written; the key around it, else the entry, where it is not known.
/// @param file  of the case
[[nodiscard]] inline KeyPlace place_of(const std::filesystem::path& file, const Origin& origin, std::string name) {
  while (!name.empty()) {
    const auto found = origin.keys.find(name);
    if (found != origin.keys.end()) return found->second;
    const std::size_t inner = name.find_last_of(".[");
    name.resize(inner == std::string::npos ? 0 : inner);
  }
  return {file.string(), origin.line};
}

/// What is wrong with a key of an entry of the case. @param name  of the key; empty: of the entry itself
[[nodiscard]] inline Problem problem_at(const std::filesystem::path& file, const Origin& origin,
                                        const std::string& name, const std::string& what, const std::string& allowed,
                                        const std::string& given) {
  const std::string key = origin.key.empty() || name.empty() ? origin.key + name : origin.key + "." + name;
  const KeyPlace place = place_of(file, origin, name);
  return {place.file, place.line, key, what, allowed, given};
}
[[nodiscard]] inline Problem problem_at(const Case& c, const Origin& origin, const std::string& name,
                                        const std::string& what, const std::string& allowed, const std::string& given) {
  return problem_at(c.file, origin, name, what, allowed, given);
}

}  // namespace breccia::case_
