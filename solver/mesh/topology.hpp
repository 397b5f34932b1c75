#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {

/// What lies across one face of an element.
///
/// code = 3 * face_of_neighbour + rotation. Corner i (0..2) of the own face coincides in the reference mesh with
/// corner (rotation - i) mod 3 of the neighbour's face: the neighbour sees the face with the opposite sense.
struct FaceLink {
  Index neighbour = kFree;  ///< element across the face, or one of the below
  std::int8_t code = 0;     ///< 0..11

  static constexpr Index kFree = -1;    ///< the free surface
  static constexpr Index kBeyond = -2;  ///< in a piece of a mesh: an element that the piece does not hold

  [[nodiscard]] bool free() const { return neighbour == kFree; }
  [[nodiscard]] bool inner() const { return neighbour >= 0; }
  [[nodiscard]] int face() const { return code / 3; }
  [[nodiscard]] int rotation() const { return code % 3; }
};

/// Neighbours of every element through its four faces. Faces join elements that share the same three nodes.
struct Topology {
  std::vector<std::array<FaceLink, 4>> links;  ///< (num_elements)

  /// A face of an element.
  struct Face {
    Index element;
    int face;
  };
  /// In a piece of a mesh: the element behind a face whose link is kBeyond.
  struct Beyond {
    Face face;
    GlobalId neighbour;
  };
  std::vector<Beyond> beyond;                     ///< by element, face
  std::vector<std::vector<Face>> surface_groups;  ///< (surface_groups) faces of each physical surface; an inner
                                                  ///< surface lists both sides
};

/// Id of the element across a face, here or beyond; -1: the free surface. O(log beyond) where it is beyond.
[[nodiscard]] GlobalId neighbour_id(const Mesh& mesh, const Topology& topology, Index element, int face);

/// O(num_elements). Throws InputError when three elements share a face or a physical surface names a triangle that is
/// no face of any element.
[[nodiscard]] Topology build_topology(const Mesh& mesh);

}  // namespace breccia
