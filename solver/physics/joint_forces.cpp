#include "physics/joint_forces.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/joint_evaluation.hpp"

namespace breccia {

using JointKernel = void (*)(const JointLawParams& law, const double* position, JointBlock& block);
void joint_block_sse2(const JointLawParams& law, const double* position, JointBlock& block);
void joint_block_avx2(const JointLawParams& law, const double* position, JointBlock& block);
void joint_block_avx512(const JointLawParams& law, const double* position, JointBlock& block);

namespace {

namespace jp = joint_point;

JointKernel kernel_for(Simd simd) {
  DEMAND(simd_available(simd), std::string(name_of(simd)));
  switch (simd) {
    case Simd::avx512:
      return joint_block_avx512;
    case Simd::avx2:
      return joint_block_avx2;
    case Simd::sse2:
      break;
  }
  return joint_block_sse2;
}

/// @param who  ActiveJoint or its Identity
template <class Who>
Index corner_a(const LocalMesh& mesh, const Who& who, std::size_t i) {
  return mesh.corner_node(who.slot_a, kFaceCorners[static_cast<std::size_t>(who.face_a)][i]);
}

template <class Who>
Index corner_b(const LocalMesh& mesh, const Who& who, std::size_t i) {
  return mesh.corner_node(who.slot_b, matching_corner(who.code, static_cast<int>(i)));
}

jp::Sides<double> sides_of(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  const auto place = [&](Index node) {
    const Vec3 x = load_node(position, node);
    return jp::Vector<double>{x[0], x[1], x[2]};
  };
  jp::Sides<double> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    sides.a[i] = place(corner_a(mesh, joint, i));
    sides.b[i] = place(corner_b(mesh, joint, i));
  }
  return sides;
}

/// Evaluates the joint as beyond its elastic range, for any opening.
jp::Forces<double> evaluate(const JointLawParams& law, const LocalMesh& mesh, const double* position,
                            ActiveJoint& joint) {
  const jp::Kinematics<double> k = jp::kinematics(law, sides_of(mesh, position, joint));
  jp::Forces<double> forces;
  forces.force = jp::evaluate_points(law, k, joint.history);
  forces.turning = jp::tilting_forces(law, k, jp::may_tilt(law, joint.history), joint.history);
  return forces;
}

}  // namespace

double ActiveJoint::damage() const {
  const auto& p = history.points;
  return std::max({p[0].damage, p[1].damage, p[2].damage});
}

double ActiveJoint::opening() const {
  const auto& p = history.points;
  return (p[0].normal_opening + p[1].normal_opening + p[2].normal_opening) / 3.0;
}

double ActiveJoint::slip() const {
  const auto& p = history.points;
  return (p[0].shear_opening + p[1].shear_opening + p[2].shear_opening) / 3.0;
}

FailureMode ActiveJoint::mode() const {
  const double whole = history.mode_1 + history.mode_2;
  if (damage() <= 0 || whole <= 0) return FailureMode::none;
  if (history.mode_1 > 0.75 * whole) return FailureMode::mode_1;
  if (history.mode_2 > 0.75 * whole) return FailureMode::mode_2;
  return FailureMode::mixed;
}

double ActiveJoint::stored() const {
  const auto& p = history.points;
  return history.hold * history.area / 3.0 * (p[0].stored + p[1].stored + p[2].stored);
}

JointEnergy joint_energy(const LocalMesh& mesh, const ActiveJoints& joints, const JointWork& work) {
  JointEnergy energy{work.mode_1, work.mode_2, work.friction, work.viscous, {}};
  for (const ActiveJoint& joint : joints) {
    if (!mesh.is_original(joint.slot_a)) continue;
    energy.mode_1.add(joint.history.mode_1);
    energy.mode_2.add(joint.history.mode_2);
    energy.friction.add(joint.history.friction);
    energy.viscous.add(joint.history.viscous);
    energy.stored.add(joint.stored());
  }
  return energy;
}

