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
///   friction  law/coulomb.hpp with k = tangential_ratio w sigma_p / H, limit mu f, where f follows w sigma |grad g|
///             with a delay of up to friction_delay times the extent of the smaller body
///   target    + N_i f_p on the corners of its face;  contactor: - lambda_a f_p on its corners
///
/// so linear and angular momentum are conserved to round-off for any direction of f_p. A couple keeps its history while
/// it touches, also when the point moves to another contactor of the same body that shares a mesh vertex with the last.
/// Each couple accumulates its energy gain, the work of its forces by central differences beyond the absorbed, stored
/// and dissipated energy; a change of the normal force corrects it (correction.hpp), after separation (d = 0) a small
/// pull.
/// Rules of sides, histories and first overlaps: resolve.hpp and solver/manual/theory/contact.md.
/// The offset of a couple follows a change of g due to the field alone (ContactState::changed), down to 0 at least: a
/// rising field exerts no force, a falling one releases stored energy, which is dissipated.
/// Couples that cannot touch (ContactCouple::apart_until, ContactState::travel) are skipped: bitwise the same.
///
/// @param state    position at t_n, velocity at t_(n-1/2)
/// @param dt       s, from t_(n-1) to t_n
/// @param contact  couples sorted; histories, field, list of awake couples and scratch are written, `fresh` and
///                 `changed` emptied
/// @param forces   added to, in the order (point id, contactor)
/// @param simd     available.  @param side_by_side  false: one couple after the other. Bitwise the same
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
