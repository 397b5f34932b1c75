#include "physics/joint_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace breccia {
namespace {

/// Opening at which a component reaches its strength.
double onset(const JointLawParams& law, double strength) {
  return (law.rise == JointRise::parabolic ? 2.0 : 1.0) * strength / law.stiffness;
}

/// Energy under the rising branch up to the strength, J/m2.
double rise_energy(const JointLawParams& law, double strength) {
  return (law.rise == JointRise::parabolic ? 2.0 / 3.0 : 0.5) * strength * onset(law, strength);
}

/// Width of the softening branch, m.
double softening_width(const JointLawParams& law, double energy, double strength) {
  const double kept = law.energy_of_whole_curve ? rise_energy(law, strength) : 0.0;
  return (energy - kept) / (law.area * strength);
}

/// Softening width in shear: under pressure the strength may grow so far that the rising branch alone holds the whole energy;
/// then the branch falls at once.
double shear_width(const JointLawParams& law, double strength) {
  return std::max(softening_width(law, law.energy_mode_2, strength), 1e-6 * onset(law, strength));
}

struct Components {
  double normal;         // delta_n
  Vec3 shear_vector;     // delta_s
  double shear;          // |delta_s|
  double pressure;       // <-sigma>, Pa
};

Components split(const JointLawParams& law, const Vec3& normal, const Vec3& opening) {
  Components c;
  c.normal = opening.dot(normal);
  c.shear_vector = opening - c.normal * normal;
  c.shear = c.shear_vector.norm();
  c.pressure = c.normal < 0 ? -law.stiffness * c.normal : 0.0;
  return c;
}

/// The opening in units of the onset, and what onset is.
struct Onset {
  double normal, shear, r2;        // x_n, x_s
  double shear_strength, shear_onset;
};

Onset onset_of(const JointLawParams& law, const Components& c) {
  Onset o;
  o.shear_strength = law.cohesion + law.friction * c.pressure;
  o.shear_onset = o.shear_strength / law.stiffness;
  o.normal = c.normal > 0 ? c.normal / law.onset_normal : 0.0;
  o.shear = c.shear / o.shear_onset;
  o.r2 = o.normal * o.normal + o.shear * o.shear;
  return o;
}

/// Traction in its parts and the energies they store.
struct Parts {
  double normal = 0;       // sigma, Pa
  Vec3 cohesive{0, 0, 0};  // (1-d) k delta_s
  Vec3 friction{0, 0, 0};  // weight tau_f
  double stored_normal = 0, stored_shear = 0, stored_friction = 0;
};

/// Slip and friction traction of the damaged share `weight`.
void add_friction(const JointLawParams& law, const Vec3& normal, const Components& c, double weight, JointPointHistory& history,
                  Parts& parts) {
  if (weight <= 0 || law.friction <= 0) return;
  const double old_length = history.slip.norm();
  Vec3 slip = history.slip - history.slip.dot(normal) * normal;
  const double length = slip.norm();
  if (length > 0) slip *= old_length / length;
  Vec3 spring = c.shear_vector - slip;
  const double limit = law.friction * c.pressure / law.stiffness;
  const double size = spring.norm();
  if (size > limit) {
    spring *= size > 0 ? limit / size : 0.0;
    slip = c.shear_vector - spring;
  }
  history.slip = slip;
  parts.friction = weight * law.stiffness * spring;
  parts.stored_friction = 0.5 * weight * law.stiffness * spring.squaredNorm();
}

Parts mixed_mode(const JointLawParams& law, const Vec3& normal, const Components& c, JointPointHistory& history) {
  if (law.breakable() && history.damage < 1.0) {
    const Onset o = onset_of(law, c);
    if (o.r2 > 1.0) {
      const double r = std::sqrt(o.r2);
      const double damage = (r - 1.0) / o.r2 * (o.normal * o.normal * law.onset_normal / law.width_normal +
                                                o.shear * o.shear * o.shear_onset / shear_width(law, o.shear_strength));
      const double trial = damage >= 1.0 ? 1.0 : 1.0 - softening(law.softening, damage) / r;
      history.damage = std::max(history.damage, trial);
    }
  }
  const double left = 1.0 - history.damage;
  Parts parts;
  parts.normal = (c.normal > 0 ? left : 1.0) * law.stiffness * c.normal;
  parts.stored_normal = 0.5 * parts.normal * c.normal;
  parts.cohesive = left * law.stiffness * c.shear_vector;
  parts.stored_shear = 0.5 * left * law.stiffness * c.shear * c.shear;
  add_friction(law, normal, c, history.damage, history, parts);
  return parts;
}

/// One component of the published law: stress at opening `now` when `largest` was reached and z is left.
struct PeakStress {
  double stress, stored;
};
PeakStress peak_stress(const JointLawParams& law, double strength, double now, double largest, double damage) {
  const double peak_at = onset(law, strength);
  const auto rise = [&](double x) { return law.rise == JointRise::parabolic ? x * (2.0 - x) : x; };
  if (damage <= 0) {
    const double x = std::min(now / peak_at, 1.0);
    const double energy = law.rise == JointRise::parabolic ? x * x * (1.0 - x / 3.0) : 0.5 * x * x;
    return {strength * rise(x), strength * peak_at * energy};
  }
  const double envelope = softening(law.softening, std::min(damage, 1.0)) * strength * rise(std::min(largest / peak_at, 1.0));
  const double stress = largest > 0 ? envelope * now / largest : 0.0;
  return {stress, 0.5 * stress * now};
}

Parts independent_peaks(const JointLawParams& law, const Vec3& normal, const Components& c, JointPointHistory& history) {
  const double strength = law.cohesion + law.friction * c.pressure;
  const double open = std::max(c.normal, 0.0);
  history.largest_normal = std::max(history.largest_normal, open);
  history.largest_shear = std::max(history.largest_shear, c.shear);
  const double beyond_n = std::max(open - law.onset_normal, 0.0) / law.width_normal;
  const double beyond_s = std::max(c.shear - onset(law, strength), 0.0) / shear_width(law, strength);
  history.damage = std::min(std::max(history.damage, std::hypot(beyond_n, beyond_s)), 1.0);

  Parts parts;
  if (c.normal > 0) {
    const PeakStress s = peak_stress(law, law.tensile_strength, open, history.largest_normal, history.damage);
    parts.normal = s.stress;
    parts.stored_normal = s.stored;
  } else {
    parts.normal = law.stiffness * c.normal;
    parts.stored_normal = 0.5 * parts.normal * c.normal;
  }
  const PeakStress s = peak_stress(law, strength, c.shear, history.largest_shear, history.damage);
  if (c.shear > 0) parts.cohesive = s.stress / c.shear * c.shear_vector;
  parts.stored_shear = s.stored;
  add_friction(law, normal, c, history.damage > 0 ? 1.0 - softening(law.softening, history.damage) : 0.0, history, parts);
  return parts;
}

}  // namespace

