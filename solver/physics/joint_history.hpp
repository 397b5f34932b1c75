#pragma once

#include "physics/active_joint.hpp"
#include "physics/joint_evaluation.hpp"

namespace breccia::joint_point {

/// The same in the form of the templates over the number type, and back.
[[nodiscard]] Point<double> point_of(const JointPointHistory& history);
[[nodiscard]] JointPointHistory history_of(const Point<double>& point);
[[nodiscard]] Joint<double> joint_of(const ActiveJoint& joint);
/// The numbers of an evaluation; state, time and identity stay as they are.
void set_numbers(const Joint<double>& numbers, ActiveJoint& joint);
[[nodiscard]] Vector<double> vector_of(const Vec3& v);
[[nodiscard]] Vec3 vector_of(const Vector<double>& v);

}  // namespace breccia::joint_point
