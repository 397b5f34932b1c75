#include "physics/joint_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <Eigen/Geometry>

namespace breccia {
namespace {

/// Opening at the peak over strength / k.
double peak_factor(const JointLawParams& law) { return law.rise == JointRise::parabolic ? 2.0 : 1.0; }

/// Energy under the rising branch up to the strength, J/m2: f^2/(2k) linear, 4 f^2/(3k) parabolic.
double rise_energy(const JointLawParams& law, double strength) {
  return (law.rise == JointRise::parabolic ? 4.0 / 3.0 : 0.5) * strength * strength / law.stiffness;
}

double softening_width(const JointLawParams& law, double energy, double strength) {
  return (energy - (law.energy_of_whole_curve ? rise_energy(law, strength) : 0.0)) / (law.area * strength);
}

/// An opening in the joint's axes.
struct Components {
  double normal = 0;    // delta_n
  double open = 0;      // <delta_n>
  double pressure = 0;  // p, Pa
  Vec3 shear_vector{0, 0, 0};
  double shear2 = 0;  // |delta_s|^2
};

Components split(const JointLawParams& law, const JointFrame& frame, const Vec3& opening) {
  Components c;
  c.normal = opening.dot(frame.normal);
  c.open = c.normal > 0 ? c.normal : 0.0;
  c.pressure = c.normal < 0 ? -law.stiffness * c.normal : 0.0;
  c.shear_vector = opening - c.normal * frame.normal;
  c.shear2 = c.shear_vector.squaredNorm();
  return c;
}

/// What is left of the stiffness k of each component.
struct Left {
  double z = 1.0;  // factor of both
  double secant_normal = 1.0, secant_shear = 1.0;
  [[nodiscard]] double shear() const { return z * secant_shear; }
};

/// Takes the damage of an opening. Returns the share of the opening, along its ray, at which the elastic range ends; at
/// most 1.
double grow_mixed_mode(const JointLawParams& law, const Components& c, JointPointHistory& h) {
  const double coulomb = law.friction * c.pressure;
  const double onset_shear = (law.cohesion + coulomb) / law.stiffness;
  const double normal2 = (c.open / law.onset_normal) * (c.open / law.onset_normal);
  const double shear2 = c.shear2 / (onset_shear * onset_shear);
  const double r2 = normal2 + shear2;
  if (r2 <= 1.0) return 1.0;
  const double r = std::sqrt(r2);
  const double reach = c.pressure > 0 ? (law.stiffness * std::sqrt(c.shear2) - coulomb) / law.cohesion : r;
  const double end_of_elastic = std::min(1.0 / reach, 1.0);
  if (h.damage >= 1.0) return end_of_elastic;
  const double level =
      (r - 1.0) / r2 * (normal2 * law.onset_normal / law.width_normal + shear2 * onset_shear / law.width_shear);
  if (level >= 1.0) {
    h.damage = h.level = 1.0;
    h.left = 0.0;
    return end_of_elastic;
  }
  // z falls with the level, so below the last one 1 - left/reach bounds the trial from above: no exp on unloading.
  if (level <= h.level && 1.0 - h.left / reach <= h.damage) return end_of_elastic;
  const double z = law.curve(level), trial = 1.0 - z / reach;
  if (trial > h.damage) {
    h.damage = trial;
    h.level = level;
    h.left = z;
  }
  return end_of_elastic;
}

double grow_independent_peaks(const JointLawParams& law, const Components& c, JointPointHistory& h) {
  const double factor = peak_factor(law);
  const double coulomb = law.friction * c.pressure;
  const double onset_shear = factor * (law.cohesion + coulomb) / law.stiffness;
  const double shear = std::sqrt(c.shear2);
  double end_of_elastic = 1.0, beyond_n = 0.0, beyond_s = 0.0;
  if (c.open > law.onset_normal) {
    const double secant = law.tensile_strength / (law.stiffness * c.open);
    h.secant_normal = std::min(h.secant_normal, secant);
    end_of_elastic = factor * secant;
    beyond_n = (c.open - law.onset_normal) / law.width_normal;
  }
  if (shear > onset_shear) {
    const double secant = law.cohesion / (law.stiffness * shear - coulomb);
    h.secant_shear = std::min(h.secant_shear, secant);
    end_of_elastic = std::min(end_of_elastic, factor * secant);
    beyond_s = (shear - onset_shear) / law.width_shear;
  }
  const double level = std::sqrt(beyond_n * beyond_n + beyond_s * beyond_s);
  if (level > h.damage) {
    h.damage = h.level = std::min(level, 1.0);
    h.left = h.damage < 1.0 ? law.curve(h.damage) : 0.0;
  }
  return std::min(end_of_elastic, 1.0);
}

Left left_of(const JointLawParams& law, const JointPointHistory& h) {
  if (h.damage >= 1.0) return {0.0, h.secant_normal, h.secant_shear};
  if (law.law == JointLaw::mixed_mode) return {1.0 - h.damage, 1.0, 1.0};
  return {h.left, h.secant_normal, h.secant_shear};
}

/// One component: traction over opening, Pa/m, and energy held, J/m2.
struct Held {
  double stiffness, stored;
};

Held held_by(const JointLawParams& law, double onset, double z, double secant, double opening2) {
  if (law.rise == JointRise::parabolic && secant == 1.0) {
    // f (2x - x^2), x = opening/onset, onset = 2f/k: before the peak of this component.
    const double x = std::min(std::sqrt(opening2) / onset, 1.0);
    return {z * law.stiffness * (1.0 - 0.5 * x), z * law.stiffness * opening2 * (0.5 - x / 6.0)};
  }
  const double stiffness = z * secant * law.stiffness;
  return {stiffness, 0.5 * stiffness * opening2};
}

/// State of a point after its damage is known.
struct Answer {
  double normal = 0;                     // sigma
  double shear_stiffness = 0;            // tau = shear_stiffness delta_s + friction
  std::array<double, 2> friction{0, 0};  // along the tangents
  double stored_normal = 0, stored_shear = 0, stored_friction = 0;
};

Answer answer_of(const JointLawParams& law, const Components& c, const Left& left) {
  Answer answer;
  const Held n = c.normal > 0 ? held_by(law, law.onset_normal, left.z, left.secant_normal, c.normal * c.normal)
                              : Held{law.stiffness, 0.5 * law.stiffness * c.normal * c.normal};
  const Held s = held_by(law, law.onset_shear, left.z, left.secant_shear, c.shear2);
  answer.normal = n.stiffness * c.normal;
  answer.stored_normal = n.stored;
  answer.shear_stiffness = s.stiffness;
  answer.stored_shear = s.stored;
  return answer;
}

/// Friction of the damaged share: moves the slip so that the spring stays within Coulomb's limit. Returns what friction
/// of the last state and this one, in the mean, dissipates on this slip.
double slide(const JointLawParams& law, const JointFrame& frame, const Components& c, double weight,
             JointPointHistory& h, Answer& answer) {
  const double limit = law.friction * c.pressure / law.stiffness;
  std::array<double, 2> spring{}, moved{};
  for (std::size_t i = 0; i < 2; ++i)
    spring[i] = c.shear_vector.dot(frame.tangent[i]) - h.slip[static_cast<Eigen::Index>(i)];
  const double length2 = spring[0] * spring[0] + spring[1] * spring[1];
  if (length2 > limit * limit) {
    const double keep = limit / std::sqrt(length2);
    for (std::size_t i = 0; i < 2; ++i) {
      moved[i] = (1.0 - keep) * spring[i];
      spring[i] *= keep;
      h.slip[static_cast<Eigen::Index>(i)] += moved[i];
    }
  }
  double dissipated = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    answer.friction[i] = weight * law.stiffness * spring[i];
    dissipated += 0.5 * (h.friction_traction[i] + answer.friction[i]) * moved[i];
  }
  answer.stored_friction = 0.5 * weight * law.stiffness * (spring[0] * spring[0] + spring[1] * spring[1]);
  // The slip that the first damage finds was not slid: nothing weighed on it.
  return h.friction_weight > 0 ? dissipated : 0.0;
}

void remember(const Vec3& opening, const Vec3& traction, double normal_opening, const Answer& answer,
              JointPointHistory& h) {
  h.fresh = h.whole = false;
  h.opening = opening;
  h.traction = traction;
  h.normal_opening = normal_opening;
  h.normal_traction = answer.normal;
  h.friction_traction = answer.friction;
  h.stored_normal = answer.stored_normal;
  h.stored_shear = answer.stored_shear;
  h.stored_friction = answer.stored_friction;
}

/// Puts a fresh history where the ray of the opening left the elastic range.
void start_at_limit(const JointLawParams& law, const JointFrame& frame, const Vec3& opening, double share,
                    JointPointHistory& h) {
  const Vec3 limit = share * opening;
  const Components c = split(law, frame, limit);
  const Answer answer = answer_of(law, c, Left{});
  remember(limit, answer.normal * frame.normal + answer.shear_stiffness * c.shear_vector, c.normal, answer, h);
}

/// Parts of an elastic history whose last evaluation did not ask for the normal.
void split_history(const JointLawParams& law, const JointFrame& frame, JointPointHistory& h) {
  const Vec3 opening = h.opening, traction = h.traction;
  const Components c = split(law, frame, opening);
  remember(opening, traction, c.normal, answer_of(law, c, Left{}), h);
}

/// What is wrong with single numbers.
void check_numbers(const JointLawParams& law, std::ostringstream& problems) {
  const auto positive = [&](const char* name, double value) {
    if (!(value > 0 && std::isfinite(value))) problems << name << " must be positive, not " << value << "; ";
  };
  positive("the tensile strength", law.tensile_strength);
  positive("the shear strength", law.cohesion);
  positive("the energy of mode I", law.energy_mode_1);
  positive("the energy of mode II", law.energy_mode_2);
  if (!(law.friction >= 0 && std::isfinite(law.friction))) problems << "the friction must not be negative; ";
  if (law.points_to_fail < 1 || law.points_to_fail > 3) problems << "points_to_fail must be 1, 2 or 3; ";
  if (law.rise != JointRise::parabolic) return;
  if (law.law != JointLaw::independent_peaks)
    problems << "rise = \"parabolic\" goes with law = \"independent_peaks\" only; ";
  if (law.friction > 0) problems << "rise = \"parabolic\" does not go with friction; ";
}

void check_energy(const JointLawParams& law, const char* mode, double energy, double strength,
                  std::ostringstream& problems) {
  // Even where the energies are those of the softening branch, the rise must not hold more than they.
  const double least =
      law.energy_of_whole_curve ? rise_energy(law, strength) : 0.5 * strength * strength / law.stiffness;
  if (energy > least) return;
  problems << "penalty too soft for this strength and energy in " << mode << ": the elastic part alone holds " << least
           << " J/m2 of " << energy << " J/m2; raise the penalty by more than a factor of " << least / energy << "; ";
}

}  // namespace

