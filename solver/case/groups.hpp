#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "case/case.hpp"

namespace breccia::case_ {

// Entries of pairs of groups, in [[joint]] and [[contact]].

[[nodiscard]] inline bool fits(const std::string& pattern, const std::string& group) {
  return pattern == every_group || pattern == group;
}
/// Whether an entry fits two groups, in any order. @param patterns  of the entry
[[nodiscard]] inline bool fits(const std::array<std::string, 2>& patterns, const std::string& a, const std::string& b) {
  return (fits(patterns[0], a) && fits(patterns[1], b)) || (fits(patterns[0], b) && fits(patterns[1], a));
}
/// How many groups an entry names; the one that names more goes before the other.
[[nodiscard]] inline int num_named(const std::array<std::string, 2>& patterns) {
  return (patterns[0] != every_group ? 1 : 0) + (patterns[1] != every_group ? 1 : 0);
}

/// The material of a volume group: its own entry, else the one of "*"; nullptr: none.
[[nodiscard]] const Material* material_of(const Case& input, const std::string& group);

/// The number of a gauge "body N", as frames count bodies; -1 for other names.
[[nodiscard]] std::int64_t numbered_body(const std::string& name);

}  // namespace breccia::case_
