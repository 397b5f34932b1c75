#include "physics/joint_history.hpp"

namespace breccia::joint_point {

Vector<double> vector_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

Vec3 vector_of(const Vector<double>& v) { return {v[0], v[1], v[2]}; }

Point<double> point_of(const JointPointHistory& h) {
  return {.damage = h.damage,
          .level = h.level,
          .left = h.left,
          .secant_normal = h.secant_normal,
          .secant_shear = h.secant_shear,
          .memory = h.fresh   ? kFresh
                    : h.whole ? kWhole
                    : h.gone  ? kGone
                              : kSplit,
          .slip = {h.slip[0], h.slip[1]},
          .friction_weight = h.friction_weight,
          .friction_traction = {h.friction_traction[0], h.friction_traction[1]},
          .opening = vector_of(h.opening),
          .traction = vector_of(h.traction),
          .normal_opening = h.normal_opening,
          .normal_traction = h.normal_traction,
          .stored_normal = h.stored_normal,
          .stored_shear = h.stored_shear,
          .stored_friction = h.stored_friction};
}

JointPointHistory history_of(const Point<double>& p) {
  return {.damage = p.damage,
          .level = p.level,
          .left = p.left,
          .secant_normal = p.secant_normal,
          .secant_shear = p.secant_shear,
          .slip = {p.slip[0], p.slip[1], 0.0},
          .fresh = p.memory == kFresh,
          .whole = p.memory == kWhole,
          .gone = p.memory == kGone,
          .friction_weight = p.friction_weight,
          .friction_traction = {p.friction_traction[0], p.friction_traction[1]},
          .opening = vector_of(p.opening),
          .traction = vector_of(p.traction),
          .normal_opening = p.normal_opening,
          .normal_traction = p.normal_traction,
          .stored_normal = p.stored_normal,
          .stored_shear = p.stored_shear,
          .stored_friction = p.stored_friction};
}

Joint<double> joint_of(const ActiveJoint& joint) {
  return {.points = {point_of(joint.points[0]), point_of(joint.points[1]), point_of(joint.points[2])},
          .area = joint.area,
          .mode_1 = joint.mode_1,
          .mode_2 = joint.mode_2,
          .friction = joint.friction,
          .tilt = vector_of(joint.tilt),
          .normal = vector_of(joint.normal),
          .turned = joint.turned ? 1.0 : 0.0,
          .failed = joint.state == JointState::failed ? 1.0 : 0.0};
}

void set_numbers(const Joint<double>& numbers, ActiveJoint& joint) {
  for (std::size_t i = 0; i < 3; ++i) joint.points[i] = history_of(numbers.points[i]);
  joint.area = numbers.area;
  joint.mode_1 = numbers.mode_1;
  joint.mode_2 = numbers.mode_2;
  joint.friction = numbers.friction;
  joint.tilt = vector_of(numbers.tilt);
  joint.normal = vector_of(numbers.normal);
  joint.turned = numbers.turned > 0;
}

}  // namespace breccia::joint_point
