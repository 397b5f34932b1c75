#include "physics/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "mesh/random_rotation.hpp"

namespace breccia {
namespace {

constexpr int kFirstCheck = 20, kCheckEvery = 5, kMostIterations = 400;
constexpr double kResidual = 0.01;  // of the eigenvalue: half of it in the step
constexpr double kMargin = 1.01;    // the residual may be that of the eigenvalue just below the largest

void add_element(const LocalMesh& mesh, const ElasticParams& p, Index slot, const double* u, double* y) {
  const auto s = static_cast<std::size_t>(slot);
  const double* g = mesh.gradient.data() + s / kLanes * 72 + s % kLanes;
  std::array<Vec3, 4> grad;
  for (std::size_t c = 1; c < 4; ++c) {
    const double* row = g + 3 * (c - 1) * kLanes;
    grad[c] = {row[0], row[kLanes], row[2 * kLanes]};
  }
  grad[0] = -(grad[1] + grad[2] + grad[3]);
  Mat3 h = Mat3::Zero();
  for (int c = 0; c < 4; ++c)
    h += load_node(u, mesh.corner_node(slot, c)) * grad[static_cast<std::size_t>(c)].transpose();
  const Mat3 stress = mesh.volume[s] * (p.lambda * h.trace() * Mat3::Identity() + p.mu * (h + h.transpose()));
  for (int c = 0; c < 4; ++c) {
    const Index node = mesh.corner_node(slot, c);
    store_node(y, node, load_node(y, node) + stress * grad[static_cast<std::size_t>(c)]);
  }
}

void add_joints(const JointLinks& links, Index slot, const double* u, double* y) {
  for (int face = 0; face < 4; ++face) {
    const std::size_t at = JointLinks::at(slot, face);
    const int code = JointLinks::code_of(links.link[at]);
    if (code >= 12) continue;
    const Index other_slot = JointLinks::slot_of(links.link[at]);
    for (int i = 0; i < 3; ++i) {
      const Index own =
          own_corner_node(slot, kFaceCorners[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)]);
      const Index other = own_corner_node(other_slot, linked_corner(code, i));
      store_node(y, own, load_node(y, own) + links.stiffness[at] * (load_node(u, own) - load_node(u, other)));
    }
  }
}

/// Entries in -1..1 by global id of the node, zero on padding.
Eigen::VectorXd start_vector(const LocalMesh& mesh) {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.num_nodes));
  for (Index n = 0; n < mesh.num_nodes; ++n) {
    const GlobalId id = mesh.node_id[static_cast<std::size_t>(n)];
    if (id < 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint64_t bits = random_bits(1, static_cast<std::uint64_t>(id), static_cast<std::uint64_t>(axis));
      start[static_cast<Eigen::Index>(nodal(n, axis))] = static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
    }
  }
  return start.normalized();
}

/// 1/sqrt(m) by entry of a nodal field.
Eigen::VectorXd inverse_root_mass(const LocalMesh& mesh) {
  Eigen::VectorXd scale(3 * static_cast<Eigen::Index>(mesh.num_nodes));
  for (Index n = 0; n < mesh.num_nodes; ++n) {
    const double root = 1.0 / std::sqrt(mesh.node_mass[static_cast<std::size_t>(n)]);
    for (int axis = 0; axis < 3; ++axis) scale[static_cast<Eigen::Index>(nodal(n, axis))] = root;
  }
  return scale;
}

struct Ritz {
  double value, residual;
};

/// Largest eigenvalue of the tridiagonal matrix, and what is left out of it.
Ritz largest_ritz(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const auto n = static_cast<Eigen::Index>(alpha.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(alpha.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beta.data(), n - 1));
  return {solver.eigenvalues()[n - 1], beta.back() * std::abs(solver.eigenvectors()(n - 1, n - 1))};
}

}  // namespace

void stiffness_action(const StepModel& model, const double* u, double* y) {
  const LocalMesh& mesh = model.mesh;
  std::fill_n(y, 3 * static_cast<std::size_t>(mesh.num_nodes), 0.0);
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[static_cast<std::size_t>(s)] < 0) continue;
    const Index group = mesh.block_group[static_cast<std::size_t>(s / kLanes)];
    add_element(mesh, model.params[static_cast<std::size_t>(group)], s, u, y);
    if (s < mesh.num_own_slots) add_joints(model.links, s, u, y);
  }
}

double largest_eigenvalue(const StepModel& model) {
  const Eigen::VectorXd scale = inverse_root_mass(model.mesh);
  Eigen::VectorXd q = start_vector(model.mesh), previous = Eigen::VectorXd::Zero(q.size()), product(q.size());
  std::vector<double> alpha, beta;
  for (int k = 1;; ++k) {
    stiffness_action(model, Eigen::VectorXd(scale.cwiseProduct(q)).data(), product.data());
    product = product.cwiseProduct(scale);
    if (!beta.empty()) product -= beta.back() * previous;
    alpha.push_back(q.dot(product));
    product -= alpha.back() * q;
    beta.push_back(product.norm());
    // An invariant subspace is found whole: Ritz values are eigenvalues.
    const bool last = beta.back() <= 1e-10 * alpha.front() || k == kMostIterations;
    if (last || (k >= kFirstCheck && k % kCheckEvery == 0)) {
      const Ritz ritz = largest_ritz(alpha, beta);
      if (last || ritz.residual <= kResidual * ritz.value) return kMargin * (ritz.value + ritz.residual);
    }
    previous = q;
    q = product / beta.back();
  }
}

}  // namespace breccia
