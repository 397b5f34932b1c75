#pragma once

#include <span>
#include <vector>

#include "physics/contact/contact_params.hpp"
#include "physics/contact/contact_state.hpp"

namespace breccia {

/// The overlap field of a body: g = sum_a lambda_a Phi_a + 4 min(lambda) Phi_c.
///
/// Phi of a corner is 0 on the free surface, elsewhere the distance of the mesh vertex to it, as
/// mesh/point_distance.hpp gives it: exact in the first layer of elements; deeper inside only a size of the elements
/// there, so that the field is not steep where a crack runs through the deep inside. Phi_c is the inradius of an
/// element with all its corners on the surface, else 0; the bubble vanishes on faces, so g is continuous from element
/// to element. For a lone tetrahedron g = 4 min(lambda) inradius.
///
/// H, the length that makes the overlap dimensionless, is the mean inradius of a body's elements.

/// Fills `field` for the contactors in `contact.contactors`.
/// @param surface_distance  (mesh vertices) m, 0 on the free surface
/// O(num_slots).
void build_field(const ContactParams& params, const LocalMesh& local, std::span<const double> surface_distance,
                 ContactState& contact);

/// The same for one element. @param surface_distance  of its corners, m;  @param corners  m, reference
[[nodiscard]] FieldValues field_at_rest(OverlapField field, const std::array<double, 4>& surface_distance,
                                        const std::array<Vec3, 4>& corners);

/// The corner has come to lie on the free surface: its Phi goes to 0 within `ramp_steps` steps, and if it was the last
/// inner corner the bubble rises to the inradius. Nothing happens for fields other than `body`, or when it lies there
/// already.
void free_corner(const ContactParams& params, const LocalMesh& local, Index contactor, int corner,
                 ContactState& contact);

/// One step of all ramps; what a value was is kept in FieldRamp::before until the next call. O(ramps).
void advance_field(ContactState& contact);

/// Coefficients of g for one element. @param length  H of its body, m
[[nodiscard]] OverlapShape overlap_shape(OverlapField field, const LocalMesh& local, Index slot,
                                         const FieldValues& values, double length);

}  // namespace breccia
