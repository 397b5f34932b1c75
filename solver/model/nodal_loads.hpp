#pragma once

#include "case/case.hpp"
#include "model/model.hpp"
#include "physics/nodal_load.hpp"

namespace breccia {

/// What the groups of a mesh share a force by. O(elements + faces of surfaces + corner tags)
/// @param model  the whole one, with its corner tags
[[nodiscard]] GroupSizes group_sizes(const Model& model);

/// A force on a group, shared among its nodes: of a surface, by the area of its faces at rest, a third of each to every
/// corner; of a volume, a curve or a point, by the mass of its elements or of those around its nodes, a quarter of each
/// to every corner.
[[nodiscard]] NodalLoad nodal_load(const case_::Force& force, const Model& model);

}  // namespace breccia
