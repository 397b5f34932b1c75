#pragma once

#include <array>
#include <functional>

#include "base/exact_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "discretisation/nodal_state.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"
#include "physics/sweep.hpp"

namespace breccia {

/// What contact holds and has consumed, J, by the points of this rank's originals. `stored` and `friction_stored`
/// belong to the last call, the dissipated ones add up over the run.
struct ContactWork {
  ExactSum stored;               ///< normal overlap and spherical boundary
  ExactSum friction_stored;      ///< tangential springs
  ExactSum dissipated;           ///< normal law; also what a moving overlap field or a crack under a point takes away
  ExactSum friction_dissipated;  ///< sliding
  std::int64_t touching = 0;     ///< couples that press on each other
};

/// Forces of all couples and of the spherical boundary at t_n.
///
///   normal    f_p = -w sigma(d) grad g,  d = max(0, g - offset) / H,  the negative gradient of w H integral sigma dd
///             with damping normal_law::damped in place of sigma
///   friction  friction.hpp with k = tangential_ratio w sigma_p / H, limit mu f, where f follows w sigma |grad g| with
///             a delay of up to friction_delay times the extent of the smaller body
///   target    + N_i f_p on the corners of its face;  contactor: - lambda_a f_p on its corners
///
/// so linear and angular momentum are conserved to round-off for any direction of f_p. History: a couple keeps its
/// TouchingCouple while it touches; when the point has moved to another contactor of the same body that shares a mesh
/// vertex with the old one the history is kept. A new couple starts with offset = g if point and contactor share a mesh
/// vertex or if fracture has just made it, else with 0, so that freeing a face makes no force.
/// If a new couple is deeper than its point has moved inwards, the excess is its offset.
/// Sides: in a body of ordinary finite elements g is the least of those sums (geometry/field.hpp) whose side faces the
/// face of the point, with more than 96 degrees between the normals, or, without one, more than 90.6 (Facing in
/// overlap.hpp): the corner of a block presses on the top of another up to its edge. A point just beside an edge in an
/// element without such a side belongs to the nearest neighbour that has one, within a hundredth of its height. Without
/// any, no force starts: the offset grows with g.
/// Work and energy: each couple accumulates its energy gain, the work of its forces by central differences beyond the
/// absorbed, stored and dissipated energy, without the effect of the rotation of a surface in a step: along one
/// function of an element the law has a potential, and such errors cancel. A step in which the overlap begins or ends,
/// or follows a curved law, leaves an error; a change of the normal force corrects it (correction.hpp), before the
/// force ends if that can be predicted; for b > 1 the changed force may be tensile.
/// After separation (d = 0) a small tensile force removes the energy that the contact gained numerically; a loss and
/// the remaining gain are corrected in the next overlap of the point with the body, if it begins soon. When the
/// gradient switches within a step, on the medial surface of a body or from element to element, the part of the overlap
/// change that the trapezoidal work (mean of both gradients times the motion) does not explain is added to the offset,
/// which may then be below 0.
/// A point that leaves its contactor other than through the surface, into a joint that opens, stays with it for a
/// hundredth of its height; farther out the couple ends, and its stored energy is dissipated.
/// First, the ramps of the field advance by one step. The offset of a couple follows a change of g due to the field
/// alone, down to 0 at least: a rising field exerts no force, a falling one releases stored energy, which is
/// dissipated.
/// Couples that cannot touch (ContactCouple::apart_until, ContactState::travel) are skipped: bitwise the same.
///
/// @param state    position at t_n, velocity at t_(n-1/2)
/// @param dt       s, from t_(n-1) to t_n
/// @param contact  couples sorted; apart_until, histories, field and scratch are written, `fresh` is emptied
/// @param forces   added to, in the order (point id, contactor)
/// @param simd     available.  @param side_by_side  whether couples in continued contact are. Bitwise the same
/// @pre dt >= 0; couples hold every pair that touches. O(couples) + O(points) with a sphere. Throws nothing.
void contact_forces(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                    ContactState& contact, NodalForces& forces, ContactWork& work, Simd simd = best_simd(),
                    bool side_by_side = true);

/// Sum of the contact forces of the last step on some elements by axis, N: forces on their points (the spherical
/// boundary's included), reactions on their contactors; of the points of this rank's originals. O(touching couples).
/// @param holds  whether the element in a slot is one of them
[[nodiscard]] std::array<ExactSum, 3> contact_force_on(const ContactState& contact, const LocalMesh& local,
                                                       const std::function<bool(Index slot)>& holds);

}  // namespace breccia