namespace {

/// Joints that are new in their places get their nodes.
void seat_newcomers(const LocalMesh& mesh, ActiveJoints& joints) {
  for (const Index place : joints.take_newcomers()) {
    const ActiveJoints::Identity& who = joints.identity(place);
    JointBlock& block = joints.blocks()[at(place / kLanes)];
    for (std::size_t i = 0; i < 3; ++i) {
      block.node[i][place % kLanes] = corner_a(mesh, who, i);
      block.node[3 + i][place % kLanes] = corner_b(mesh, who, i);
    }
  }
}

/// Adds the vectors [corner][axis] to the forces on three nodes of one element.
void add_to(const std::array<double*, 3>& places, const double (&vectors)[3][3]) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) places[i][axis * kLanes] += vectors[i][axis];
  }
}

void add_forces(const JointBlock& block, Index lane, NodalForces& forces) {
  double on_a[3][3], on_b[3][3];
  const bool turning = (block.news[lane] & kTurning) != 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double force = block.force[i][axis][lane], turn = turning ? block.turning[i][axis][lane] : 0.0;
      on_a[i][axis] = force + turn;
      on_b[i][axis] = turn - force;
    }
  }
  const auto node = [&](std::size_t corner) { return block.node[corner][lane]; };
  add_to(forces.places(std::array{node(0), node(1), node(2)}), on_a);
  add_to(forces.places(std::array{node(3), node(4), node(5)}), on_b);
}

}  // namespace

void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         double time, Simd simd, ActiveJoints& joints, NodalForces& forces, JointWork& work) {
  work.failed.clear();
  work.released.clear();
  work.elastic.clear();
  seat_newcomers(mesh, joints);
  const JointKernel kernel = kernel_for(simd);
  const std::span<JointBlock> blocks = joints.blocks();
  for (JointBlock& block : blocks) block.computed = false;
  std::vector<GlobalId> released;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Index place = joints.order()[i], lane = place % kLanes;
    JointBlock& block = blocks[at(place / kLanes)];
    if (!block.computed) {  // here, while its forces are about to be used: blocks mostly come in their order
      kernel(laws[at(joints.law(place / kLanes))], position, block);
      block.computed = true;
    }
    const std::uint8_t news = block.news[lane];
    ActiveJoints::Identity& who = joints.identity(place);
    if ((news & kElastic) != 0) work.elastic.push_back({who.id, who.slot_a, who.slot_b, who.face_a, who.code});
    if ((news & kFailing) != 0) {
      who.time_of_failure = time;
      if (mesh.is_original(who.slot_a)) work.failed.push_back(who.id);
    }
    if ((news & kReleased) == 0) {
      add_forces(block, lane, forces);
      continue;
    }
    released.push_back(who.id);
    const ActiveJoint joint = joints[i];
    const double dissipated = joint.history.mode_1 + joint.history.mode_2;
    work.released.push_back({joint.id, joint.slot_a, joint.face_a, joint.mode(), joint.time_of_failure, dissipated,
                             joint.opening(), joint.slip()});
    if (!mesh.is_original(joint.slot_a)) continue;
    work.mode_1.add(joint.history.mode_1);
    work.mode_2.add(joint.history.mode_2);
    work.friction.add(joint.history.friction);
    work.viscous.add(joint.history.viscous);
  }
  joints.erase(released);
}

double largest_opening_squared(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  return jp::largest_opening_squared(sides_of(mesh, position, joint));
}

void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint,
                   bool side_a, double* force) {
  ActiveJoint trial = joint;
  const auto [pull, turning] = evaluate(law, mesh, position, trial);
  for (int i = 0; i < 3; ++i) {
    // Corner i of the face of b meets corner (rotation - i) of the face of a.
    const auto from = static_cast<std::size_t>(side_a ? i : (joint.code % 3 - i + 3) % 3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sign = side_a ? 1.0 : -1.0;
      force[static_cast<std::size_t>(3 * i) + axis] = turning[from][axis] + sign * pull[from][axis];
    }
  }
}

void start_history(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                   std::span<ActiveJoint> joints) {
  for (ActiveJoint& joint : joints) (void)evaluate(laws[at(joint.law)], mesh, position, joint);
}

}  // namespace breccia
