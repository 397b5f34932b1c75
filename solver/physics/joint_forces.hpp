#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/exact_sum.hpp"
#include "physics/joint_law.hpp"
#include "state/local_mesh.hpp"
#include "state/nodal_forces.hpp"

namespace breccia {

enum class JointState : std::uint8_t {
  holding,  ///< elastic or damaged
  failed    ///< damage 1 at points_to_fail points: a frictional interface until it is open everywhere
};

/// How a joint failed, by the energy it dissipated: a mode alone when it took more than three quarters.
enum class FailureMode : std::uint8_t { none = 0, mode_1 = 1, mode_2 = 2, mixed = 3 };

/// A joint that is evaluated once a step, apart from the sweep: one that has left its elastic range, or whose law
/// the sweep does not know. Side a is the element of lower global id.
struct ActiveJoint {
  GlobalId id = 0;
  Index slot_a = 0, slot_b = 0;
  std::int8_t face_a = 0, code = 0;  ///< as in JointFace
  JointState state = JointState::holding;
  Index law = 0;
  double area = 0;  ///< m2, reference
  std::array<JointPointHistory, 3> points;
  double mode_1 = 0, mode_2 = 0, friction = 0;  ///< J dissipated so far
  // The last evaluation's moment of a closed joint that has slid, N, and normal; for its work.
  bool turned = false;
  Vec3 tilt{0, 0, 0}, normal{0, 0, 0};

  [[nodiscard]] double damage() const;   ///< largest of the points
  [[nodiscard]] double opening() const;  ///< m, mean normal opening
  [[nodiscard]] double slip() const;     ///< m, mean length of the shear opening
  [[nodiscard]] FailureMode mode() const;
};

/// A joint whose two faces now belong to contact.
struct ReleasedJoint {
  GlobalId id = 0;
  Index slot_a = 0;
  std::int8_t face_a = 0;
  FailureMode mode = FailureMode::none;
};

/// What the joints on the active list hold and have consumed, J, and who failed: those whose side a is an original. Who was
/// released: all.
struct JointWork {
  ExactSum mode_1, mode_2, friction;    ///< over the run
  ExactSum stored;                      ///< at the last evaluation
  std::vector<GlobalId> failed;         ///< in the last step, ascending
  std::vector<ReleasedJoint> released;  ///< in the last step, ascending
};

/// Forces of the active joints, in the order given (ascending ids), added to both sides; histories are brought up to
/// date. On each corner i of the face of a: +A0/3 t_i, on the matching corner of b the opposite; with mid-edge points
/// each force goes to the two corners of its edge in halves. n is the unit normal of the mid-surface.
///
/// A joint fails when points_to_fail points are at damage 1; the others lose what they hold in the same step. Failed,
/// it remains a frictional interface while it is closed (sigma = k delta_n, Coulomb friction). When all its corners are
/// open at once it is released: it carries no force and holds no energy from then on and is taken off the list.
/// O(joints), allocates only when joints fail, throws nothing.
void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         std::vector<ActiveJoint>& joints, NodalForces& forces, JointWork& work);

/// Square of the largest opening at the three corners, m2, in the very products the sweep uses; the same from both sides.
[[nodiscard]] double largest_opening_squared(const LocalMesh& mesh, const double* position, const ActiveJoint& joint);

/// Forces of a joint that leaves its elastic range in this step, as active_joint_forces would give them to one without
/// history: on corners 0..2 of the face of side a, or of the face of side b, each in the order of that side's face.
/// Both sides are computed from the same numbers in the same order; nothing is remembered.
void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint,
                   bool side_a, double* force);

/// Gives joints that have just left the elastic range their histories at x_n and books what they dissipate, with the
/// forces that virgin_forces gave (evaluate_point says what a first evaluation books).
void start_history(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                   std::span<ActiveJoint> joints, JointWork& work);

}  // namespace breccia
