#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// Free faces that lie against another one of their body, as the sides of a slit do: they can meet their own body where
/// it is. To be found in the whole mesh at rest, as the sides may come to lie on different ranks.
/// @return  (elements) a bit a face. O(free faces log free faces).
[[nodiscard]] std::vector<std::uint8_t> torn_faces(const Mesh& mesh, const Topology& topology);

}  // namespace breccia
