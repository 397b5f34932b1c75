#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "mesh/joints.hpp"
#include "mesh/topology.hpp"
#include "physics/joint_forces.hpp"
#include "unit/physics/joints/point_driver.hpp"

namespace breccia::test {

/// Two regular tetrahedra of edge 20 mm that share a face in the plane x = 0; a on the left, b on the right.
/// @param turned  which corner of each tetrahedron comes first: every match of the two faces is reached by these
inline Mesh two_tetrahedra(int turned_a, int turned_b) {
  const double r = kEdge / std::sqrt(3.0), height = kEdge * std::sqrt(2.0 / 3.0);
  Mesh mesh;
  for (int i = 0; i < 3; ++i)
    mesh.nodes.emplace_back(0, r * std::cos(2.0943951023931953 * i), r * std::sin(2.0943951023931953 * i));
  mesh.nodes.emplace_back(-height, 0, 0);
  mesh.nodes.emplace_back(height, 0, 0);
  const auto turned = [&](std::array<Index, 4> corners, int turn) {
    // Cyclic shifts of three corners keep the orientation, so do swaps of two pairs.
    for (int i = 0; i < turn % 3; ++i) corners = {corners[0], corners[2], corners[3], corners[1]};
    for (int i = 0; i < turn / 3; ++i) corners = {corners[1], corners[2], corners[0], corners[3]};
    return corners;
  };
  mesh.elements = {turned({3, 0, 1, 2}, turned_a), turned({4, 0, 2, 1}, turned_b)};
  for (auto& e : mesh.elements) {
    const auto x = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(e[c])]; };
    const Vec3 u = x(1) - x(0), v = x(2) - x(0), w = x(3) - x(0);
    if (u.dot(Vec3(v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0])) < 0)
      std::swap(e[2], e[3]);
  }
  mesh.element_group = {0, 0};
  mesh.element_body = {0, 0};
  mesh.element_source_id = {1, 2};
  mesh.volume_groups = {"pair"};
  mesh.num_bodies = 1;
  return mesh;
}

/// The two tetrahedra with their joint on the active list, moved about by hand.
struct JointPair {
  std::vector<JointLawParams> laws;
  LocalMesh local;
  Field<double> position;
  ActiveJoint virgin;   ///< the joint without history
  ActiveJoints joints;  ///< the active list
  NodalForces forces;
  JointWork work;
  double time = 0;  ///< s, of the next evaluation
  Simd simd = best_simd();

  explicit JointPair(const JointLawParams& law, Discretisation kind = Discretisation::own_nodes, int turned_a = 0,
                     int turned_b = 0)
      : JointPair(law, two_tetrahedra(turned_a, turned_b), kind) {}

  JointPair(const JointLawParams& law, const Mesh& mesh, Discretisation kind)
      : laws{law},
        local(build_local_mesh(mesh, {kind}, {1000.0})),
        position(local.reference),
        forces(local.num_own_blocks(), local.num_nodes) {
    const std::vector<JointFace> faces = find_joints(mesh, build_topology(mesh));
    EXPECT_EQ(faces.size(), 1U);
    virgin.id = 7;
    virgin.slot_a = local.slot_of_element[static_cast<std::size_t>(faces[0].a)];
    virgin.slot_b = local.slot_of_element[static_cast<std::size_t>(faces[0].b)];
    virgin.face_a = faces[0].face_a;
    virgin.code = faces[0].code;
    virgin.history.area = faces[0].area;
    put_on_list(virgin);
  }

  /// Makes it the only joint on the list.
  void put_on_list(const ActiveJoint& joint) { joints = ActiveJoints(std::vector{joint}); }

  /// Moves element b by an opening and element a not at all. The normal is +x.
  void open(const Vec3& by) {
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(virgin.slot_b, c);
      store_node(position.data(), node, load_node(local.reference.data(), node) + by);
    }
  }
  /// Moves every corner by itself.
  void shake(std::mt19937& random, double size) {
    std::normal_distribution<double> part;
    for (const Index slot : {virgin.slot_a, virgin.slot_b}) {
      for (int c = 0; c < 4; ++c) {
        const Index node = local.corner_node(slot, c);
        store_node(position.data(), node,
                   load_node(position.data(), node) + size * Vec3(part(random), part(random), part(random)));
      }
    }
  }
  void evaluate() {
    forces.clear();
    active_joint_forces(laws, local, position.data(), time, simd, joints, forces, work);
  }

  [[nodiscard]] Index corner(bool side_a, int i) const {
    return side_a
               ? local.corner_node(virgin.slot_a,
                                   kFaceCorners[static_cast<std::size_t>(virgin.face_a)][static_cast<std::size_t>(i)])
               : local.corner_node(virgin.slot_b, matching_corner(virgin.code, i));
  }
  [[nodiscard]] Vec3 force(bool side_a, int i) const { return forces.get(corner(side_a, i)); }
  [[nodiscard]] Vec3 place(bool side_a, int i) const { return load_node(position.data(), corner(side_a, i)); }
  /// On the whole of side b.
  [[nodiscard]] Vec3 force_on_b() const { return force(false, 0) + force(false, 1) + force(false, 2); }
  [[nodiscard]] double dissipated() const {
    const JointEnergy energy = joint_energy(local, joints, work);
    return energy.mode_1.value() + energy.mode_2.value() + energy.friction.value() + energy.viscous.value();
  }
  [[nodiscard]] double stored() const { return joint_energy(local, joints, work).stored.value(); }
};

/// Work of the joint's forces on the nodes, J, by the trapezoid rule and from outside: from forces and positions alone.
struct NodalWork {
  const JointPair& pair;
  std::array<Vec3, 6> force{}, place{};
  double done = 0;

  explicit NodalWork(const JointPair& p) : pair(p) {
    for (std::size_t i = 0; i < 6; ++i) {
      force[i] = Vec3::Zero();
      place[i] = pair.place(i < 3, static_cast<int>(i % 3));
    }
  }
  /// To be called after each evaluation. @return what the joint has taken up so far
  double add() {
    for (std::size_t i = 0; i < 6; ++i) {
      const Vec3 f = pair.force(i < 3, static_cast<int>(i % 3)), x = pair.place(i < 3, static_cast<int>(i % 3));
      done -= 0.5 * (force[i] + f).dot(x - place[i]);
      force[i] = f;
      place[i] = x;
    }
    return done;
  }
};

}  // namespace breccia::test
