#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// What of the model is probably not meant: bodies that can meet, or can break, in a case without contact, points
/// outside the spherical boundary, bodies of one group that touch face to face and are not joined, a plane model whose
/// thickness does not fit its elements. O(elements log elements).
[[nodiscard]] Advice model_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
