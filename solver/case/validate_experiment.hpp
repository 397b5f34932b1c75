#pragma once

#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// What is wrong with the gauges, triggers and conditions of a case. Groups and places are compared with the mesh later
/// (check_groups, model/gauge_points.hpp).
[[nodiscard]] std::vector<Problem> validate_experiment(const Case& c);

}  // namespace breccia::case_
