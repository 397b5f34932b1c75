#pragma once

#include <vtkUnstructuredGrid.h>

#include <map>
#include <vector>

#include "render/vectors.hpp"

namespace breccia::gui {

/// By body.
using BodyCentres = std::map<int, Vector>;

/// Centres of mass of the bodies, about which they turn and from which they are stretched at the start. O(elements).
/// @param elements   with "material" and "body"; nullptr: unknown
/// @param densities  kg/m3, by the number in "material"; beyond the end, or 0: of 1
[[nodiscard]] BodyCentres centres_of(vtkUnstructuredGrid* elements, const std::vector<double>& densities);

}  // namespace breccia::gui
