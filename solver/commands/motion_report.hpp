#pragma once

#include <string>

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Of the prescribed motions that begin with a jump in speed, the one whose wave, rho c v in one dimension, is the
/// largest share of the tensile strength of joints that it comes to: in the driven solid, or in one that lies on it.
/// Empty: none comes to a tenth, or the stage is over within few crossings of a wave, so that a pulse is meant, or the
/// velocity before is unknown. @param model  of the whole mesh; a bare one will do. O(elements x entries)
[[nodiscard]] std::string sudden_motion_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
