#pragma once

#include <optional>

#include "base/error.hpp"
#include "model/model.hpp"

namespace breccia {

// The joints of a model under construction, in the order in which they are called; mesh, topology, materials and names
// are there already.

/// Of the whole model: WholeModel::joint_groups, in the order of their first joints, and num_joints.
/// Throws InputError with every pair of groups that is glued and has no [[joint]]. O(elements).
void find_joint_groups(const case_::Case& input, Model& model);

/// The problem of a pair of groups that joints hold together, without a [[joint]] or with two that fit alike; nullopt:
/// it has one.
[[nodiscard]] std::optional<Problem> wrong_joint_law(const case_::Case& input, const std::vector<std::string>& names,
                                                     const WholeModel::JointGroups& groups);

/// Model::joint_laws with their names and sizes; the groups of interfaces that break are breakable. Throws InputError
/// with every law that makes no sense.
void take_joint_laws(const case_::Case& input, Model& model);

/// Model::joints. O(elements).
void take_joints(const case_::Case& input, Model& model);

}  // namespace breccia