double onset_ratio(const JointLawParams& law, const Vec3& normal, const Vec3& opening) {
  return law.breakable() ? std::sqrt(onset_of(law, split(law, normal, opening)).r2) : 0.0;
}

bool JointLawParams::breakable() const { return std::isfinite(tensile_strength); }

std::string prepare(JointLawParams& law) {
  if (!law.breakable()) {
    law.screen = law.points == JointPoints::nodal ? std::numeric_limits<double>::infinity() : 0.0;
    return {};
  }
  if (std::string problem = softening_problem(law.softening); !problem.empty()) return problem;
  law.area = softening_area(law.softening);
  law.onset_normal = onset(law, law.tensile_strength);
  law.width_normal = softening_width(law, law.energy_mode_1, law.tensile_strength);
  const struct {
    const char* name;
    double energy, strength;
  } modes[]{{"mode I", law.energy_mode_1, law.tensile_strength}, {"mode II", law.energy_mode_2, law.cohesion}};
  for (const auto& mode : modes) {
    if (mode.energy > rise_energy(law, mode.strength)) continue;
    return std::string("penalty too soft for this strength and energy in ") + mode.name + ": the elastic part alone holds " +
           std::to_string(rise_energy(law, mode.strength)) + " J/m2 of " + std::to_string(mode.energy) +
           " J/m2; raise the penalty by more than a factor of " + std::to_string(rise_energy(law, mode.strength) / mode.energy);
  }
  const bool linear = law.law == JointLaw::mixed_mode && law.rise == JointRise::linear && law.points == JointPoints::nodal;
  const double onset_least = std::min(law.tensile_strength, law.cohesion) / law.stiffness;
  law.screen = linear ? onset_least * onset_least * (1.0 - 1e-12) : 0.0;  // round-off must not hide an onset
  return {};
}

JointPointResponse evaluate_point(const JointLawParams& law, const Vec3& normal, const Vec3& opening, JointPointHistory& history) {
  const Components c = split(law, normal, opening);
  const Parts parts = law.law == JointLaw::mixed_mode ? mixed_mode(law, normal, c, history) : independent_peaks(law, normal, c, history);
  JointPointResponse response;
  response.elastic = law.law == JointLaw::mixed_mode && history.damage == 0.0;
  response.traction = response.elastic ? Vec3(law.stiffness * opening) : Vec3(parts.normal * normal + parts.cohesive + parts.friction);

  const double work = 0.5 * (history.traction + response.traction).dot(opening - history.opening);
  const double normal_work = 0.5 * (history.normal_traction + parts.normal) * (c.normal - history.normal_opening);
  const double friction_work = 0.5 * (history.friction_traction + parts.friction).dot(c.shear_vector - history.shear_opening);
  response.mode_1 = normal_work - (parts.stored_normal - history.stored_normal);
  response.friction = friction_work - (parts.stored_friction - history.stored_friction);
  const double total = work - (parts.stored_normal - history.stored_normal) - (parts.stored_shear - history.stored_shear) -
                       (parts.stored_friction - history.stored_friction);
  response.mode_2 = total - response.mode_1 - response.friction;

  history.opening = opening;
  history.traction = response.traction;
  history.normal_opening = c.normal;
  history.normal_traction = parts.normal;
  history.shear_opening = c.shear_vector;
  history.friction_traction = parts.friction;
  history.stored_normal = parts.stored_normal;
  history.stored_shear = parts.stored_shear;
  history.stored_friction = parts.stored_friction;
  return response;
}

}  // namespace breccia
