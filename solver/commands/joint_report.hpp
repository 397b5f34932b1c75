#pragma once

#include <string>

#include "advice/joint_measures.hpp"
#include "model/model.hpp"

namespace breccia {

/// A paragraph for each pair of groups that joints hold together: stiffness k, Pa/m, how much softer they make the
/// body, and, where they can fail, the fracture process zone, m, against their edges and the strengths, Pa, that
/// scatter.
[[nodiscard]] std::string joint_report(const Model& model, const AllJointMeasures& joints);

}  // namespace breccia
