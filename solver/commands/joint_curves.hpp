#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace breccia {

/// Traction of a joint law along one direction, from zero to its end, evaluated as a run does but for the viscosity.
struct JointCurve {
  std::vector<double> opening;   ///< m
  std::vector<double> traction;  ///< Pa
  double peak = 0;               ///< m, opening at the greatest traction
  double energy = 0;             ///< J/m2, that the case gives for this mode
};

/// What a law does, for plots.
struct JointLawCurves {
  std::string name;      ///< of the law: "glass"
  std::string key;       ///< of the entry of the case: "joint[0]"
  double size = 0;       ///< m, h of k = p/h
  double stiffness = 0;  ///< Pa/m, k
  JointCurve normal, shear;
  JointCurve unloading;  ///< normal: loaded to half of the softening, back to zero, and as far again
  /// Strength under traction in any direction: tension positive, then pressures up to three times the cohesion.
  std::vector<double> envelope_normal, envelope_shear;  ///< Pa
};

/// Of the laws whose joints can break. @param law  prepared
[[nodiscard]] JointLawCurves joint_law_curves(const JointLawParams& law);
[[nodiscard]] std::vector<JointLawCurves> joint_curves(const Model& model);

}  // namespace breccia
