#pragma once

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
/// the surface counts by its distance, D_a or the height above it if that is less. On a face between two elements g
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

/// Whether it has more than one.
[[nodiscard]] inline bool has_several_sides(const ContactParams& params, const ContactState& contact, Index contactor) {
  const auto sets = static_cast<unsigned>(contact.field[static_cast<std::size_t>(contactor)].sets);
  return has_sides(params, contact, contactor) && (sets & (sets - 1)) != 0;
}

/// One of the sums of an element.
struct OverlapFunction {
  double g = 0;                 ///< m, its value at a place
  std::array<double, 4> row{};  ///< m, its coefficients
};

/// The least sum of the field `body` at lambda where no ramp runs: the same bits as by overlap_shape() and least_row(),
/// without the others' coefficients. @param height  heights() of the element
[[nodiscard]] OverlapFunction least_function(const std::array<double, 4>& height, const FieldValues& values,
                                             const std::array<double, 4>& lambda);

/// Coefficients of g for one element. @param height  heights() of it;  @param length  H of its body, m
/// @param coming  of a ramp, or null: none
[[nodiscard]] OverlapShape overlap_shape(const ContactParams& params, const std::array<double, 4>& height,
                                         const FieldValues& values, double length, const ComingSets* coming = nullptr);

/// Heights of an element's corners above their opposite faces, at rest, m.
[[nodiscard]] std::array<double, 4> heights(const LocalMesh& local, Index slot);

}  // namespace breccia
