#pragma once

#include <array>

#include "base/types.hpp"
#include "physics/joint_history.hpp"
#include "physics/joint_law_params.hpp"

namespace breccia {

/// Axes of a joint: n from a to b and two in the mid-surface that turn with it. The slip is kept in the latter, so that
/// no rigid rotation, not even about n, changes the friction.
struct JointFrame {
  Vec3 normal{0, 0, 0};
  std::array<Vec3, 2> tangent{Vec3::Zero(), Vec3::Zero()};  ///< read only where law.friction > 0
};

/// One evaluation of a point.
struct JointPointResponse {
  Vec3 traction{0, 0, 0};                                    ///< Pa, on side a
  double mode_1 = 0, mode_2 = 0, friction = 0, viscous = 0;  ///< J/m2 dissipated since the last evaluation
  bool elastic = true;                                       ///< undamaged with linear rise: traction = k opening
};

/// Traction at a point; brings its history up to date.
///
/// What is dissipated is what the law itself dissipates, none of it ever negative: mode 1 and 2 -dU/dd times the growth
/// of the damage, U the energy stored normal and along the joint, at the opening at which the stiffness was lost
/// (LossOpenings in joint_growth.hpp); friction tau_f . ds of the slip; viscous the work of the viscous traction of
/// damaged points. Work less stored energy differs from that by the error of the steps, which the budget shows.
///
/// @param frame  unit vectors.  No allocation, throws nothing. exp only where damage may grow.
[[nodiscard]] JointPointResponse evaluate_point(const JointLawParams& law, const JointFrame& frame, const Vec3& opening,
                                                JointPointHistory<double>& history);

}  // namespace breccia
