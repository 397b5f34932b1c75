#pragma once

#include <array>
#include <functional>

#include "base/exact_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "discretisation/nodal_state.hpp"
#include "physics/contact/contact_params.hpp"
#include "physics/contact/contact_state.hpp"
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
/// so linear and angular momentum hold to round-off for any direction of f_p. History: a couple keeps its
/// TouchingCouple while it touches; when the point has moved to another contactor of the same body that shares a mesh
/// vertex with the old one the history moves along. A new couple starts with offset = g if point and contactor share a
/// mesh vertex or if fracture has just made it, else with 0, so that freeing a face makes no force.
/// A new couple that is deeper at once than its point has moved inwards takes the excess as its offset.
/// Sides: in a body of ordinary finite elements g is the least of those sums (contact_field.hpp) whose side looks
/// towards the face of the point, the normals at more than 96 degrees, or, where there is none, at more than 90.6
/// (Facing in overlap.hpp): the corner of a block presses on the top of another up to its edge. A point just beside an
/// edge in an element that has no such side belongs to the nearest neighbour that has one, if it reaches so far by a
/// hundredth of its height. Where there is none, no force begins: the offset grows with g.
/// Work and energy: each couple counts the work that its forces have done, as central differences do it, beyond what it
/// took, holds and dissipates, but for what the turn of a surface makes of a step: along one function of an element the
/// law has a potential, and such errors cancel. A step in which the overlap begins or ends, or follows a curved law,
/// leaves an error; a change of the normal force puts it right (contact_balance.hpp), before a force ends as far as
/// that can be foreseen; where b > 1 the changed force may pull.
/// A couple whose overlap has ended holds back what it has gained, with d = 0, until next to nothing is left; what is
/// lost, and what that leaves, the next overlap of the point with the body puts right, if it comes soon. Where the
/// gradient turns within a step, on the medial surface of a body or from element to element, the offset takes up what
/// the overlap changes by beyond the mean of both gradients times the motion: it may then be below 0.
/// A point that leaves its contactor other than through the surface, into a joint that opens, stays with it for a
/// hundredth of its height; farther out the couple is cut off, and what it held is accounted as dissipated.
/// The first thing done is one step of the field's ramps. The offset of a couple follows a change of g that comes from
/// the field alone, down to 0 at least: a field that rises exerts no force, one that sinks lets go of stored energy,
/// which is accounted as dissipated.
/// Couples that are sure to be apart (ContactCouple::apart_until, ContactState::travel) are passed over: the same bits.
///
/// @param state    position at t_n, velocity at t_(n-1/2)
/// @param dt       s, from t_(n-1) to t_n
/// @param contact  couples sorted; apart_until, histories, field and scratch are written, `fresh` is emptied
/// @param forces   added to, in the order (point id, contactor)
/// @param simd     available.  @param side_by_side  whether couples that go on pressing are. The same bits
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
