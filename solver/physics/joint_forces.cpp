#include "physics/joint_forces.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "mesh/tetrahedron.hpp"

namespace breccia {
namespace {

using Triple = std::array<Vec3, 3>;

/// Of the square of the elastic range: half the opening.
constexpr double kCalm = 0.25;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Index corner_a(const LocalMesh& mesh, const ActiveJoint& joint, std::size_t i) {
  return mesh.corner_node(joint.slot_a, kFaceCorners[static_cast<std::size_t>(joint.face_a)][i]);
}

Index corner_b(const LocalMesh& mesh, const ActiveJoint& joint, std::size_t i) {
  return mesh.corner_node(joint.slot_b, matching_corner(joint.code, static_cast<int>(i)));
}

struct Kinematics {
  Triple opening;    // at the corners
  JointFrame frame;  // of the mid-surface
  std::array<Vec3, 2> edge;  // of the mid-surface, from its corner 0 to 1 and 2
  double doubled_area = 0;
};

/// Corners of a joint's two faces, matching.
struct Sides {
  Triple a, b;
};

Sides sides_of(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  Sides sides;
  for (std::size_t i = 0; i < 3; ++i) {
    sides.a[i] = load_node(position, corner_a(mesh, joint, i));
    sides.b[i] = load_node(position, corner_b(mesh, joint, i));
  }
  return sides;
}

Kinematics kinematics(const JointLawParams& law, const Sides& sides) {
  Kinematics k;
  Triple middle;
  for (std::size_t i = 0; i < 3; ++i) {
    k.opening[i] = sides.b[i] - sides.a[i];
    middle[i] = 0.5 * (sides.a[i] + sides.b[i]);
  }
  k.edge = {middle[1] - middle[0], middle[2] - middle[0]};
  const Vec3& edge = k.edge[0];
  k.frame.normal = edge.cross(k.edge[1]);
  k.doubled_area = k.frame.normal.norm();
  if (k.doubled_area > 0) k.frame.normal *= 1.0 / k.doubled_area;
  if (law.friction > 0) {
    const double edge_length = edge.norm();
    if (edge_length > 0) k.frame.tangent[0] = edge * (1.0 / edge_length);
    k.frame.tangent[1] = k.frame.normal.cross(k.frame.tangent[0]);
  }
  return k;
}

/// Opening at an integration point.
Vec3 point_opening(const JointLawParams& law, const Triple& corners, std::size_t i) {
  return law.points == JointPoints::nodal ? corners[i] : Vec3(0.5 * (corners[i] + corners[(i + 1) % 3]));
}

bool gone(const ActiveJoint& joint, int points_to_fail) {
  const auto full = [](const JointPointHistory& p) { return p.damage >= 1.0; };
  return std::count_if(joint.points.begin(), joint.points.end(), full) >= points_to_fail;
}

using Responses = std::array<JointPointResponse, 3>;

void evaluate_points(const JointLawParams& law, const Kinematics& k, ActiveJoint& joint, Responses& response) {
  for (std::size_t i = 0; i < 3; ++i) {
    response[i] = evaluate_point(law, k.frame, point_opening(law, k.opening, i), joint.points[i]);
  }
}

/// Likewise; if enough points give way for the joint to fail, the others give way with them, at once.
void evaluate_dragging(const JointLawParams& law, const Kinematics& k, ActiveJoint& joint, Responses& response) {
  const std::array<JointPointHistory, 3> before = joint.points;
  evaluate_points(law, k, joint, response);
  if (!gone(joint, law.points_to_fail)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (joint.points[i].damage >= 1.0) continue;
    joint.points[i] = before[i];
    joint.points[i].damage = 1.0;
    response[i] = evaluate_point(law, k.frame, point_opening(law, k.opening, i), joint.points[i]);
  }
}

/// Evaluates the joint; returns the force on each corner of a.
Triple evaluate(const JointLawParams& law, const Kinematics& k, ActiveJoint& joint) {
  Responses response;
  if (law.points_to_fail < 3 && joint.state == JointState::holding) {
    evaluate_dragging(law, k, joint, response);
  } else {
    evaluate_points(law, k, joint, response);
  }
  for (const JointPointResponse& r : response) {
    joint.mode_1 += joint.area / 3.0 * r.mode_1;
    joint.mode_2 += joint.area / 3.0 * r.mode_2;
    joint.friction += joint.area / 3.0 * r.friction;
  }
  Triple force;
  for (std::size_t i = 0; i < 3; ++i) {
    if (law.points == JointPoints::mid_edge) {
      force[i] = joint.area / 6.0 * (response[i].traction + response[(i + 2) % 3].traction);
    } else if (response[i].elastic) {
      // In the very product the sweep uses: the same bits on either path.
      force[i] = corner_stiffness(law, joint.area) * k.opening[i];
    } else {
      force[i] = joint.area / 3.0 * response[i].traction;
    }
  }
  return force;
}

/// What turning the mid-surface does to a closed joint that has slid: its normal energy k d delta_n^2 / 2 beyond the isotropic
/// part depends on the normal. T = sum A0/3 k d delta_n delta_s, N: dU = T . dn.
Vec3 tilting(const JointLawParams& law, const Kinematics& k, const ActiveJoint& joint) {
  Vec3 tilt = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const JointPointHistory& p = joint.points[i];
    const double share = law.law == JointLaw::mixed_mode ? p.damage : (p.damage >= 1.0 ? 1.0 : 0.0);
    if (share <= 0 || p.normal_opening >= 0) continue;
    const Vec3 shear = p.opening - p.normal_opening * k.frame.normal;
    tilt += joint.area / 3.0 * law.stiffness * share * p.normal_opening * shear;
  }
  return tilt;
}

/// Forces on the three pairs of corners that go with `tilt`, so that forces are the gradient of the energy also after a long
/// slip, with their work among the friction. Each of a pair gets half of -dU/dm, m the corner of the mid-surface.
Triple tilting_forces(const Kinematics& k, const Vec3& tilt, ActiveJoint& joint) {
  if (joint.turned) joint.friction += 0.5 * (joint.tilt + tilt).dot(k.frame.normal - joint.normal);
  joint.turned = true;
  joint.tilt = tilt;
  joint.normal = k.frame.normal;
  Triple force{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  if (k.doubled_area <= 0) return force;
  force[1] = k.edge[1].cross(tilt) * (-0.5 / k.doubled_area);
  force[2] = tilt.cross(k.edge[0]) * (-0.5 / k.doubled_area);
  force[0] = -(force[1] + force[2]);
  return force;
}

/// In the very products the sweep uses.
double largest_opening_squared(const Sides& sides) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 d = sides.b[i] - sides.a[i];
    largest = std::max(largest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  return largest;
}

/// Evaluates a joint that is surely elastic and has no damage; returns the force on each corner of a, as the sweep would.
Triple evaluate_elastic(const JointLawParams& law, const Sides& sides, ActiveJoint& joint) {
  Triple force;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 opening = sides.b[i] - sides.a[i];
    (void)evaluate_elastic_point(law, opening, joint.points[i]);
    force[i] = corner_stiffness(law, joint.area) * opening;
  }
  return force;
}

void add_forces(const LocalMesh& mesh, const ActiveJoint& joint, const Triple& on_a, const Triple& on_b, NodalForces& forces) {
  for (std::size_t i = 0; i < 3; ++i) {
    forces.add(corner_a(mesh, joint, i), on_a[i]);
    forces.add(corner_b(mesh, joint, i), on_b[i]);
  }
}

/// At the corners, and so at mid-edge points too.
bool open_everywhere(const Kinematics& k) {
  return std::all_of(k.opening.begin(), k.opening.end(), [&](const Vec3& o) { return o.dot(k.frame.normal) > 0; });
}

}  // namespace

