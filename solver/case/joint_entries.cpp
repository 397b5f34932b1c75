#include "case/joint_entries.hpp"

#include "case/groups.hpp"

namespace breccia::case_ {

JointEntry joint_entry(const Case& input, const std::string& a, const std::string& b) {
  JointEntry found;
  for (const Joint& entry : input.joints) {
    if (entry.inside() != (a == b) || !fits(entry.groups, a, b)) continue;
    if (found.ruling == nullptr || num_named(entry.groups) > num_named(found.ruling->groups))
      found = {&entry, nullptr};
    else if (num_named(entry.groups) == num_named(found.ruling->groups))
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
  for (const std::string& group : groups) {
    const Material* m = material_of(input, group);
    if (m != nullptr && (smallest == 0 || m->young < smallest)) smallest = m->young;
  }
  return smallest;
}

}  // namespace breccia::case_
