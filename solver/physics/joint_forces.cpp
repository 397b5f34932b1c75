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

struct Kinematics {
  Triple opening;    // at the corners
  JointFrame frame;  // of the mid-surface
  std::array<Vec3, 2> edge;  // of the mid-surface, from its corner 0 to 1 and 2
  double doubled_area = 0;
};

Kinematics kinematics(const JointLawParams& law, const LocalMesh& mesh, const double* position,
                      const ActiveJoint& joint) {
  Kinematics k;
  Triple middle;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = load_node(position, corner_a(mesh, joint, i)), b = load_node(position, corner_b(mesh, joint, i));
    k.opening[i] = b - a;
    middle[i] = 0.5 * (a + b);
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

double stored(const ActiveJoint& joint) {
  return joint.area / 3.0 * (joint.points[0].stored() + joint.points[1].stored() + joint.points[2].stored());
}

/// What a joint has dissipated, to tell what an evaluation adds.
struct Dissipated {
  double mode_1, mode_2, friction;
  explicit Dissipated(const ActiveJoint& joint) : mode_1(joint.mode_1), mode_2(joint.mode_2), friction(joint.friction) {}
};

/// Joints are computed wherever one side is at home, and booked with side a.
void book(const LocalMesh& mesh, const ActiveJoint& joint, const Dissipated& before, JointWork& work) {
  if (!mesh.is_original(joint.slot_a)) return;
  work.mode_1.add(joint.mode_1 - before.mode_1);
  work.mode_2.add(joint.mode_2 - before.mode_2);
  work.friction.add(joint.friction - before.friction);
  work.stored.add(stored(joint));
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

void active_joint_forces(std::span<const JointLawParams> laws, const LocalMesh& mesh, const double* position,
                         std::vector<ActiveJoint>& joints, NodalForces& forces, JointWork& work) {
  work.failed.clear();
  work.released.clear();
  work.stored = {};
  for (ActiveJoint& joint : joints) {
    const JointLawParams& law = laws[at(joint.law)];
    const Kinematics k = kinematics(law, mesh, position, joint);
    const Dissipated before(joint);
    const Triple force = evaluate(law, k, joint);
    if (joint.state == JointState::holding && gone(joint, law.points_to_fail)) {
      joint.state = JointState::failed;
      if (mesh.is_original(joint.slot_a)) work.failed.push_back(joint.id);
    }
    if (joint.state == JointState::failed && open_everywhere(k)) {
      // Open and broken everywhere: no force, and nothing stored, friction springs included.
      work.released.push_back({joint.id, joint.slot_a, joint.face_a, joint.mode()});
      book(mesh, joint, before, work);
      continue;
    }
    const Triple turning = tilting_forces(k, tilting(law, k, joint), joint);
    book(mesh, joint, before, work);
    for (std::size_t i = 0; i < 3; ++i) {
      forces.add(corner_a(mesh, joint, i), force[i] + turning[i]);
      forces.add(corner_b(mesh, joint, i), turning[i] - force[i]);
    }
  }
  if (work.released.empty()) return;
  auto next = work.released.begin();
  std::erase_if(joints, [&](const ActiveJoint& joint) {
    if (next == work.released.end() || joint.id != next->id) return false;
    ++next;
    return true;
  });
}

double largest_opening_squared(const LocalMesh& mesh, const double* position, const ActiveJoint& joint) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 d = load_node(position, corner_b(mesh, joint, i)) - load_node(position, corner_a(mesh, joint, i));
    largest = std::max(largest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  return largest;
}

void virgin_forces(const JointLawParams& law, const LocalMesh& mesh, const double* position, const ActiveJoint& joint,
                   bool side_a, double* force) {
  ActiveJoint trial = joint;
  const Kinematics k = kinematics(law, mesh, position, joint);
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
                   std::span<ActiveJoint> joints, JointWork& work) {
  for (ActiveJoint& joint : joints) {
    const JointLawParams& law = laws[at(joint.law)];
    const Kinematics k = kinematics(law, mesh, position, joint);
    const Dissipated before(joint);
    (void)evaluate(law, k, joint);
    (void)tilting_forces(k, tilting(law, k, joint), joint);
    book(mesh, joint, before, work);
  }
}

}  // namespace breccia
