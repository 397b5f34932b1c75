#pragma once

#include <string>

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// What `check` says of bodies that overlap before the first step.
struct OverlapReport {
  std::string text;  ///< one line for each pair of groups, or one that there is none
  Advice advice;     ///< where a run would end with an error
};

/// @param model  of the whole mesh
[[nodiscard]] OverlapReport overlap_report(const case_::Case& input, const Model& model);

/// Throws InputError with every pair of groups whose bodies overlap and that contact.initial_overlap refuses.
/// @param model  of the whole mesh; a bare one will do
void refuse_initial_overlaps(const case_::Case& input, const Model& model);

}  // namespace breccia
