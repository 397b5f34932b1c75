#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// Reference distance of every node to the free surface of its own solid, m.
///
/// A solid is a body, or the bodies glued to it: elements that share nodes. Its free surface are the faces without a
/// neighbour in the topology, from which joints broken from the start are cut. Nodes of a free face: 0, exactly. Other
/// nodes of an element that has a corner on the free surface: the exact distance to the nearest free triangle. All
/// other nodes, deeper inside: a lower bound, the smallest height above the opposite face among the node's elements;
/// the ball of that radius lies inside those elements, so no free triangle meets it. The bound is positive. A solid
/// without free surface cannot be meshed, so every value is finite.
///
/// @return (num_nodes); the value of corner c of element e is that of node mesh.elements[e][c]
/// O(n log n) in the free faces, throws nothing. @pre mesh is finished, topology belongs to it.
[[nodiscard]] std::vector<double> nodal_surface_distance(const Mesh& mesh, const Topology& topology);

}  // namespace breccia
