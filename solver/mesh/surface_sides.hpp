#pragma once

#include <bit>

#include "mesh/corner_sets.hpp"

namespace breccia {

/// Sides of the free surface that an element meets, in one number: its faces on the surface at rest, the count of
/// further sides at rest, which it meets with an edge or a corner (mesh/surface_planes.hpp), and the sets of its
/// corners that fracture has brought onto one face of the surface each.
///
/// bits 1 to 14: CornerSets by fracture;  15 to 18: face opposite to corner 0 to 3;  19 to 21: number of further sides
using SurfaceSides = Index;

inline constexpr int kFacesBit = 15, kPlanesBit = 19;
inline constexpr SurfaceSides kOwnFaces = 15 << kFacesBit;
static_assert(kMostSides < 8);

/// With the face opposite to a corner.
[[nodiscard]] constexpr SurfaceSides with_face(std::size_t opposite) {
  return SurfaceSides{1} << (kFacesBit + static_cast<int>(opposite));
}
[[nodiscard]] constexpr SurfaceSides with_planes(std::size_t count) {
  return static_cast<SurfaceSides>(count) << kPlanesBit;
}

[[nodiscard]] constexpr bool has_face(SurfaceSides sides, std::size_t opposite) {
  return (sides & with_face(opposite)) != 0;
}
[[nodiscard]] constexpr std::size_t num_faces(SurfaceSides sides) {
  return static_cast<std::size_t>(std::popcount(static_cast<unsigned>(sides & kOwnFaces)));
}
[[nodiscard]] constexpr std::size_t num_planes(SurfaceSides sides) {
  return static_cast<std::size_t>(sides) >> kPlanesBit;
}
/// Whether fracture has added sides.
[[nodiscard]] constexpr bool is_fractured(SurfaceSides sides) { return (sides & kAllSets) != 0; }

/// Whether some corners lie on one face of the surface, by fracture or as part of a face of the element.
[[nodiscard]] inline bool on_one_face(SurfaceSides sides, unsigned corners) {
  for (std::size_t a = 0; a < 4; ++a) {
    if (has_face(sides, a) && (corners >> a & 1U) == 0) return true;
  }
  return covers(sides, corners);
}

}  // namespace breccia
