#pragma once

#include <string>

#include "commands/advice.hpp"
#include "model/model.hpp"

/// What `check` says of joints.
namespace breccia {

/// A paragraph for each pair of groups that joints hold together: stiffness k, Pa/m, how much softer they make the
/// body, and, where they can fail, the fracture process zone, m, against their edges and the strengths, Pa, that
/// scatter.
/// @param advice  out: warnings are added
[[nodiscard]] std::string joint_report(const Model& model, Advice& advice);

/// Joints that open fully within few steps: once one has begun to soften both sides of the crack leave with f_t/(rho c)
/// each, so that it takes D_n rho c / (2 f_t). Not where no step resolves it, which joint_report tells.
/// @param dt  the step, s
[[nodiscard]] Advice sudden_softening(const Model& model, double dt);

}  // namespace breccia