bool JointLawParams::breakable() const { return std::isfinite(tensile_strength) || std::isfinite(cohesion); }

double JointPointHistory::shear_opening() const {
  return std::sqrt(std::max(opening.squaredNorm() - normal_opening * normal_opening, 0.0));
}

std::string prepare(JointLawParams& law) {
  if (!(law.stiffness > 0 && std::isfinite(law.stiffness))) return "the stiffness k = p/h must be positive";
  law.screen = 0.0;
  if (!law.breakable()) {
    law.law = JointLaw::mixed_mode;
    law.rise = JointRise::linear;
    if (law.points == JointPoints::nodal) law.screen = std::numeric_limits<double>::infinity();
    return {};
  }
  std::ostringstream problems;
  check_numbers(law, problems);
  if (problems.tellp() == 0) {
    check_energy(law, "mode I", law.energy_mode_1, law.tensile_strength, problems);
    check_energy(law, "mode II", law.energy_mode_2, law.cohesion, problems);
  }
  if (const std::string problem = softening_problem(law.softening); !problem.empty()) problems << problem << "; ";
  if (std::string text = problems.str(); !text.empty()) return text.substr(0, text.size() - 2);

  law.curve = SofteningCurve(law.softening);
  law.area = law.curve.area();
  law.onset_normal = peak_factor(law) * law.tensile_strength / law.stiffness;
  law.onset_shear = peak_factor(law) * law.cohesion / law.stiffness;
  law.width_normal = softening_width(law, law.energy_mode_1, law.tensile_strength);
  law.width_shear = softening_width(law, law.energy_mode_2, law.cohesion);
  if (law.law == JointLaw::mixed_mode && law.points == JointPoints::nodal) {
    // Pressure only raises the limit. Round-off must not hide an onset.
    const double least = std::min(law.onset_normal, law.onset_shear);
    law.screen = least * least * (1.0 - 1e-12);
  }
  return {};
}

