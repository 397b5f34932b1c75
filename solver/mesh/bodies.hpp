#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// (elements) A bit a face that belongs to one of these physical surfaces, on both sides of an inner one; names that
/// the mesh does not have are ignored. O(faces of the surfaces + elements).
[[nodiscard]] std::vector<std::uint8_t> faces_of_surfaces(const Mesh& mesh, const Topology& topology,
                                                          std::span<const std::string> surfaces);

/// The bodies of a mesh: a body is what moves together at the start, elements that are connected through faces which
/// they have in common, by shared nodes or by joints. So volumes that are glued are one body, a volume that is cut
/// through is several, and one that is partly cut is one; to meet in an edge or a point connects nothing.
struct Bodies {
  std::vector<Index> of_element;  ///< (elements) 0..count-1, by ascending lowest volume, then lowest element
  Index count = 0;
};

/// @param mesh  whole and sorted;  @param cut  (elements) a bit a face across which nothing holds; empty: none.
/// O(elements), throws nothing.
[[nodiscard]] Bodies find_bodies(const Mesh& mesh, const Topology& topology, std::span<const std::uint8_t> cut = {});

/// Makes them the bodies of the mesh.
void number_bodies(const Topology& topology, std::span<const std::uint8_t> cut, Mesh& mesh);

}  // namespace breccia
