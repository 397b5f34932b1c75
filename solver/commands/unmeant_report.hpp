#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// What makes a run something else than can have been meant, though nothing in it fails: elements in no physical
/// volume, a sphere around nothing, contact without contact points, a penalty too steep for its plateau or too soft to
/// stop what comes, bodies pressed without friction by points on both sides, an initial velocity along axes that are
/// held, a pressure on what is held, surfaces within the model on which a load or an absorbing boundary does not act,
/// entries that overrule others, also where two [[contact]] name as much of a pair. `run` says it as well as `check`.
/// @param model  of the whole mesh; a bare one will do. O(elements).
[[nodiscard]] Advice unmeant_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
