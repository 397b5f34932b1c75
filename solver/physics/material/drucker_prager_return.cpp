#include "physics/material/drucker_prager_return.hpp"

#include <algorithm>

namespace breccia::material {
namespace {

/// The trial stress, and the strengths before the step.
struct Problem {
  const DruckerPragerParams& p;
  double mu, bulk;
  MeanAndShear trial;
  double cohesion;      ///< Pa, c
  double cap_pressure;  ///< Pa, p_c

  [[nodiscard]] double cone(double mean) const {
    return trial.shear + p.friction * mean - p.cohesion_factor * cohesion;
  }
  /// Decrease of f_s per unit of gamma_s at constant mean stress.
  [[nodiscard]] double at_held_mean() const { return mu + p.cohesion_factor * p.hardening; }
  [[nodiscard]] double along_flow() const { return at_held_mean() + p.friction * p.dilation * bulk; }
  /// Stress on the cone at a mean stress, after gamma_s of flow.
  [[nodiscard]] MeanAndShear on_cone(double mean, double gamma) const {
    const double strength = p.cohesion_factor * (cohesion + p.hardening * gamma);
    return {mean, std::max(0.0, strength - p.friction * mean)};
  }
};

ReturnedStress to_cone(const Problem& t) {
  ReturnedStress r;
  r.stress = t.trial;
  const double excess = t.cone(t.trial.mean);
  if (!(excess > 0)) return r;
  r.cone = excess / t.along_flow();
  r.stress = t.on_cone(t.trial.mean - t.bulk * t.p.dilation * r.cone, r.cone);
  return r;
}

ReturnedStress to_cut_off(const Problem& t) {
  ReturnedStress r;
  const double limit = t.p.tension_cutoff, excess = t.cone(limit);
  r.stress = {limit, t.trial.shear};
  if (excess > 0) {  // their corner
    r.cone = excess / t.at_held_mean();
    r.stress = t.on_cone(limit, r.cone);
  }
  r.cut = std::max(0.0, (t.trial.mean - limit) / t.bulk - t.p.dilation * r.cone);
  return r;
}

ReturnedStress to_cap(const Problem& t) {
  ReturnedStress r;
  const double cap = -t.trial.mean - t.cap_pressure, stiffness = t.bulk + t.p.cap_hardening;
  const auto mean_after = [&](double gamma) { return -(t.cap_pressure + t.p.cap_hardening * gamma); };
  r.cap = std::max(0.0, cap / stiffness);
  r.stress = {mean_after(r.cap), t.trial.shear};
  if (cap > 0 && !(t.cone(r.stress.mean) > 0)) return r;
  // Their corner: [along_flow, -eta K; -eta_g K, K + H_c] (gamma_s, gamma_c) = (f_s, f_c) of the trial stress.
  const double cone = t.cone(t.trial.mean);
  const double determinant = t.at_held_mean() * stiffness + t.p.friction * t.p.dilation * t.bulk * t.p.cap_hardening;
  r.cone = std::max(0.0, (stiffness * cone + t.p.friction * t.bulk * cap) / determinant);
  r.cap = std::max(0.0, (t.along_flow() * cap + t.p.dilation * t.bulk * cone) / determinant);
  r.stress = t.on_cone(mean_after(r.cap), r.cone);
  return r;
}

}  // namespace

/// The pair to evaluate follows from the return to the cone alone. It does not raise the mean stress: where it ends
/// beyond the cut-off the trial stress was beyond it, and one of {cut-off, corner} holds; where it ends beyond the cap
/// one of {cap, corner} does, and the cut-off is far.
ReturnedStress return_stress(const DruckerPragerParams& p, double mu, double bulk, const MeanAndShear& trial,
                             double plastic_shear, double compaction) {
  const Problem problem{
      p, mu, bulk, trial, p.cohesion + p.hardening * plastic_shear, p.cap_pressure + p.cap_hardening * compaction};
  const ReturnedStress on_cone = to_cone(problem);
  if (on_cone.stress.mean > p.tension_cutoff) return to_cut_off(problem);
  if (on_cone.stress.mean < -problem.cap_pressure) return to_cap(problem);
  return on_cone;
}

}  // namespace breccia::material
