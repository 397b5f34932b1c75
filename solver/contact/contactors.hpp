#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_depth.hpp"

namespace breccia {

/// Which elements of a whole model others may touch, and from what their overlap field is made.
struct Contactors {
  std::vector<std::uint8_t> chosen;  ///< (elements) 1: of a breakable group, or with a node on the free surface or
                                     ///< on the border to another group
  SurfaceDepth surface;
  double size = 0;  ///< m, mean: the edge of the regular tetrahedron of their mean volume
};

/// @param breakable  (volume groups) inner faces may be freed;  @param across  axis of a plane model, whose sides are
/// no surface, -1: none. O(elements).
[[nodiscard]] Contactors choose_contactors(const std::vector<bool>& breakable, const Mesh& mesh,
                                           const Topology& topology, int across = -1);

}  // namespace breccia
