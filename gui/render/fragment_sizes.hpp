#pragma once

#include <vtkUnstructuredGrid.h>

namespace breccia::gui {

inline constexpr const char* kFragmentSize = "fragment_size";  ///< array of elements, m

/// Adds to each element the diameter of the sphere that has the volume of its fragment; nothing where the array
/// "fragment" is missing. O(elements)
/// @return  whether there are more fragments than bodies
bool add_fragment_sizes(vtkUnstructuredGrid& elements);

}  // namespace breccia::gui
