#include "commands/joint_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/joint_law.hpp"

namespace breccia {
namespace {

constexpr int kRise = 20, kSoftening = 100;  // points of a curve
constexpr int kDirections = 24, kPressures = 12, kLoading = 200;

const JointFrame kFrame{Vec3(0, 0, 1), {Vec3(1, 0, 0), Vec3(0, 1, 0)}};

/// A point that is opened further and further.
class Probe {
 public:
  explicit Probe(const JointLawParams& law) : law_(law) {}
  /// Traction at an opening, normal and along the joint.
  [[nodiscard]] std::array<double, 2> at(double normal, double shear) {
    const Vec3 traction = evaluate_point(law_, kFrame, Vec3(shear, 0, normal), history_).traction;
    return {traction[2], traction[0]};
  }

 private:
  const JointLawParams& law_;
  JointPointHistory<double> history_;
};

/// Openings up to the peak and from there to the end.
std::vector<double> openings(double peak, double end) {
  std::vector<double> out;
  out.reserve(kRise + kSoftening + 1);
  for (int i = 0; i < kRise; ++i) out.push_back(peak * i / kRise);
  for (int i = 0; i <= kSoftening; ++i) out.push_back(peak + (end - peak) * i / kSoftening);
  return out;
}

JointCurve curve_of(const JointLawParams& law, bool shear) {
  JointCurve curve;
  curve.peak = shear ? law.onset_shear : law.onset_normal;
  curve.energy = shear ? law.energy_mode_2 : law.energy_mode_1;
  Probe probe(law);
  for (const double x : openings(curve.peak, curve.peak + (shear ? law.width_shear : law.width_normal))) {
    curve.opening.push_back(x);
    curve.traction.push_back(shear ? probe.at(0, x)[1] : probe.at(x, 0)[0]);
  }
  return curve;
}

JointCurve unloading_of(const JointLawParams& law) {
  const double top = law.onset_normal + 0.25 * law.width_normal;
  JointCurve curve;
  Probe probe(law);
  for (int leg = 0; leg < 3; ++leg) {
    for (int i = 0; i <= kRise; ++i) {
      const double share = static_cast<double>(i) / kRise, x = top * (leg == 1 ? 1 - share : share);
      const double traction = probe.at(x, 0)[0];
      if (leg == 0) continue;  // the curve itself
      curve.opening.push_back(x);
      curve.traction.push_back(traction);
    }
  }
  return curve;
}

/// Greatest shear traction, and the normal one with it, on a straight path.
std::array<double, 2> strength_on(const JointLawParams& law, double normal_rate, double normal_start,
                                  double shear_rate) {
  Probe probe(law);
  std::array<double, 2> best{};
  double most = -1;
  for (int i = 0; i <= kLoading; ++i) {
    const double share = 1.5 * i / kLoading;
    const std::array<double, 2> t = probe.at(normal_start + share * normal_rate, share * shear_rate);
    const double size = normal_start < 0 ? t[1] : std::hypot(t[0], t[1]);
    if (size > most) {
      most = size;
      best = t;
    }
  }
  return best;
}

void add_envelope(const JointLawParams& law, JointLawCurves& out) {
  const auto add = [&](const std::array<double, 2>& t) {
    out.envelope_normal.push_back(t[0]);
    out.envelope_shear.push_back(t[1]);
  };
  for (int i = kPressures; i > 0; --i) {
    const double pressure = 3 * law.cohesion * i / kPressures;
    const double shear = law.onset_shear * (1 + law.friction * pressure / law.cohesion);
    add(strength_on(law, 0, -pressure / law.stiffness, shear));
  }
  for (int i = 0; i <= kDirections; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kDirections;
    add(strength_on(law, law.onset_normal * std::sin(angle), 0, law.onset_shear * std::cos(angle)));
  }
}

}  // namespace

JointLawCurves joint_law_curves(const JointLawParams& law) {
  JointLawParams still = law;
  still.viscosity = 0;  // it depends on the speed
  JointLawCurves curves;
  curves.stiffness = law.stiffness;
  curves.normal = curve_of(still, false);
  curves.shear = curve_of(still, true);
  curves.unloading = unloading_of(still);
  add_envelope(still, curves);
  return curves;
}

std::vector<JointLawCurves> joint_curves(const Model& model) {
  std::vector<JointLawCurves> all;
  for (std::size_t i = 0; i < model.joint_law_names.size(); ++i) {
    if (!model.joint_laws[i].breakable()) continue;
    all.push_back(joint_law_curves(model.joint_laws[i]));
    all.back().name = model.joint_law_names[i];
    all.back().key = model.joint_law_keys[i];
    all.back().size = model.joint_sizes[i];
  }
  return all;
}

}  // namespace breccia
