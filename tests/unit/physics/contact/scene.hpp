#pragma once

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/index.hpp"
#include "discretisation/local_mesh.hpp"
#include "mesh/mesh.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/quality.hpp"
#include "mesh/raster.hpp"
#include "mesh/topology.hpp"
#include "physics/contact/couples.hpp"
#include "physics/contact/forces.hpp"
#include "physics/contact/geometry/field.hpp"

/// Small models for the contact tests.
namespace breccia::test {

/// Raster of one box as a mesh of its own.
inline Mesh box(std::array<int, 3> cells, double cell, const Vec3& origin = Vec3::Zero()) {
  return make_raster({.cells = cells, .cell_size = Vec3::Constant(cell), .origin = origin}).mesh;
}

/// One tetrahedron.
inline Mesh lone(const std::array<Vec3, 4>& corners) {
  Mesh mesh;
  mesh.nodes.assign(corners.begin(), corners.end());
  mesh.elements = {{0, 1, 2, 3}};
  mesh.element_group = {0};
  mesh.element_body = {0};
  mesh.element_source_id = {1};
  mesh.volume_groups = {"lone"};
  mesh.num_bodies = 1;
  return mesh;
}

/// A wall of n x n bricks of 1 x 1 x `thickness` m, six tetrahedra each: every node lies on the surface.
inline Mesh wall(int n, double thickness) {
  Mesh mesh;
  mesh.volume_groups = {"wall"};
  mesh.num_bodies = 1;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.nodes.emplace_back(i, j, k * thickness);
    }
  }
  const auto node = [&](int i, int j, int k) { return static_cast<Index>((k * (n + 1) + j) * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      // Kuhn's division: along the axes from one corner to the opposite one, in every order.
      for (const std::array<int, 3>& order :
           {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}) {
        std::array<int, 3> at_corner{i, j, 0};
        std::array<Index, 4> corners{node(i, j, 0)};
        for (std::size_t c = 0; c < 3; ++c) {
          ++at_corner[at(order[c])];
          corners[c + 1] = node(at_corner[0], at_corner[1], at_corner[2]);
        }
        const auto x = [&](std::size_t c) { return mesh.nodes[at(corners[c])]; };
        if ((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) < 0) std::swap(corners[2], corners[3]);
        mesh.elements.push_back(corners);
      }
    }
  }
  mesh.element_group.assign(mesh.elements.size(), 0);
  mesh.element_body = mesh.element_group;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.element_source_id.push_back(static_cast<std::int64_t>(e + 1));
  return mesh;
}

/// Both meshes; groups and bodies of `b` come after those of `a`.
inline Mesh joined(Mesh a, const Mesh& b) {
  const Index nodes = a.num_nodes(), groups = static_cast<Index>(a.volume_groups.size());
  a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
  for (Index e = 0; e < b.num_elements(); ++e) {
    std::array<Index, 4> corners = b.elements[at(e)];
    for (Index& corner : corners) corner += nodes;
    a.elements.push_back(corners);
    a.element_group.push_back(b.element_group[at(e)] + groups);
    a.element_body.push_back(b.element_body[at(e)] + a.num_bodies);
    a.element_source_id.push_back(b.element_source_id[at(e)]);
  }
  for (const std::string& name : b.volume_groups) a.volume_groups.push_back(name + "'");
  a.num_bodies += b.num_bodies;
  a.surface_faces.clear();
  a.surface_groups.clear();
  return a;
}

/// Applies a map to all nodes.
inline Mesh moved(Mesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& x : mesh.nodes) x = map(x);
  return mesh;
}

inline Mat3 random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

/// A model with all free faces as targets, all elements as contactors and every point coupled with every contactor of
/// another body (groups with a law): what a search with an infinite buffer would give.
struct Scene {
  Mesh mesh;
  Topology topology;
  LocalMesh local;
  ContactParams params;
  NodalState state;
  ContactState contact;
  ContactWork work;
  NodalForces forces{0, 0};