double ActiveJoint::damage() const { return std::max({points[0].damage, points[1].damage, points[2].damage}); }

double ActiveJoint::opening() const {
  return (points[0].normal_opening + points[1].normal_opening + points[2].normal_opening) / 3.0;
}

double ActiveJoint::slip() const {
  return (points[0].shear_opening() + points[1].shear_opening() + points[2].shear_opening()) / 3.0;
}

FailureMode ActiveJoint::mode() const {
  const double whole = mode_1 + mode_2;
  if (damage() <= 0 || whole <= 0) return FailureMode::none;
  if (mode_1 > 0.75 * whole) return FailureMode::mode_1;
  if (mode_2 > 0.75 * whole) return FailureMode::mode_2;
  return FailureMode::mixed;
}

namespace {

/// Evaluates a joint of the list and adds its forces; true when it is released.
bool act(const JointLawParams& law, const LocalMesh& mesh, const double* position, double time, ActiveJoint& joint,
         NodalForces& forces, JointWork& work) {
  const Sides sides = sides_of(mesh, position, joint);
  joint.calm = false;
  if (law.screen_limit() > 0 && joint.damage() <= 0) {
    const double largest = largest_opening_squared(sides);
    if (largest <= law.screen_limit()) {
      joint.calm = largest <= kCalm * law.screen_limit();
      const Triple force = evaluate_elastic(law, sides, joint);
      add_forces(mesh, joint, force, {-force[0], -force[1], -force[2]}, forces);
      return false;
    }
  }
  const Kinematics k = kinematics(law, sides);
  const Triple force = evaluate(law, k, joint);
  if (joint.state == JointState::holding && gone(joint, law.points_to_fail)) {
    joint.state = JointState::failed;
    joint.time_of_failure = time;
    if (mesh.is_original(joint.slot_a)) work.failed.push_back(joint.id);
  }
  // Open and broken everywhere: no force, and nothing stored, friction springs included.
  if (joint.state == JointState::failed && open_everywhere(k)) return true;
  const Triple turning = tilting_forces(k, tilting(law, k, joint), joint);
  add_forces(mesh, joint, {force[0] + turning[0], force[1] + turning[1], force[2] + turning[2]},
             {turning[0] - force[0], turning[1] - force[1], turning[2] - force[2]}, forces);
  return false;
}

/// Joints lie scattered in memory: the next ones are asked for while one is computed.
void prefetch(const ActiveJoint& joint) {
  const auto* bytes = reinterpret_cast<const char*>(&joint);
  for (std::size_t line = 0; line < sizeof joint; line += 64) __builtin_prefetch(bytes + line, 1);
}

}  // namespace

