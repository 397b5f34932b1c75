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

/// Length of the shear opening at the last evaluation, m.
[[nodiscard]] double shear_opening(const JointPointHistory<double>& point);

/// One evaluation of a point.
struct JointPointResponse {
  Vec3 traction{0, 0, 0};                       ///< Pa, on side a
  double mode_1 = 0, mode_2 = 0, friction = 0;  ///< J/m2 dissipated since the last evaluation
  bool elastic = true;                          ///< undamaged with linear rise: traction = k opening
};

/// Traction at a point; brings its history up to date.
///
/// Dissipated energy = trapezoidal work since the last evaluation - change of the stored energy, so the budget of
/// central differences closes for any step. By mode: the normal component; the shear component; of the latter, friction
/// is the weighted friction traction times the slip. Once the cohesion is gone everything left is friction. As steps
/// shrink this tends to the law's own dissipation, which is never negative; a damaged joint that passes from closed to
/// open within one step books 1/2 d k |delta_n| delta_n' of it with the wrong sign, and gets it back when it closes.
///
/// First evaluation: the joint was elastic before, where nobody remembers. If this one takes damage, the path is taken
/// to have come along the ray of the opening, with which everything up to the elastic limit is stored and only what
/// lies beyond is booked. Against the real last position delta_0 this is off by 1/2 d k delta . (delta_0 - delta_limit)
/// a point and life: second order in the step, once.
///
/// @param frame  unit vectors.  No allocation, throws nothing. exp only where damage may grow.
[[nodiscard]] JointPointResponse evaluate_point(const JointLawParams& law, const JointFrame& frame, const Vec3& opening,
                                                JointPointHistory<double>& history);

}  // namespace breccia