  Scene(Mesh m, const ContactLaw& law, int points_per_face = 1, OverlapField field = OverlapField::body,
        Discretisation discretisation = Discretisation::own_nodes, double density = 1000)
      : mesh(std::move(m)), topology(build_topology(mesh)) {
    const std::size_t groups = mesh.volume_groups.size();
    local = build_local_mesh(mesh, std::vector(groups, discretisation), std::vector(groups, density));
    params.points_per_face = points_per_face;
    params.points_everywhere = false;  // couples are chosen by tests: each point presses with its whole weight
    params.field = field;
    params.num_groups = static_cast<Index>(groups);
    params.laws.assign(groups * groups, law);
    state.position = local.reference;
    state.velocity.assign(local.reference.size(), 0.0);
    set_contactors(local, local.slot_of_element, contact);
    contact.body_length = mean_inradii(mesh);
    contact.body_extent = body_extents(mesh);
    build_field(params, mesh, local, surface_depth(std::vector<bool>(groups), mesh, topology), contact);
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        if (topology.links[at(e)][at(f)].free())
          add_face_points(params, local, local.slot_of_element[at(e)], f, contact);
      }
    }
    sort_points(contact);
    couple_bodies();
  }

  /// Only points of elements for which `target` holds, and contactors for which `contactor` holds, are coupled.
  void couple(const std::function<bool(Index slot)>& target, const std::function<bool(Index slot)>& contactor) {
    contact.couples.clear();
    for (const Index p : contact.order) {
      const Index slot = contact.points[at(p)].slot;
      if (!target(slot)) continue;
      for (Index c = 0; c < static_cast<Index>(contact.contactors.size()); ++c) {
        const Index other = contact.contactors[at(c)];
        if (slot != other && contactor(other)) contact.couples.push_back({p, c});
      }
    }
    couples_replaced(contact);
  }

  void couple_bodies() {
    contact.couples.clear();
    for (const Index p : contact.order) {
      for (Index c = 0; c < static_cast<Index>(contact.contactors.size()); ++c) {
        if (body(contact.points[at(p)].slot) != body(contact.contactors[at(c)])) contact.couples.push_back({p, c});
      }
    }
    couples_replaced(contact);
  }

  [[nodiscard]] Index body(Index slot) const { return local.slot_body[at(slot)]; }

  void evaluate(double dt) {
    forces = NodalForces(local.num_own_blocks(), local.num_nodes);
    contact_forces(params, local, state, dt, contact, forces, work);
  }

  /// Nodes of the elements of a body, each once.
  [[nodiscard]] std::vector<Index> nodes_of(Index wanted) const {
    std::vector<bool> is_node(at(local.num_nodes), false);
    for (Index s = 0; s < local.num_slots; ++s) {
      for (int c = 0; c < 4 && body(s) == wanted; ++c) is_node[at(local.corner_node(s, c))] = true;
    }
    std::vector<Index> nodes;
    for (Index n = 0; n < local.num_nodes; ++n) {
      if (is_node[at(n)]) nodes.push_back(n);
    }
    return nodes;
  }

  [[nodiscard]] Vec3 force_on(Index wanted) const {
    Vec3 sum = Vec3::Zero();
    for (const Index n : nodes_of(wanted)) sum += forces.get(n);
    return sum;
  }

  void shift(Index wanted, const Vec3& by) {
    for (const Index n : nodes_of(wanted))
      store_node(state.position.data(), n, load_node(state.position.data(), n) + by);
  }

  void set_velocity(Index wanted, const Vec3& v) {
    for (const Index n : nodes_of(wanted)) store_node(state.velocity.data(), n, v);
  }
};

/// Regular tetrahedron of edge a with its base in the plane x = 0, apex on the negative x axis.
inline std::array<Vec3, 4> regular_tetra(double a) {
  const double r = a / std::sqrt(3.0), height = a * std::sqrt(2.0 / 3.0);
  const auto base = [&](double angle) { return Vec3(0, r * std::cos(angle), r * std::sin(angle)); };
  const double third = 2 * std::acos(-1.0) / 3;
  return {Vec3(-height, 0, 0), base(0), base(third), base(2 * third)};
}

}  // namespace breccia::test