double ActiveJoint::stored() const { return area / 3.0 * (points[0].stored() + points[1].stored() + points[2].stored()); }

JointEnergy joint_energy(const LocalMesh& mesh, const ActiveJoints& joints, const JointWork& work) {
  JointEnergy energy{work.mode_1, work.mode_2, work.friction, {}};
  for (const ActiveJoint& joint : joints) {
    if (!mesh.is_original(joint.slot_a)) continue;
    energy.mode_1.add(joint.mode_1);
    energy.mode_2.add(joint.mode_2);
    energy.friction.add(joint.friction);
    energy.stored.add(joint.stored());
  }
  return energy;
}

void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         double time, ActiveJoints& joints, NodalForces& forces, JointWork& work) {
  work.failed.clear();
  work.released.clear();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (i + 2 < joints.size()) prefetch(joints[i + 2]);
    ActiveJoint& joint = joints[i];
    if (!act(laws[at(joint.law)], mesh, position, time, joint, forces, work)) continue;
    work.released.push_back({joint.id, joint.slot_a, joint.face_a, joint.mode(), joint.time_of_failure});
    if (!mesh.is_original(joint.slot_a)) continue;
    work.mode_1.add(joint.mode_1);
    work.mode_2.add(joint.mode_2);
    work.friction.add(joint.friction);
  }
  if (work.released.empty()) return;
  auto next = work.released.begin();
  joints.erase_if([&](const ActiveJoint& joint) {
    if (next == work.released.end() || joint.id != next->id) return false;
    ++next;
    return true;
  });
}

double largest_opening_squared(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  return largest_opening_squared(sides_of(mesh, position, joint));
}

void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint,
                   bool side_a, double* force) {
  ActiveJoint trial = joint;
  const Kinematics k = kinematics(law, sides_of(mesh, position, joint));
  const Triple pull = evaluate(law, k, trial);
  const Triple turning = tilting_forces(k, tilting(law, k, trial), trial);
  for (int i = 0; i < 3; ++i) {
    // Corner i of the face of b meets corner (rotation - i) of the face of a.
    const auto from = static_cast<std::size_t>(side_a ? i : (joint.code % 3 - i + 3) % 3);
    const Vec3 sum = side_a ? Vec3(pull[from] + turning[from]) : Vec3(turning[from] - pull[from]);
    for (int axis = 0; axis < 3; ++axis) force[3 * i + axis] = sum[axis];
  }
}

void start_history(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                   std::span<ActiveJoint> joints) {
  for (ActiveJoint& joint : joints) {
    const JointLawParams& law = laws[at(joint.law)];
    const Kinematics k = kinematics(law, sides_of(mesh, position, joint));
    (void)evaluate(law, k, joint);
    (void)tilting_forces(k, tilting(law, k, joint), joint);
  }
}

}  // namespace breccia
