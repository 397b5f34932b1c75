#pragma once

#include "base/exact_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "discretisation/nodal_state.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// Pushes contact points beyond the sphere around the model back into it: force w penalty / H (r - radius - offset)
/// towards its centre, offset: where the point was first seen outside; less in the steps in which a point comes out or
/// goes back. Nothing without a sphere.
/// @param dt  s, of the last step
/// @param contact  its boundary forces and offsets are written
/// @param stored   J, added to: what the forces on points of this rank's originals hold
void spherical_boundary(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                        ContactState& contact, NodalForces& forces, ExactSum& stored);

}  // namespace breccia
