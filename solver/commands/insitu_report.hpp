#pragma once

#include <string>

#include "case/case.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// What the pipelines in situ will do: a line for each with its instants, and how many elements its region holds or how
/// many points of its probes lie in elements before the first step. What lies outside of the model is named with the
/// box that the model fills. Empty: the case has no pipelines.
/// @param steps  of the run, as estimated
[[nodiscard]] std::string insitu_report(const case_::Case& input, const Mesh& mesh, double begin, double steps);

}  // namespace breccia
