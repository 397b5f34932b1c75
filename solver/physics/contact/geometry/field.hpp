#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/surface_depth.hpp"
#include "physics/contact/geometry/overlap.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// The overlap field of a body, made of the depths D_a of its nodes (mesh/surface_depth.hpp) and, of every element, of
/// the sets S of its corners that lie on one face of the free surface:
///
///   g = min_S sum_(a not in S) lambda_a D_a,   sum_a lambda_a D_a where the element has no corner on the surface
///
/// Each sum is the distance to the surface that S lies on, exactly so where that is flat and D_a the distance to it: in
/// a wall one element thick that cannot break, g is the distance to the nearer side. A face of an element that lies on
/// the surface counts by its distance, D_a or the height above it if that is less. In a body that cannot break, g of an
/// element at the surface is the least of its distances to the sides around it instead (mesh/surface_planes.hpp): exact
/// beside edges too. On a face between two elements g
/// depends on the nodes of the face alone, so it is continuous. For a lone tetrahedron g is the distance to its nearest
/// face.
///
/// Fracture adds sets: the corners of an element at the nodes of a freed face. A new set comes to count within
/// ContactParams::ramp_steps steps: its own depths go from D_a to 0. The D_a themselves stay, so in what can break they
/// are such that g is not steep wherever a crack will run.
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

/// One step of all ramps; what they were is kept in FieldRamp::before until the next call. O(ramps).
void advance_field(ContactState& contact);

enum class Instant { now, step_before };

/// Coefficients of g for a contactor, its ramps included.
[[nodiscard]] OverlapShape overlap_shape(const ContactParams& params, const LocalMesh& local,
                                         const ContactState& contact, Index contactor, Instant instant = Instant::now);

/// Whether the sides of a contactor are distinguished (rows_for in overlap.hpp).
[[nodiscard]] inline bool has_sides(const ContactParams& params, const ContactState& contact, Index contactor) {
  return params.field == OverlapField::body &&
         (contact.field[static_cast<std::size_t>(contactor)].sets & kFractured) == 0;
}

/// Number of an element's faces on the surface.
[[nodiscard]] inline std::size_t num_faces(CornerSets sets) {
  const auto bit = [sets](int set) { return static_cast<std::size_t>(sets >> set & 1); };
  return bit(7) + bit(11) + bit(13) + bit(14);
}

/// Whether it has more than one.
[[nodiscard]] inline bool has_several_sides(const ContactParams& params, const ContactState& contact, Index contactor) {
  const CornerSets sets = contact.field[static_cast<std::size_t>(contactor)].sets;
  if (!has_sides(params, contact, contactor)) return false;
  return (sets & kExact) == 0 ? (sets & (sets - 1)) != 0 : num_planes(sets) + num_faces(sets) > 1;
}

/// One of the sums of an element.
struct OverlapFunction {
  double g = 0;                 ///< m, its value at a place
  std::array<double, 4> row{};  ///< m, its coefficients
};

/// Bits of CornerSets: sets of three corners, and the others.
inline constexpr unsigned kFaceSets = 1U << 7 | 1U << 11 | 1U << 13 | 1U << 14;
inline constexpr unsigned kSmallSets = ((1U << kNumCornerSets) - 2) & ~kFaceSets;

/// least_function() for any sets.
[[nodiscard]] OverlapFunction least_function_of_sets(const std::array<double, 4>& height, const FieldValues& values,
                                                     const std::array<double, 4>& lambda);

/// The least sum of the field `body` at lambda where no ramp runs: the same bits as by overlap_shape() and least_row(),
/// without the others' coefficients. @param height  heights() of the element
[[nodiscard]] inline OverlapFunction least_function(const std::array<double, 4>& height, const FieldValues& values,
                                                    const std::array<double, 4>& lambda) {
  const auto sets = static_cast<unsigned>(values.sets);
  if ((sets & (kSmallSets | kExact)) != 0 || (sets & kFaceSets) == 0)
    return least_function_of_sets(height, values, lambda);
  // An element that meets the surface with faces alone, as all of what has come apart: each of its sums has one term.
  double least = std::numeric_limits<double>::infinity();
  std::size_t opposite = 0;
  for (const std::size_t a : {3, 2, 1, 0}) {
    if ((sets >> (15U ^ 1U << a) & 1U) == 0) continue;
    const double g = lambda[a] * std::min(values.depth[a], height[a]);
    if (!(g < least)) continue;
    least = g;
    opposite = a;
  }
  OverlapFunction function{least, {}};
  function.row[opposite] = std::min(values.depth[opposite], height[opposite]);
  return function;
}

/// Coefficients of g for one element. @param height  heights() of it;  @param length  H of its body, m
/// @param coming  of a ramp, or null: none
[[nodiscard]] OverlapShape overlap_shape(const ContactParams& params, const std::array<double, 4>& height,
                                         const FieldValues& values, double length, const ComingSets* coming = nullptr);

/// Heights of an element's corners above their opposite faces, at rest, m.
[[nodiscard]] std::array<double, 4> heights(const LocalMesh& local, Index slot);

}  // namespace breccia
