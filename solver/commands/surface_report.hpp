#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// Surfaces on which a stage's keys do nothing or something else than their name says: a pressure whose two sides share
/// their nodes, an absorbing boundary within the model.
/// @param model  of the whole mesh; a bare one will do. O(faces of the surfaces).
[[nodiscard]] Advice surface_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
