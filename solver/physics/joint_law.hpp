#pragma once

#include <array>
#include <string>

#include "base/types.hpp"
#include "physics/softening.hpp"

namespace breccia {

enum class JointLaw {
  mixed_mode,        ///< one history a point, elliptic onset, energies interpolated in mixed mode: the default
  independent_peaks  ///< each component has its own peak, damage is shared: the published law
};
enum class JointRise { linear, parabolic };
enum class JointPoints { nodal, mid_edge };

/// Cohesive law of a joint. Opening delta = x_b - x_a, m; n points from a to b; delta_n = delta . n, tension positive;
/// delta_s = delta - delta_n n; traction t acts on side a, -t on side b, Pa: tension pulls the sides together. One
/// stiffness k for both components: mixed_mode's t is parallel to delta wherever the joint is open. Compression is
/// elastic: sigma = k delta_n, p = <-sigma> its pressure. Damage never heals. A is the area under z(D).
///
/// mixed_mode, history d (0..1); mu = tan(phi); the shear strength is Mohr-Coulomb's, f_s = c + mu p:
///   d_nt = f_t/k, d_st = f_s/k, x_n = <delta_n>/d_nt, x_s = |delta_s|/d_st, r = sqrt(x_n^2 + x_s^2)
///   elastic while r <= 1, then D = (r-1)/r^2 (x_n^2 d_nt/D_n + x_s^2 d_st/D_s),  d = max(d, 1 - z(D)/R) (1 if D >= 1)
///   R = r where open, (k |delta_s| - mu p)/c under pressure
///   sigma = (1-d) k delta_n (open), tau = (1-d) k delta_s + d tau_f
/// with widths D_n = (G_I - g f_t^2/(2k))/(A f_t) and D_s = (G_II - g c^2/(2k))/(A c), g = 1 if the energies are those
/// of the whole curve, 0 if of the softening branch. Unloading goes to the origin.
/// tau_f = k (delta_s - s): Coulomb friction of the damaged share, its slip s such that |tau_f| <= mu p.
/// With this R the curve under constant pressure is tau = z c + mu p while it slides: peak c + mu p, residual mu p, and
/// work = G_II + mu p |s| + what the friction spring holds, exactly. R = r there would let the damaged share's friction
/// come on top of a cohesive part that contains it already, with peaks of up to 1.4 (c + mu p).
///
/// independent_peaks, histories D, s_n, s_s: sigma rises to f_t and tau to f_s on their own (linear: at f/k;
///   parabolic: at 2 f/k), D = max(D, sqrt((<delta_n - d_nt>/D_n)^2 + (<|delta_s| - d_st>/D_s)^2)); z(D) multiplies both.
///   A component that has passed its peak follows its secant: sigma = z s_n k delta_n, tau = z s_s k delta_s with s_n
///   the least of f_t/(k delta_n) and s_s the least of c/(k |delta_s| - mu p) so far. The same friction with weight
///   1 - z s_s; none with the parabolic rise.
/// Both laws have a stored energy whose derivative is the traction and whose parameters only ever lower it, so no
/// closed loop creates energy.
/// Source: [Schiava, 3.5]; mixed mode after [Camanho 2003]; friction after [Alfano 2006].
struct JointLawParams {
  JointLaw law = JointLaw::mixed_mode;
  JointRise rise = JointRise::linear;
  JointPoints points = JointPoints::nodal;
  double stiffness = 0;         ///< k = p/h, Pa/m
  double tensile_strength = 0;  ///< f_t, Pa; infinite: unbreakable
  double cohesion = 0;          ///< c, Pa: shear strength without pressure
  double friction = 0;          ///< mu
  double energy_mode_1 = 0;     ///< G_I, J/m2
  double energy_mode_2 = 0;     ///< G_II, J/m2
  bool energy_of_whole_curve = true;
  Softening softening;
  int points_to_fail = 3;

  // Derived by `prepare`.
  SofteningCurve curve;
  double area = 0;          ///< A
  double onset_normal = 0;  ///< d_nt, m
  double onset_shear = 0;   ///< d_st without pressure, m
  double width_normal = 0;  ///< D_n, m
  double width_shear = 0;   ///< D_s, m
  double screen = 0;        ///< m2

  /// Squared opening up to which the joint is linear elastic whatever its direction, so that the sweep can evaluate it;
  /// 0: the sweep does not know this law.
  [[nodiscard]] double screen_limit() const { return screen; }
  [[nodiscard]] bool breakable() const;
};

/// Derives what the kernels need. Returns what is wrong with the parameters, empty if nothing: numbers out of range, an
/// energy below what the elastic part alone holds, a softening curve that is none, a combination without meaning.
[[nodiscard]] std::string prepare(JointLawParams& law);

/// Stiffness of one corner of a joint's face, N/m: k A0 / 3.
[[nodiscard]] inline double corner_stiffness(const JointLawParams& law, double area) {
  return law.stiffness * area / 3.0;
}

/// Axes of a joint: n from a to b and two in the mid-surface that turn with it. The slip is kept in the latter, so that
/// no rigid rotation, not even about n, changes the friction.
struct JointFrame {
  Vec3 normal{0, 0, 0};
  std::array<Vec3, 2> tangent{Vec3::Zero(), Vec3::Zero()};  ///< read only where law.friction > 0
};

/// What a point of a joint remembers.
struct JointPointHistory {
  double damage = 0;         ///< mixed_mode: d; independent_peaks: D. Set to 1 from outside it breaks the point by hand
  double level = 0;          ///< D at which the damage grew last
  double left = 1;           ///< z there
  double secant_normal = 1;  ///< s_n, s_s (independent_peaks)
  double secant_shear = 1;
  Vec3 slip{0, 0, 0};  ///< m, s along the two tangents; the third component is unused
  // The last evaluation, for the work of the next step.
  bool fresh = true;   ///< never evaluated
  bool whole = false;  ///< by evaluate_elastic_point: parts along the normal are missing, stored_normal holds all energy
  bool gone = false;  ///< nothing was left of the cohesion
  double friction_weight = 0;
  std::array<double, 2> friction_traction{0, 0};                    ///< Pa, weighted, along the tangents
  Vec3 opening{0, 0, 0};                                            ///< m
  Vec3 traction{0, 0, 0};                                           ///< Pa
  double normal_opening = 0, normal_traction = 0;                   ///< m, Pa
  double stored_normal = 0, stored_shear = 0, stored_friction = 0;  ///< J/m2

  [[nodiscard]] double stored() const { return stored_normal + stored_shear + stored_friction; }
  /// Length of the shear opening, m.
  [[nodiscard]] double shear_opening() const;
};

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
                                                JointPointHistory& history);

/// The same for a point without damage that the caller knows to be elastic, without a frame. Returns the traction on side a.
inline Vec3 evaluate_elastic_point(const JointLawParams& law, const Vec3& opening, JointPointHistory& history) {
  history.fresh = false;
  history.whole = true;
  history.opening = opening;
  history.traction = law.stiffness * opening;
  history.stored_normal = 0.5 * law.stiffness * opening.squaredNorm();
  history.stored_shear = 0;
  return history.traction;
}

}  // namespace breccia
