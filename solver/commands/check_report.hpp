#pragma once

#include <string>

#include "case/case.hpp"
#include "mesh/finish.hpp"
#include "model/model.hpp"

namespace breccia {

/// Bodies, groups, repairs and quality of a mesh, for a terminal.
[[nodiscard]] std::string mesh_report(const FinishedMesh& made);

/// How a run on `parts` ranks divides the model: elements, joints, proxies, messages and bytes a step by domain, or the
/// least, mean and most and the slowest three of many; imbalance and predicted efficiency.
/// @param model  at least bare.  Throws as assign_domains.
[[nodiscard]] std::string domain_table(const case_::Case& input, const Model& model, int parts);

/// The same in one line.
[[nodiscard]] std::string domain_line(const case_::Case& input, const Model& model, int parts);

/// Everything that can be told before the first step: size, stable step and what limits it, steps, memory, run time on
/// this machine (from a few steps of a scratch copy), joints against the fracture process zone, softness added by the
/// joints, and advice as sentences with their remedy.
[[nodiscard]] std::string check_report(const case_::Case& input, const Model& model);

}  // namespace breccia
