#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// Slender solids that are few elements thick: linear tetrahedra are too stiff in bending, whose strain varies across
/// an element. Measured on cantilevers: deflection over that of theory = 1 / (1 + c (e/t)^2), e the edge of the regular
/// tetrahedron of the mean volume, t the thickness, c = 2.2 to 2.6 in unstructured meshes (e/t of 0.3 to 0.74) and 1.0
/// to 1.8 in rasters. @param model  of the whole mesh. O(elements)
[[nodiscard]] Advice bending_advice(const case_::Case& input, const Model& model);

}  // namespace breccia
