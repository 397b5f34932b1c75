#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/types.hpp"
#include "discretisation/local_mesh.hpp"
#include "mesh/corner_sets.hpp"
#include "physics/contact/geometry/tetra.hpp"
#include "physics/contact/params.hpp"

namespace breccia {

/// Overlaps of this share of H and less that the mesh comes with are round-off: bodies touch there without force.
inline constexpr double kOverlapTolerance = 1e-6;

/// Of an element: one for each face and for each side at rest, and one for each smaller set of corners.
inline constexpr std::size_t kMostFunctions = 4 + kMostSides + 10;

[[nodiscard]] inline PreparedTetra prepare(const std::array<Vec3, 4>& x, double reference_volume) {
  return prepared_tetra<double>(x, reference_volume);
}

[[nodiscard]] inline bool inert(const PreparedTetra& tetra) { return !(tetra.gradient[0][0] == tetra.gradient[0][0]); }

/// False for NaN.
[[nodiscard]] inline bool inside(const std::array<double, 4>& lambda) {
  return (lambda[0] >= -kInside) & (lambda[1] >= -kInside) & (lambda[2] >= -kInside) & (lambda[3] >= -kInside);
}

[[nodiscard]] inline double smallest(const std::array<double, 4>& lambda) {
  return std::min(std::min(lambda[0], lambda[1]), std::min(lambda[2], lambda[3]));
}

/// g of one element is the least of some linear functions sum_a row[a] lambda_a, m. Each is the distance to one side of
/// the surface, whose normal is along the gradient of the function.
struct OverlapShape {
  std::array<std::array<double, 4>, kMostFunctions> row;
  std::size_t rows = 0;
  OverlapShape() = default;
  OverlapShape(const OverlapShape& other) { *this = other; }
  /// Of those in use alone: most shapes have one or two.
  OverlapShape& operator=(const OverlapShape& other) {
    rows = other.rows;
    std::copy_n(other.row.begin(), rows, row.begin());
    return *this;
  }
  void add(const std::array<double, 4>& function) { row[rows++] = function; }
};

/// Overlap and its gradient with respect to the point; that with respect to corner a is -lambda_a gradient.
struct Overlap {
  double g = 0;            ///< m, > 0 inside
  Vec3 gradient{0, 0, 0};  ///< -, points inwards
};

/// A function's value, m.
[[nodiscard]] inline double row_value(const std::array<double, 4>& row, const std::array<double, 4>& lambda) {
  return lambda[0] * row[0] + lambda[1] * row[1] + lambda[2] * row[2] + lambda[3] * row[3];
}
/// @pre 0 <= k < rows
[[nodiscard]] inline double row_value(const OverlapShape& shape, std::size_t k, const std::array<double, 4>& lambda) {
  return row_value(shape.row[k], lambda);
}

/// Gradient of a linear function of lambda with respect to the point. @param slope  its values at the corners
[[nodiscard]] inline Vec3 gradient_of(const std::array<double, 4>& slope, const PreparedTetra& tetra) {
  Vec3 gradient = Vec3::Zero();
  for (std::size_t c = 1; c < 4; ++c) {
    const std::array<double, 3>& row = tetra.gradient[c - 1];
    gradient += (slope[c] - slope[0]) * Vec3(row[0], row[1], row[2]);
  }
  return gradient;
}

/// That of one of the functions: inwards, against the normal of its side. @pre 0 <= k < rows
[[nodiscard]] inline Vec3 row_gradient(const OverlapShape& shape, std::size_t k, const PreparedTetra& tetra) {
  return gradient_of(shape.row[k], tetra);
}

/// Some of an element's functions: bit k for the k-th.
using OverlapRows = std::uint32_t;
inline constexpr OverlapRows kAllRows = (1U << kMostFunctions) - 1;

/// How much the sides of the surface face another face: by the cosine of the angle between their outward normals.
enum class Facing : std::uint8_t {
  away,
  barely,  ///< at most -kBarelyFacing: sides of what is sharp and, on a block that bulges, those beside the loaded one
  well     ///< at most -kWellFacing
};
/// Small, so that sharp edges are detected: a wedge on a flat face from an opening of 1.2 degrees on, two crossed
/// ridges, whose sides face each other less, from 11.5 degrees on.
inline constexpr double kBarelyFacing = 0.01;
/// Sides of a body that is squeezed tilt by some degrees. Were they to count as well, points of the platens next to its
/// edges would push it sideways: 0.08 % of the energy went there.
inline constexpr double kWellFacing = 0.1;

/// @param outward  normal of the face, of any length
/// @param inward   against the normal of the side, of any length
[[nodiscard]] inline Facing facing(const Vec3& outward, const Vec3& inward) {
  const double along = outward.dot(inward), most = outward.norm() * inward.norm();
  if (along >= kWellFacing * most) return Facing::well;
  return along >= kBarelyFacing * most ? Facing::barely : Facing::away;
}

/// Directions of the surface at a point, outwards, of any length.
struct Outward {
  Vec3 face{0, 0, 0};    ///< normal of its face
  Vec3 corner{0, 0, 0};  ///< mean normal of the faces around the corner that it is at; zero: it is at none
};

[[nodiscard]] inline Facing facing(const Outward& outward, const Vec3& inward) {
  const Facing face = facing(outward.face, inward);
  return outward.corner == Vec3::Zero() ? face : std::max(face, facing(outward.corner, inward));
}

/// The functions that apply to a point, where sides are distinguished: those whose side faces it the most, through
/// which the point enters, also just beside an edge, where another side is nearer; all where there is none. Not for
/// elements at cracks, whose new sides would produce energy if they were distinguished.
[[nodiscard]] inline OverlapRows rows_for(const OverlapShape& shape, const PreparedTetra& tetra,
                                          const Outward& outward) {
  OverlapRows rows = 0;
  Facing most = Facing::barely;
  for (std::size_t k = 0; k < shape.rows; ++k) {
    const Facing here = facing(outward, row_gradient(shape, k, tetra));
    if (here < most) continue;
    rows = (here > most ? 0 : rows) | OverlapRows{1} << k;
    most = here;
  }
  return rows != 0 ? rows : kAllRows;
}

/// The function that is the least at lambda, of those in `rows`; of equal ones the first.
[[nodiscard]] inline std::size_t least_row(const OverlapShape& shape, const std::array<double, 4>& lambda,
                                           OverlapRows rows = kAllRows) {
  auto least = static_cast<std::size_t>(std::countr_zero(rows));
  for (std::size_t k = least + 1; k < shape.rows; ++k) {
    if ((rows >> k & 1U) != 0 && row_value(shape, k, lambda) < row_value(shape, least, lambda)) least = k;
  }
  return least;
}

[[nodiscard]] inline double overlap_value(const OverlapShape& shape, const std::array<double, 4>& lambda,
                                          OverlapRows rows = kAllRows) {
  return row_value(shape, least_row(shape, lambda, rows), lambda);
}

[[nodiscard]] inline Overlap overlap(const OverlapShape& shape, const PreparedTetra& tetra,
                                     const std::array<double, 4>& lambda, OverlapRows rows = kAllRows) {
  const std::size_t least = least_row(shape, lambda, rows);
  return {row_value(shape, least, lambda), row_gradient(shape, least, tetra)};
}

/// Corners of an element out of a nodal field.
[[nodiscard]] inline std::array<Vec3, 4> load_corners(const LocalMesh& local, const double* field, Index slot) {
  return {load_node(field, local.corner_node(slot, 0)), load_node(field, local.corner_node(slot, 1)),
          load_node(field, local.corner_node(slot, 2)), load_node(field, local.corner_node(slot, 3))};
}

}  // namespace breccia
