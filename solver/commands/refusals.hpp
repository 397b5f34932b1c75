#pragma once

#include <vector>

#include "case/case.hpp"
#include "model/constraint_conflicts.hpp"
#include "model/model.hpp"

/// What a model is refused for that is known once it is built.
/// All throw InputError with every place; @param model  of the whole mesh, a bare one will do.
namespace breccia {

/// Pairs of groups whose bodies overlap where contact.initial_overlap refuses that.
void refuse_initial_overlaps(const case_::Case& input, const Model& model);

/// Constraints of which another leaves nothing along an axis.
void refuse_contradictions(const case_::Case& input, const Model& model);
/// Likewise of what has been found. @param conflicts  of the case
void refuse_contradictions(const case_::Case& input, const std::vector<ConstraintConflict>& conflicts);

}  // namespace breccia