JointPointResponse evaluate_point(const JointLawParams& law, const JointFrame& frame, const Vec3& opening,
                                  JointPointHistory& history) {
  const Components c = split(law, frame, opening);
  double end_of_elastic = 1.0;
  if (law.breakable() && (history.damage < 1.0 || history.fresh)) {
    end_of_elastic =
        law.law == JointLaw::mixed_mode ? grow_mixed_mode(law, c, history) : grow_independent_peaks(law, c, history);
  }
  const Left left = left_of(law, history);
  Answer answer = answer_of(law, c, left);
  JointPointResponse response;
  response.elastic = history.damage == 0.0 && law.rise == JointRise::linear;
  if (response.elastic) {
    response.traction = law.stiffness * opening;
    remember(opening, response.traction, c.normal, answer, history);
    return response;
  }
  if (history.fresh) start_at_limit(law, frame, opening, end_of_elastic, history);
  if (history.whole) split_history(law, frame, history);

  const double weight = law.friction > 0 ? 1.0 - left.shear() : 0.0;
  response.traction = answer.normal * frame.normal + answer.shear_stiffness * c.shear_vector;
  if (weight > 0) {
    response.friction = slide(law, frame, c, weight, history, answer);
    response.traction += answer.friction[0] * frame.tangent[0] + answer.friction[1] * frame.tangent[1];
  }
  const double work = 0.5 * (history.traction + response.traction).dot(opening - history.opening);
  const double normal_work = 0.5 * (history.normal_traction + answer.normal) * (c.normal - history.normal_opening);
  response.mode_1 = normal_work - (answer.stored_normal - history.stored_normal);
  response.mode_2 = (work - normal_work) - (answer.stored_shear - history.stored_shear) -
                    (answer.stored_friction - history.stored_friction) - response.friction;
  if (history.gone) {
    response.friction += response.mode_1 + response.mode_2;
    response.mode_1 = response.mode_2 = 0.0;
  }
  remember(opening, response.traction, c.normal, answer, history);
  history.friction_weight = weight;
  history.gone = history.damage >= 1.0;
  return response;
}

}  // namespace breccia
