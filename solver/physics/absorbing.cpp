#include "physics/absorbing.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "physics/kick.hpp"

namespace breccia {
namespace {

/// What a face adds to each of its corners, N s/m.
Mat3 impedance_of(const AbsorbingSurfaces::Part& face, const LocalMesh& mesh) {
  const Vec3 doubled = doubled_area(mesh.reference, face_nodes(mesh, face.face));
  const double size = doubled.norm();
  const Mat3 along = doubled * doubled.transpose() / (size * size);
  return size / 6.0 * (face.normal * along + face.tangent * (Mat3::Identity() - along));
}

}  // namespace

AbsorbingBoundary::AbsorbingBoundary(const AbsorbingSurfaces& surfaces, const LocalMesh& mesh, const Constraints& held,
                                     std::span<const NodeForce> before)
    : mesh_(&mesh) {
  std::vector<AbsorbingSurfaces::Part> parts = surfaces.faces;
  const auto comes_first = [](const auto& a, const auto& b) { return comes_before(a.face, b.face); };
  std::sort(parts.begin(), parts.end(), comes_first);
  const auto same = [&](const auto& a, const auto& b) { return !comes_first(a, b); };  // of two in order
  parts.erase(std::unique(parts.begin(), parts.end(), same), parts.end());
  std::map<Index, Mat3> sums;
  for (const Index node : surfaces.nodes) {
    if (mesh.is_moved(node)) sums.emplace(node, Mat3::Zero());
  }
  for (const AbsorbingSurfaces::Part& part : parts) {
    const Mat3 impedance = impedance_of(part, mesh);
    for (const Index node : face_nodes(mesh, part.face)) {
      if (mesh.is_moved(node)) sums.emplace(node, Mat3::Zero()).first->second += impedance;
    }
  }
  const std::vector<Index>& held_nodes = held.nodes();
  for (const auto& [node, impedance] : sums) {
    Vec3 free = Vec3::Ones();
    const auto found = std::lower_bound(held_nodes.begin(), held_nodes.end(), node);
    if (found != held_nodes.end() && *found == node) {
      const auto& axes = held.held_axes()[static_cast<std::size_t>(found - held_nodes.begin())];
      for (std::size_t a = 0; a < 3; ++a) free[static_cast<Eigen::Index>(a)] = axes[a] ? 0.0 : 1.0;
    }
    Node& entry = nodes_.emplace_back(Node{node, free.asDiagonal() * impedance * free.asDiagonal()});
    const auto force =
        std::lower_bound(before.begin(), before.end(), node, [](const NodeForce& f, Index n) { return f.node < n; });
    if (force != before.end() && force->node == node) entry.support = free.cwiseProduct(force->force);
  }
}

void AbsorbingBoundary::begin(const Field<double>& velocity) {
  for (Node& entry : nodes_) entry.velocity = load_node(velocity.data(), entry.node);
}

void AbsorbingBoundary::apply(NodalState& state, double dt_before, double dt, double* damping_before,
                              double* damping_after) {
  const double kick = kick_length(dt_before, dt);
  for (const Node& entry : nodes_) {
    const auto at = static_cast<std::size_t>(entry.node);
    const double mass = mesh_->node_mass[at];
    const Vec3 free = load_node(state.velocity.data(), entry.node), &before = entry.velocity;
    const Mat3 half = 0.5 * kick * entry.impedance;
    const Mat3 sum = mass * Mat3::Identity() + half;
    const Vec3 after = sum.inverse() * (mass * free + kick * entry.support - half * before);
    const Vec3 force = 0.5 * (entry.impedance * (before + after));  // against the motion
    // Where a velocity turns within the step one of its halves alone would give something back.
    const double first = (kick - 0.5 * dt) * force.dot(before),
                 all = std::max(0.0, first + 0.5 * dt * force.dot(after));
    const double taken_before = std::clamp(first, 0.0, all);
    damping_before[at] += taken_before;
    damping_after[at] += all - taken_before;
    if (mesh_->counted[at] != 0) work_.add_before(entry.support.dot(before), dt_before);
    store_node(state.velocity.data(), entry.node, after);
    store_node(state.next_position.data(), entry.node, load_node(state.position.data(), entry.node) + dt * after);
  }
}

void AbsorbingBoundary::account_after(const Field<double>& velocity, double dt) {
  for (const Node& entry : nodes_) {
    if (mesh_->counted[static_cast<std::size_t>(entry.node)] != 0)
      work_.add_after(entry.support.dot(load_node(velocity.data(), entry.node)), dt);
  }
}

std::vector<NodeForce> AbsorbingBoundary::supports() const {
  std::vector<NodeForce> forces;
  for (const Node& entry : nodes_) {
    if (entry.support != Vec3::Zero()) forces.push_back({entry.node, entry.support});
  }
  return forces;
}

}  // namespace breccia
