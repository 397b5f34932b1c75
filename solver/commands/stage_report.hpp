#pragma once

#include <vector>

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/constraint_conflicts.hpp"
#include "model/model.hpp"

namespace breccia {

/// What of the stages is probably not meant: loads that act at full size from the first step on bodies that rest and
/// that nothing damps, motions that begin with a jump in speed, friction where nothing damps, reactions where local
/// damping acts, intervals longer than the run.
/// @param model  of the whole mesh; a bare one will do. O(elements log elements).
[[nodiscard]] Advice stage_advice(const case_::Case& input, const Model& model);

/// Entries that overrule others on some of their nodes.
[[nodiscard]] Advice overruled_constraints(const case_::Case& input, const Model& model);

/// Throws InputError with every constraint of which another leaves nothing along an axis.
/// @param model  of the whole mesh; a bare one will do
void refuse_contradictions(const case_::Case& input, const Model& model);

/// Both, of what has been found already. @param conflicts  of the case
[[nodiscard]] Advice overruled_constraints(const std::vector<ConstraintConflict>& conflicts);
void refuse_contradictions(const case_::Case& input, const std::vector<ConstraintConflict>& conflicts);

}  // namespace breccia
