#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "base/index.hpp"
#include "base/time_function.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_state.hpp"
#include "mesh/joints.hpp"
#include "mesh/raster.hpp"
#include "mesh/topology.hpp"
#include "physics/elasticity.hpp"
#include "physics/loads.hpp"

namespace breccia::test {

/// A small model: raster of cubes, jittered or not.
struct Model {
  Mesh mesh;
  Topology topology;
  LocalMesh local;
  JointLinks links;  // all free until `join`
  NodalState state;

  Model(Mesh m, Discretisation kind, double density) : mesh(std::move(m)), topology(build_topology(mesh)) {
    const std::size_t groups = mesh.volume_groups.size();
    local = build_local_mesh(mesh, std::vector<Discretisation>(groups, kind), std::vector<double>(groups, density));
    links.reset(local.num_own_slots);
    state.position = local.reference;
    state.next_position = local.reference;
    state.velocity.assign(local.reference.size(), 0.0);
  }

  /// Elastic joints of stiffness k (Pa/m) on every inner face.
  void join(double k) {
    for (const JointFace& joint : find_joints(mesh, topology)) {
      const FaceLink& there = topology.links[at(joint.a)][at(joint.face_a)];
      const Index a = local.slot_of_element[at(joint.a)], b = local.slot_of_element[at(joint.b)];
      links.attach(a, joint.face_a, b, there.code);
      links.stiffness[JointLinks::at(a, joint.face_a)] = k * joint.area / 3.0;
      links.stiffness[JointLinks::at(b, there.face())] = k * joint.area / 3.0;
    }
  }

  [[nodiscard]] std::vector<Index> real_nodes() const {
    std::vector<Index> nodes;
    for (Index n = 0; n < local.num_nodes; ++n) {
      if (local.node_id[at(n)] >= 0) nodes.push_back(n);
    }
    return nodes;
  }

  [[nodiscard]] std::vector<LoadedFace> free_faces() const {
    std::vector<LoadedFace> faces;
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        if (topology.links[at(e)][at(f)].free()) faces.push_back({local.slot_of_element[at(e)], f});
      }
    }
    return faces;
  }

  void map_positions(const auto& map) {
    for (const Index n : real_nodes()) store_node(state.position.data(), n, map(load_node(local.reference.data(), n)));
  }
};

/// constant + slope t + amplitude sin(2 pi frequency t).
inline TimeFunction in_time(double constant, double slope = 0, double amplitude = 0, double frequency = 0) {
  TimeFunction f;
  f.constant = constant;
  f.linear = slope;
  if (amplitude != 0) f.sines.push_back({amplitude, frequency, 0.0});
  return f;
}

/// Box of cubes of 24 tetrahedra.
inline Mesh box(std::array<int, 3> cells, double edge = 1.0, std::array<int, 3> boxes = {1, 1, 1}, double gap = 0.5) {
  return make_raster(
             {.cells = cells, .cell_size = Vec3::Constant(edge), .boxes = boxes, .gap = Vec3::Constant(gap * edge)})
      .mesh;
}

/// Regular tetrahedra, each a body.
inline Mesh tetrahedron(double edge = 1.0, std::array<int, 3> boxes = {1, 1, 1}) {
  return make_raster({.cell_size = Vec3::Constant(edge), .boxes = boxes, .single_tetrahedra = true}).mesh;
}

/// The same mesh with every node moved at random by up to `share`; volumes stay positive for a share below 0.1 or so.
inline Mesh jittered(Mesh mesh, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-share, share);
  for (Vec3& x : mesh.nodes) x += Vec3(move(random), move(random), move(random));
  return mesh;
}

inline Mat3 random_matrix(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> entry(-size, size);
  Mat3 m;
  for (Eigen::Index i = 0; i < 9; ++i) m.data()[i] = entry(random);
  return m;
}

inline elasticity::Tensor<double> tensor(const Mat3& m) {
  elasticity::Tensor<double> t;
  for (std::size_t i = 0; i < 9; ++i) t[i] = m(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  return t;
}

inline Mat3 matrix(const elasticity::Tensor<double>& t) {
  Mat3 m;
  for (std::size_t i = 0; i < 9; ++i) m(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = t[i];
  return m;
}

/// Elastic and viscous forces of all elements on a nodal field, N.
inline Field<double> internal_forces(const Model& model, const ElasticParams& params, const Field<double>& position,
                                     const Field<double>& velocity) {
  const LocalMesh& mesh = model.local;
  Field<double> force(position.size(), 0.0);
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[at(s)] < 0) continue;
    elasticity::Corners<double> x, v;
    elasticity::Tensor<double> inverse;
    for (int c = 0; c < 4; ++c) {
      for (int i = 0; i < 3; ++i) {
        x[at(c)][at(i)] = position[nodal(mesh.corner_node(s, c), i)];
        v[at(c)][at(i)] = velocity[nodal(mesh.corner_node(s, c), i)];
      }
    }
    for (std::size_t i = 0; i < 9; ++i) inverse[i] = mesh.gradient[at(s) / kLanes * 72 + i * kLanes + at(s) % kLanes];
    const auto f = elasticity::element_forces(x, v, inverse, mesh.volume[at(s)], params);
    for (int c = 0; c < 4; ++c) {
      for (int i = 0; i < 3; ++i) force[nodal(mesh.corner_node(s, c), i)] += f[at(c)][at(i)];
    }
  }
  return force;
}

}  // namespace breccia::test
