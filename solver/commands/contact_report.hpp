#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"

/// Report of `check` on contact, overlaps excepted.
namespace breccia {

/// A line for each group with a law: H, m, of its finest body, the stiffness penalty/H, Pa/m, of its laws, and the
/// recommended penalty.
[[nodiscard]] std::string stiffness_report(const Model& model);

/// A line for each [[contact]] that keeps groups from interacting, with the pairs of groups that it rules.
[[nodiscard]] std::string separation_report(const case_::Case& input, const std::vector<std::string>& groups);

}  // namespace breccia
