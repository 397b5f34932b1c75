#pragma once

#include <string>

#include "physics/softening.hpp"

namespace breccia {

enum class JointLaw {
  mixed_mode,        ///< one history a point, elliptic onset, energies interpolated in mixed mode: the default
  independent_peaks  ///< each component has its own peak, damage is shared: the published law
};
enum class JointRise { linear, parabolic };
enum class JointPoints { nodal, mid_edge };

/// c of the viscous traction c k' (delta_n - delta_n before) in damaged points: their damping is that share of the
/// critical one times omega dt / 2 at frequency omega, so it vanishes with the step. With 0.02 a cube of damaged joints
/// already gains no energy at 0.8 of the stable step; more than 0.1 would shorten that step by more than a tenth.
inline constexpr double kJointViscosity = 0.05;

// What sets laws apart, decided for each of them. Inlined everywhere, since units of wider instruction sets call them
// too.

/// Opening at the peak over strength / k.
[[gnu::always_inline]] constexpr double peak_factor(JointRise rise) {
  switch (rise) {
    case JointRise::linear:
      return 1.0;
    case JointRise::parabolic:
      return 2.0;
  }
  __builtin_unreachable();
}

/// Whether the traction before the peak is k delta.
[[gnu::always_inline]] constexpr bool rises_linearly(JointRise rise) {
  switch (rise) {
    case JointRise::linear:
      return true;
    case JointRise::parabolic:
      return false;
  }
  __builtin_unreachable();
}

/// Whether points remember a secant for each component.
[[gnu::always_inline]] constexpr bool has_secants(JointLaw law) {
  switch (law) {
    case JointLaw::mixed_mode:
      return false;
    case JointLaw::independent_peaks:
      return true;
  }
  __builtin_unreachable();
}

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
///   parabolic: at 2 f/k), D = max(D, sqrt((<delta_n - d_nt>/D_n)^2 + (<|delta_s| - d_st>/D_s)^2)); z(D) multiplies
///   both. A component that has passed its peak follows its secant: sigma = z s_n k delta_n, tau = z s_s k delta_s with
///   s_n the least of f_t/(k delta_n) and s_s the least of c/(k |delta_s| - mu p) so far. The same friction with weight
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
  double viscosity = kJointViscosity;  ///< c

  // Derived by `prepare`.
  SofteningCurve curve;
  double area = 0;          ///< A
  double onset_normal = 0;  ///< d_nt, m
  double onset_shear = 0;   ///< d_st without pressure, m
  double width_normal = 0;  ///< D_n, m
  double width_shear = 0;   ///< D_s, m
  double screen = 0;        ///< m2

  /// Squared opening up to which the joint is linear elastic in any direction, so that the sweep can evaluate it; 0:
  /// the sweep does not know this law.
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

}  // namespace breccia
