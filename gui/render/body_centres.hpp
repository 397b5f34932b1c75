#pragma once

#include <vtkUnstructuredGrid.h>

#include <map>

#include "render/vectors.hpp"

namespace breccia::gui {

/// By body.
using BodyCentres = std::map<int, Vector>;

/// Centres of mass of the parts of the bodies that a volume group has: of one material, so those of their volumes.
/// O(elements).
/// @param elements  with "material" and "body"; nullptr: unknown
/// @param group     its number in "material"
[[nodiscard]] BodyCentres centres_of(vtkUnstructuredGrid* elements, int group);

}  // namespace breccia::gui
