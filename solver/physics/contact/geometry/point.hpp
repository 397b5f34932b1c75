#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "base/types.hpp"
#include "discretisation/local_mesh.hpp"

namespace breccia {

/// Ids kept for the contact points of an element, and of each of its faces.
inline constexpr GlobalId kPointsAnElement = 24, kPointsAFace = 6;

/// Target: an integration point on a free face.
struct ContactPoint {
  GlobalId id = 0;  ///< kPointsAnElement element + kPointsAFace face + k: the same on any number of ranks
  Index slot = 0;   ///< element it lies on
  std::int8_t face = 0;
  std::uint8_t k = 0;          ///< 0..points_per_face-1
  std::array<Index, 3> nodes;  ///< of the face's corners
  double weight = 0;           ///< m2, share of the reference area
};

/// Points of a triangle: x = sum_i shape[k][i] x_i, weight = share[k] area.
struct FaceRule {
  int num_points = 0;
  std::array<std::array<double, 3>, 6> shape{};
  std::array<double, 6> share{};
};

/// @param points_per_face  1: centroid; 3: (2/3, 1/6, 1/6) and its permutations, exact for quadratic integrands;
///                         4: the corners with 1/12 each and the centroid with 3/4, exact for quadratic integrands;
///                         6: the symmetric rule of degree 4. Source: [Strang and Fix 1973]
/// Throws InternalError for any other number.
[[nodiscard]] const FaceRule& face_rule(int points_per_face);

/// Corner of the face, 0 to 2, that a point with this shape function is at; -1: it is at none.
[[nodiscard]] inline int corner_of_face(const std::array<double, 3>& shape) {
  for (int i = 0; i < 3; ++i) {
    if (shape[static_cast<std::size_t>(i)] == 1) return i;
  }
  return -1;
}

/// Appends the points of one face, k ascending.
void append_points(const FaceRule& rule, const LocalMesh& local, Index slot, int face,
                   std::vector<ContactPoint>& points);

/// Position (or velocity) of a point out of a nodal field.
[[nodiscard]] inline Vec3 at_point(const FaceRule& rule, const ContactPoint& point, const double* field) {
  const std::array<double, 3>& shape = rule.shape[static_cast<std::size_t>(point.k)];
  return shape[0] * load_node(field, point.nodes[0]) + shape[1] * load_node(field, point.nodes[1]) +
         shape[2] * load_node(field, point.nodes[2]);
}

/// Normal of a point's face, outwards, twice as long as the face is large.
/// @param place  of a node, m
template <class Place>
[[nodiscard]] Vec3 outward_normal(const ContactPoint& point, Place&& place) {
  const Vec3 corner = place(point.nodes[0]);
  return (place(point.nodes[1]) - corner).cross(place(point.nodes[2]) - corner);
}

}  // namespace breccia
