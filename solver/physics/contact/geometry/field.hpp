#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/surface_depth.hpp"
#include "physics/contact/geometry/overlap.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// The overlap field of a body. In an element that meets the surface it is the least of some linear functions:
///
///   g = min( lambda_a h_a   of each of its faces on the surface at rest, h_a the height of the opposite corner,
///            sum_a lambda_a d_a   of each further side that it meets at rest (mesh/surface_planes.hpp),
///            sum_(a not in S) lambda_a D_a   of each set S of its corners that fracture has brought onto the surface )
///
/// and sum_a lambda_a D_a in elements inside, D_a the depths of the nodes (mesh/surface_depth.hpp). At rest it is the
/// distance to the surface, exact and continuous beside edges too; of a face that fracture has freed D_a counts, or the
/// height if that is less.
///
/// Sides at rest that an element meets with an edge or a corner count until all of its faces there are free: then it
/// has come off what they belong to.
///
/// H, the length that makes the overlap dimensionless, is the mean inradius of a body's elements.

/// Fills `field` for the contactors in `contact.contactors`. @param surface  of the model's mesh. O(num_slots).
void build_field(const ContactParams& params, const Mesh& mesh, const LocalMesh& local, const SurfaceDepth& surface,
                 ContactState& contact);

/// The same for one element of the mesh.
[[nodiscard]] FieldValues field_at_rest(OverlapField field, const Mesh& mesh, Index element,
                                        const SurfaceDepth& surface);

/// The corners of a set (mesh/corner_sets.hpp) have come to lie on one face of the free surface. Nothing happens for
/// fields other than `body`, or when they lie on one already.
void free_corners(const ContactParams& params, Index contactor, unsigned set, ContactState& contact);

/// What fields were before the last changes is forgotten.
void end_changes(ContactState& contact);

enum class Instant { now, step_before };

/// Coefficients of g for a contactor.
[[nodiscard]] OverlapShape overlap_shape(const ContactParams& params, const LocalMesh& local,
                                         const ContactState& contact, Index contactor, Instant instant = Instant::now);

/// Whether the sides of a contactor are distinguished (rows_for in overlap.hpp).
[[nodiscard]] inline bool has_sides(const ContactParams& params, const ContactState& contact, Index contactor) {
  return params.field == OverlapField::body && !is_fractured(contact.field[static_cast<std::size_t>(contactor)].sides);
}

/// Whether it has more than one.
[[nodiscard]] inline bool has_several_sides(const ContactParams& params, const ContactState& contact, Index contactor) {
  const SurfaceSides sides = contact.field[static_cast<std::size_t>(contactor)].sides;
  return has_sides(params, contact, contactor) && num_planes(sides) + num_faces(sides) > 1;
}

/// One of the functions of an element.
struct OverlapFunction {
  double g = 0;                 ///< m, its value at a place
  std::array<double, 4> row{};  ///< m, its coefficients
};

/// Bits of CornerSets: sets of three corners, and the others.
inline constexpr CornerSets kFaceSets = 1 << 7 | 1 << 11 | 1 << 13 | 1 << 14;
inline constexpr CornerSets kSmallSets = kAllSets & ~kFaceSets;

/// least_function() for any sides.
[[nodiscard]] OverlapFunction least_of_all_functions(const std::array<double, 4>& height, const FieldValues& values,
                                                     const std::array<double, 4>& lambda);

/// The least function of the field `body` at lambda: the same bits as by overlap_shape() and
/// least_row(), without the others' coefficients. @param height  heights() of the element
[[nodiscard]] inline OverlapFunction least_function(const std::array<double, 4>& height, const FieldValues& values,
                                                    const std::array<double, 4>& lambda) {
  const bool only_faces = (values.sides & ~(kFaceSets | kOwnFaces)) == 0 && values.sides != 0;
  if (!only_faces) return least_of_all_functions(height, values, lambda);
  // An element that meets the surface with faces alone, as all of what has come apart: each function has one term.
  double least = std::numeric_limits<double>::infinity(), slope = 0;
  std::size_t opposite = 0;
  const auto consider = [&](std::size_t a, double depth) {
    const double g = lambda[a] * depth;
    if (!(g < least)) return;
    least = g;
    slope = depth;
    opposite = a;
  };
  for (const std::size_t a : {3, 2, 1, 0}) {
    if (has_face(values.sides, a)) consider(a, height[a]);
  }
  for (const std::size_t a : {3, 2, 1, 0}) {
    if ((values.sides >> face_set(a) & 1) != 0) consider(a, std::min(values.depth[a], height[a]));
  }
  OverlapFunction function{least, {}};
  function.row[opposite] = slope;
  return function;
}

/// Coefficients of g for one element. @param height  heights() of it;  @param length  H of its body, m
[[nodiscard]] OverlapShape overlap_shape(const ContactParams& params, const std::array<double, 4>& height,
                                         const FieldValues& values, double length);

/// Heights of an element's corners above their opposite faces, at rest, m.
[[nodiscard]] std::array<double, 4> heights(const LocalMesh& local, Index slot);

}  // namespace breccia
