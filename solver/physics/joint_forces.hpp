#pragma once

#include <span>
#include <vector>

#include "base/exact_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "physics/active_joints.hpp"
#include "physics/joint_law.hpp"
#include "physics/sweep.hpp"

namespace breccia {

/// A joint whose two faces now belong to contact.
struct ReleasedJoint {
  GlobalId id = 0;
  Index slot_a = 0;
  std::int8_t face_a = 0;
  FailureMode mode = FailureMode::none;
  double time_of_failure = -1;   ///< s, as in ActiveJoint
  double dissipated = 0;         ///< J, in modes I and II
  double opening = 0, slip = 0;  ///< m, as it was released: means of its points, as of an active joint
};

/// A joint without damage that is back in its elastic range.
struct ElasticJoint {
  GlobalId id = 0;
  Index slot_a = 0, slot_b = 0;
  std::int8_t face_a = 0, code = 0;
};

/// What joints that are no longer on the list have consumed over the run, J: those whose side a is an original. Who
/// failed: likewise. Who was released or is elastic: all.
struct JointWork {
  ExactSum mode_1, mode_2, friction, viscous;
  std::vector<GlobalId> failed;         ///< in the last step, ascending
  std::vector<ReleasedJoint> released;  ///< in the last step, ascending
  std::vector<ElasticJoint> elastic;    ///< on the list after the last step, ascending
};

/// What joints hold and have consumed, J.
struct JointEnergy {
  ExactSum mode_1, mode_2, friction, viscous;  ///< over the run
  ExactSum stored;                             ///< at the last evaluation
};

/// Of the joints on the list whose side a is an original, and of those that have left it. O(joints).
[[nodiscard]] JointEnergy joint_energy(const LocalMesh& mesh, const ActiveJoints& joints, const JointWork& work);

/// Forces of the active joints, in the order of the list, added to both sides; histories are brought up to date. On
/// each corner i of the face of a: +A0/3 t_i, on the matching corner of b the opposite; with mid-edge points each force
/// goes to the two corners of its edge in halves. n is the unit normal of the mid-surface.
///
/// A joint fails when points_to_fail points are at damage 1, or as a crack (joint_evaluation.hpp: a corner open ten
/// times the critical opening, or a mid-surface that has lost its shape). The other points lose their cohesion in
/// kFailureSteps evaluations. A failed joint remains a frictional interface while it is closed (sigma = k delta_n,
/// Coulomb friction). When all its corners are open at once it is released: it has no force and no energy from then on
/// and is removed from the list. A crack is released when its forces have decayed in kHandoverSteps evaluations; its
/// stored energy is dissipated: cohesion in its mode, friction springs as friction, pressure as viscous. A joint
/// without damage whose opening is within half the elastic range again is marked `elastic`: it returns to the sweep,
/// which evaluates it at lower cost, after this step.
/// @param time  s, t_n: of the positions
/// @param simd  instruction set; the bits are the same with every one
/// O(joints), allocates only when joints come, fail or are elastic, throws nothing.
void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         double time, Simd simd, ActiveJoints& joints, NodalForces& forces, JointWork& work);

/// Square of the largest opening at the three corners, m2, in the very products the sweep uses; the same from both
/// sides.
[[nodiscard]] double largest_opening_squared(const LocalMesh& mesh, const double* position, const ActiveJoint& joint);

/// Forces of a joint that leaves its elastic range in this step, as active_joint_forces would give them to one without
/// history: on corners 0..2 of the face of side a, or of the face of side b, each in the order of that side's face.
/// Both sides are computed from the same numbers in the same order; nothing is remembered.
void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint,
                   bool side_a, double* force);

/// Gives joints that have just left the elastic range their histories at x_n, with the forces that virgin_forces gave
/// (for the energy of a first evaluation see evaluate_point).
void start_history(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                   std::span<ActiveJoint> joints);

}  // namespace breccia
