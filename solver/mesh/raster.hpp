#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "mesh/finish.hpp"

namespace breccia {

/// Raster of boxes, each a body of its own; the built-in mesh generator.
struct RasterSource {
  std::array<int, 3> cells{1, 1, 1};  ///< cubes of one box along x, y, z
  Vec3 cell_size{1, 1, 1};            ///< m, edges of a cube
  std::array<int, 3> boxes{1, 1, 1};  ///< boxes along x, y, z
  Vec3 gap{0, 0, 0};                  ///< m, between neighbouring boxes
  Vec3 origin{0, 0, 0};               ///< m, lowest corner of the first box
  std::string group = "raster";       ///< volume group of every box
  bool single_tetrahedra = false;     ///< each box is one regular tetrahedron of edge cell_size.x instead of cubes
  bool random_orientation = false;    ///< turn every box about its centre by a random rotation, uniform over rotations
  std::uint64_t seed = 1;

  /// Faces whose three corners lie in the closed box [lower, upper], m, before boxes are turned.
  struct Slit {
    Vec3 lower{0, 0, 0};
    Vec3 upper{0, 0, 0};
  };
  std::optional<Slit> slit = std::nullopt;
};

/// The raster as a finished mesh.
///
/// A cube is cut into 24 tetrahedra: each of its six faces into four triangles about the face's centre, all with the
/// cube's centre as apex. Conforming inside a box. Box (i, j, k) is body i + boxes.x (j + boxes.y k). A single
/// tetrahedron has its centroid in the centre of a cell of cell_size and its corners on alternate corners of a cube.
///
/// Surface groups: `<group>.x0`, `.x1`, `.y0`, `.y1`, `.z0`, `.z1` (lower and upper side of every box, turned with it;
/// none for single tetrahedra) and `<group>.slit` if there is a slit.
///
/// The rotation of a box depends on the seed and the box's number alone and uses nothing but integer arithmetic,
/// + - * / and sqrt: the same seed gives the same mesh on every machine.
///
/// O(n log n) in the elements. Throws InputError: a count below 1, sizes or gaps that are not finite or negative, more
/// elements than an Index can number, single tetrahedra with more than one cell a box, a slit that is no plane
/// or meets no face.
[[nodiscard]] FinishedMesh make_raster(const RasterSource& source);

}  // namespace breccia
