#include "physics/joint_forces.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "mesh/tetrahedron.hpp"

namespace breccia {
namespace {

using Triple = std::array<Vec3, 3>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Index corner_a(const LocalMesh& mesh, const ActiveJoint& joint, std::size_t i) {
  return mesh.corner_node(joint.slot_a, kFaceCorners[static_cast<std::size_t>(joint.face_a)][i]);
}

Index corner_b(const LocalMesh& mesh, const ActiveJoint& joint, std::size_t i) {
  return mesh.corner_node(joint.slot_b, matching_corner(joint.code, static_cast<int>(i)));
}

/// Openings at the corners and the normal of the mid-surface, from a to b.
struct Kinematics {
  Triple opening;
  Vec3 normal;
};

Kinematics kinematics(const Triple& a, const Triple& b) {
  Kinematics k;
  Triple middle;
  for (std::size_t i = 0; i < 3; ++i) {
    k.opening[i] = b[i] - a[i];
    middle[i] = 0.5 * (a[i] + b[i]);
  }
  k.normal = (middle[1] - middle[0]).cross(middle[2] - middle[0]);
  const double length = k.normal.norm();
  if (length > 0) k.normal /= length;
  return k;
}

Kinematics kinematics(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  Triple a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = load_node(position, corner_a(mesh, joint, i));
    b[i] = load_node(position, corner_b(mesh, joint, i));
  }
  return kinematics(a, b);
}

/// Evaluates the three points; returns the force on each corner of a.
Triple evaluate(const JointLawParams& law, const Kinematics& k, ActiveJoint& joint) {
  Triple force;
  const bool nodal_points = law.points == JointPoints::nodal;
  if (!nodal_points) force = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const Vec3 opening = nodal_points ? k.opening[i] : Vec3(0.5 * (k.opening[i] + k.opening[next]));
    const JointPointResponse r = evaluate_point(law, k.normal, opening, joint.points[i]);
    joint.mode_1 += joint.area / 3.0 * r.mode_1;
    joint.mode_2 += joint.area / 3.0 * r.mode_2;
    joint.friction += joint.area / 3.0 * r.friction;
    if (nodal_points) {
      // The elastic force in the very product the sweep uses: the same bits on either path.
      force[i] = r.elastic ? Vec3(corner_stiffness(law, joint.area) * opening) : Vec3(joint.area / 3.0 * r.traction);
    } else {
      const Vec3 half = joint.area / 6.0 * r.traction;
      force[i] += half;
      force[next] += half;
    }
  }
  return force;
}

double stored(const ActiveJoint& joint) {
  double sum = 0;
  for (const JointPointHistory& p : joint.points) sum += p.stored_normal + p.stored_shear + p.stored_friction;
  return joint.area / 3.0 * sum;
}

void note_failure(const JointLawParams& law, ActiveJoint& joint, JointWork& work) {
  if (joint.state == JointState::failed) return;
  const auto gone = std::count_if(joint.points.begin(), joint.points.end(), [](const JointPointHistory& p) { return exhausted(p); });
  if (gone < law.points_to_fail) return;
  joint.state = JointState::failed;
  for (JointPointHistory& p : joint.points) p.damage = 1.0;
  work.failed.push_back(joint.id);
}

bool open_everywhere(const ActiveJoint& joint) {
  return std::all_of(joint.points.begin(), joint.points.end(), [](const JointPointHistory& p) { return p.normal_opening > 0; });
}

}  // namespace

double ActiveJoint::damage() const {
  return std::max({points[0].damage, points[1].damage, points[2].damage});
}

double ActiveJoint::opening() const {
  return (points[0].normal_opening + points[1].normal_opening + points[2].normal_opening) / 3.0;
}

double ActiveJoint::slip() const {
  return (points[0].shear_opening.norm() + points[1].shear_opening.norm() + points[2].shear_opening.norm()) / 3.0;
}

FailureMode ActiveJoint::mode() const {
  if (damage() <= 0) return FailureMode::none;
  const double whole = mode_1 + mode_2;
  if (mode_1 > 0.75 * whole) return FailureMode::mode_1;
  if (mode_2 > 0.75 * whole) return FailureMode::mode_2;
  return FailureMode::mixed;
}

void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         std::vector<ActiveJoint>& joints, NodalForces& forces, JointWork& work) {
  work.failed.clear();
  work.released.clear();
  CompensatedSum held;
  for (ActiveJoint& joint : joints) {
    const JointLawParams& law = laws[at(joint.law)];
    const double mode_1 = joint.mode_1, mode_2 = joint.mode_2, friction = joint.friction;
    const Triple force = evaluate(law, kinematics(mesh, position, joint), joint);
    work.mode_1.add(joint.mode_1 - mode_1);
    work.mode_2.add(joint.mode_2 - mode_2);
    work.friction.add(joint.friction - friction);
    note_failure(law, joint, work);
    if (joint.state == JointState::failed && open_everywhere(joint)) {
      // Nothing is stored in an open failed joint but a spring that has just been let go: slip follows the opening.
      work.released.push_back({joint.id, joint.slot_a, joint.face_a, joint.mode()});
      continue;
    }
    held.add(stored(joint));
    for (std::size_t i = 0; i < 3; ++i) {
      forces.add(corner_a(mesh, joint, i), force[i]);
      forces.add(corner_b(mesh, joint, i), -force[i]);
    }
  }
  work.stored = held.value();
  if (work.released.empty()) return;
  auto next = work.released.begin();
  std::erase_if(joints, [&](const ActiveJoint& joint) {
    if (next == work.released.end() || joint.id != next->id) return false;
    ++next;
    return true;
  });
}

void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint, bool side_a,
                   double* force) {
  ActiveJoint trial = joint;
  const Triple on_a = evaluate(law, kinematics(mesh, position, joint), trial);
  for (int i = 0; i < 3; ++i) {
    // Corner i of the face of b meets corner (rotation - i) of the face of a.
    const auto from = static_cast<std::size_t>(side_a ? i : (joint.code % 3 - i + 3) % 3);
    for (int axis = 0; axis < 3; ++axis) force[3 * i + axis] = side_a ? on_a[from][axis] : -on_a[from][axis];
  }
}

void start_history(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position, std::span<ActiveJoint> joints,
                   JointWork& work) {
  CompensatedSum held(work.stored);
  for (ActiveJoint& joint : joints) {
    const JointLawParams& law = laws[at(joint.law)];
    const Kinematics now = kinematics(mesh, position, joint);
    for (std::size_t i = 0; i < 3; ++i) {
      const double ratio = onset_ratio(law, now.normal, now.opening[i]);
      (void)evaluate_point(law, now.normal, now.opening[i] / std::max(ratio * (1.0 + 1e-12), 1.0), joint.points[i]);
    }
    (void)evaluate(law, now, joint);
    work.mode_1.add(joint.mode_1);
    work.mode_2.add(joint.mode_2);
    work.friction.add(joint.friction);
    held.add(stored(joint));
  }
  work.stored = held.value();
}

}  // namespace breccia
