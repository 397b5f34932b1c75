#include "physics/joint_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "physics/joint_point.hpp"

namespace breccia {
namespace {

/// Energy under the rising branch up to the strength, J/m2: f^2/(2k) linear, 4 f^2/(3k) parabolic.
double rise_energy(const JointLawParams& law, double strength) {
  switch (law.rise) {
    case JointRise::linear:
      return 0.5 * strength * strength / law.stiffness;
    case JointRise::parabolic:
      return 4.0 / 3.0 * strength * strength / law.stiffness;
  }
  __builtin_unreachable();
}

/// Squared opening up to which a joint that can break is linear elastic in every direction, m2; 0: the points decide.
double screen_of(const JointLawParams& law) {
  if (law.points != JointPoints::nodal) return 0.0;
  switch (law.law) {
    case JointLaw::mixed_mode:
      break;
    case JointLaw::independent_peaks:
      return 0.0;
  }
  // Pressure only raises the limit. Round-off must not hide an onset.
  const double least = std::min(law.onset_normal, law.onset_shear);
  return least * least * (1.0 - 1e-12);
}

double softening_width(const JointLawParams& law, double energy, double strength) {
  return (energy - (law.energy_of_whole_curve ? rise_energy(law, strength) : 0.0)) / (law.area * strength);
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
  if (rises_linearly(law.rise)) return;
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

std::string prepare(JointLawParams& law) {
  if (!(law.stiffness > 0 && std::isfinite(law.stiffness)))
    return "the stiffness k = p/h must be positive and a finite number";
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
  law.onset_normal = peak_factor(law.rise) * law.tensile_strength / law.stiffness;
  law.onset_shear = peak_factor(law.rise) * law.cohesion / law.stiffness;
  law.width_normal = softening_width(law, law.energy_mode_1, law.tensile_strength);
  law.width_shear = softening_width(law, law.energy_mode_2, law.cohesion);
  law.screen = screen_of(law);
  return {};
}

JointPointResponse evaluate_point(const JointLawParams& law, const JointFrame& frame, const Vec3& opening,
                                  JointPointHistory<double>& history) {
  namespace jp = joint_point;
  const auto vector_of = [](const Vec3& v) { return jp::Vector<double>{v[0], v[1], v[2]}; };
  const jp::Frame<double> axes{vector_of(frame.normal), {vector_of(frame.tangent[0]), vector_of(frame.tangent[1])}};
  const jp::Response<double> r = jp::evaluate(law, axes, vector_of(opening), false, history);
  return {Vec3(r.traction[0], r.traction[1], r.traction[2]), r.mode_1, r.mode_2, r.friction, r.viscous, r.elastic};
}

}  // namespace breccia
