#include "case/joint_entries.hpp"

#include <algorithm>

namespace breccia::case_ {
namespace {

bool fits(const std::string& pattern, const std::string& group) { return pattern == every_group || pattern == group; }

bool fits(const Joint& entry, const std::string& a, const std::string& b) {
  if (entry.inside() != (a == b)) return false;
  return (fits(entry.groups[0], a) && fits(entry.groups[1], b)) ||
         (fits(entry.groups[0], b) && fits(entry.groups[1], a));
}

auto names_in(const Joint& entry) {
  return std::count_if(entry.groups.begin(), entry.groups.end(), [](const auto& name) { return name != every_group; });
}

}  // namespace

JointEntry joint_entry(const Case& input, const std::string& a, const std::string& b) {
  JointEntry found;
  for (const Joint& entry : input.joints) {
    if (!fits(entry, a, b)) continue;
    if (found.ruling == nullptr || names_in(entry) > names_in(*found.ruling))
      found = {&entry, nullptr};
    else if (names_in(entry) == names_in(*found.ruling))
      found.tied = &entry;
  }
  return found;
}

Joint joint_between(const Case& input, const Joint& entry, const std::string& a, const std::string& b) {
  Joint joint = entry;
  joint.groups = {a, b};
  if (joint.penalty_factor > 0) joint.penalty = joint.penalty_factor * smallest_young(input, joint.groups);
  return joint;
}

double smallest_young(const Case& input, const std::array<std::string, 2>& groups) {
  double smallest = 0;
  for (const Material& m : input.materials)
    if ((m.group == groups[0] || m.group == groups[1]) && (smallest == 0 || m.young < smallest)) smallest = m.young;
  return smallest;
}

}  // namespace breccia::case_
