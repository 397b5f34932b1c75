#pragma once

#include <string>

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// What of the model is probably not meant: sentences with their remedy, a line each. Bodies that can meet in a case
/// without contact, points outside the spherical boundary, bodies of one group that touch face to face and are not
/// joined. O(elements log elements).
[[nodiscard]] std::string model_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
