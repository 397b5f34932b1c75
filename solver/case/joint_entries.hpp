#pragma once

#include <string>

#include "case/case.hpp"

namespace breccia::case_ {

/// Entry of a case for the joints between two groups, or inside one.
struct JointEntry {
  const Joint* ruling = nullptr;  ///< of those that fit the first that names most groups; null: none fits
  const Joint* tied = nullptr;    ///< another one that names as many; null: there is none
};
/// @param a, b  names of groups, equal for the joints inside one
[[nodiscard]] JointEntry joint_entry(const Case& input, const std::string& a, const std::string& b);

/// The law of an entry for two groups that it fits: Joint::groups are these, Joint::penalty is known.
[[nodiscard]] Joint joint_between(const Case& input, const Joint& entry, const std::string& a, const std::string& b);

/// The least Young's modulus of the two groups, Pa; 0: neither has a material.
[[nodiscard]] double smallest_young(const Case& input, const std::array<std::string, 2>& groups);

}  // namespace breccia::case_
