#pragma once

#include <string>

#include "case/case.hpp"
#include "mesh/finish.hpp"
#include "simulation/model.hpp"

namespace breccia {

/// Bodies, groups, repairs and quality of a mesh, for a terminal.
[[nodiscard]] std::string mesh_report(const FinishedMesh& made);

/// Everything that can be told before the first step: size, stable step and what limits it, steps, memory, run time on this
/// machine (from a few steps of a scratch copy), joints against the fracture process zone, softness added by
/// the joints, and advice as sentences with their remedy.
[[nodiscard]] std::string check_report(const case_::Case& input, const Model& model);

}  // namespace breccia
