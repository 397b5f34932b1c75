#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"
#include "mesh/triangle_tree.hpp"

namespace breccia {

/// Nodes of a free face, seen from outside counter-clockwise.
using FreeFace = std::array<Index, 3>;

/// The faces without a neighbour. O(elements).
[[nodiscard]] std::vector<FreeFace> free_faces(const Mesh& mesh, const Topology& topology);

/// Outward unit normal.
[[nodiscard]] Vec3 normal_of(const Mesh& mesh, const FreeFace& face);

/// Calls f(node, tree) for each of the nodes, in any order, with the tree of all free faces of its solid: a body, or
/// the bodies glued to it, whose elements share nodes. A tree is built only if a node needs it.
void for_each_with_tree(const Mesh& mesh, std::span<const FreeFace> faces, std::vector<Index> nodes,
                        const std::function<void(Index, const TriangleTree&)>& f);

}  // namespace breccia
