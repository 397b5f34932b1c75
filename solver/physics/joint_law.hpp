#pragma once

#include <string>

#include "base/types.hpp"
#include "physics/softening.hpp"

namespace breccia {

enum class JointLaw {
  mixed_mode,        ///< one history a point, elliptic onset, energies interpolated in mixed mode; numerics of the default
  independent_peaks  ///< each component has its own peak, damage is shared: the published law
};
enum class JointRise { linear, parabolic };
enum class JointPoints { nodal, mid_edge };

/// Cohesive law of a joint. Opening delta = x_b - x_a, m; n points from a to b; delta_n = delta . n, tension positive;
/// traction t acts on side a, -t on side b, Pa. Damage never heals. Compression is elastic: sigma = k delta_n, undamaged.
///
/// mixed_mode, history d (0..1):
///   d_nt = f_t/k, d_st = f_s/k,  f_s = c + tan(phi) <-sigma>  (Mohr-Coulomb)
///   x_n = <delta_n>/d_nt, x_s = |delta_s|/d_st, r = sqrt(x_n^2 + x_s^2);  nothing happens while r <= 1
///   D = (r-1)/r^2 (x_n^2 d_nt/D_n + x_s^2 d_st/D_s),  d_trial = D >= 1 ? 1 : 1 - z(D)/r,  d = max(d, d_trial)
///   sigma = (1-d) k delta_n (open), k delta_n (closed);  tau = (1-d) k delta_s + d tau_f
/// with softening widths D_n = (G_I - g f_t^2/(2k))/(A f_t) and D_s likewise, g = 1 if the energies are those of the
/// whole curve, 0 if of the softening branch, A the area under z. Unloading goes to the origin.
/// tau_f: Coulomb friction of the damaged share, an elastic-slip spring k (delta_s - s) limited to tan(phi) <-sigma>.
///
/// independent_peaks: sigma and tau rise to f_t and f_s on their own (linear: at f/k; parabolic: at 2 f/k),
///   D = sqrt((<delta_n - d_nt>/D_n)^2 + (<|delta_s| - d_st>/D_s)^2), both are multiplied by z(largest D); unloading to the
///   origin; the same friction with weight 1 - z.
/// Source: [Schiava 2012, 3.5]; mixed mode after [Camanho 2003]; friction after [Alfano 2006].
struct JointLawParams {
  JointLaw law = JointLaw::mixed_mode;
  JointRise rise = JointRise::linear;
  JointPoints points = JointPoints::nodal;
  double stiffness = 0;           ///< k = p/h, Pa/m
  double tensile_strength = 0;    ///< f_t, Pa; infinite: unbreakable
  double cohesion = 0;            ///< c, Pa: shear strength without pressure
  double friction = 0;            ///< tan(phi)
  double energy_mode_1 = 0;       ///< J/m2
  double energy_mode_2 = 0;       ///< J/m2
  bool energy_of_whole_curve = true;
  Softening softening;
  int points_to_fail = 3;

  // Derived by `prepare`.
  double area = 0;                ///< A, under the softening curve
  double onset_normal = 0;        ///< d_nt, m
  double width_normal = 0;        ///< D_n, m
  double screen = 0;              ///< m2

  /// Squared opening up to which the joint is linear elastic whatever its direction; 0: never surely.
  [[nodiscard]] double screen_limit() const { return screen; }
  [[nodiscard]] bool breakable() const;
};

/// Derives what the kernels need. Returns what is wrong with the parameters, empty if nothing: an energy that the
/// elastic part alone exceeds, a softening curve that is none.
[[nodiscard]] std::string prepare(JointLawParams& law);

/// Stiffness of one corner of a joint's face, N/m: k A0 / 3.
[[nodiscard]] inline double corner_stiffness(const JointLawParams& law, double area) { return law.stiffness * area / 3.0; }

/// What a point of a joint remembers.
struct JointPointHistory {
  double damage = 0;          ///< mixed_mode: d; independent_peaks: largest D
  double largest_normal = 0;  ///< m, largest opening (independent_peaks)
  double largest_shear = 0;   ///< m
  Vec3 slip{0, 0, 0};         ///< m, s
  // For the work of the next step.
  Vec3 opening{0, 0, 0};      ///< m
  Vec3 traction{0, 0, 0};     ///< Pa
  double normal_opening = 0, normal_traction = 0;
  Vec3 shear_opening{0, 0, 0}, friction_traction{0, 0, 0};
  double stored_normal = 0, stored_shear = 0, stored_friction = 0;  ///< J/m2
};

/// One evaluation of a point.
struct JointPointResponse {
  Vec3 traction{0, 0, 0};   ///< Pa, on side a
  double mode_1 = 0, mode_2 = 0, friction = 0;  ///< J/m2 dissipated since the last evaluation
  bool elastic = true;      ///< undamaged: traction = k opening
};

/// Traction at a point; brings its history up to date. Dissipation = trapezoidal work since the last evaluation minus the
/// change of stored energy: it closes the energy budget for any step, and tends to the law's own dissipation as steps shrink.
/// @param normal  unit vector from a to b.  No allocation, throws nothing.
[[nodiscard]] JointPointResponse evaluate_point(const JointLawParams& law, const Vec3& normal, const Vec3& opening,
                                                JointPointHistory& history);

/// Ratio r of an opening to the elastic limit in its direction; above 1 the mixed-mode law takes damage. 0 if unbreakable.
[[nodiscard]] double onset_ratio(const JointLawParams& law, const Vec3& normal, const Vec3& opening);

/// True once nothing is left of the cohesion at this point.
[[nodiscard]] inline bool exhausted(const JointPointHistory& history) { return history.damage >= 1.0; }

}  // namespace breccia
