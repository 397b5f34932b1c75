#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

namespace breccia {

/// Volumes of one group, or of any where mesh.glue is true, and bodies of one volume, that lie face to face and are not
/// joined there: the faces coincide within 1e-9 of the mesh's size, but have nodes of their own. Surfaces that the case
/// breaks and the boxes of a raster are meant to be apart. The one place from which `check`, `run` and `mesh` have it.
/// O(elements).
[[nodiscard]] Advice unjoined_volumes(const case_::Case& input, const Mesh& mesh, const Topology& topology);

/// Initial velocities that turn, stretch or draw for one part of a body and not for the rest of it, which is joined to
/// that part. O(elements x entries).
[[nodiscard]] Advice parts_in_motion(const case_::Case& input, const Model& model);

}  // namespace breccia
