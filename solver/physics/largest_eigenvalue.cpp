#include "physics/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/error.hpp"
#include "base/field.hpp"
#include "mesh/random_rotation.hpp"

namespace breccia {
namespace {

constexpr int kFirstCheck = 20, kCheckEvery = 5, kMostIterations = 400;
constexpr double kResidual = 0.01;  // of the eigenvalue: half of it in the step
constexpr double kMargin = 1.01;    // the residual may be that of the eigenvalue just below the largest

using EightLanes = Eigen::Array<double, kLanes, 1>;
using Triple = std::array<EightLanes, 3>;

Eigen::Map<const EightLanes, Eigen::Aligned64> lanes(const double* first) {
  return Eigen::Map<const EightLanes, Eigen::Aligned64>(first);
}

/// sum_c u_c g_c^T of eight elements, by row. @param u  of the block's corners
std::array<Triple, 3> displacement_gradient(const std::array<Triple, 4>& grad, const double* u) {
  std::array<Triple, 3> h;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      h[i][j] = EightLanes::Zero();
      for (std::size_t c = 0; c < 4; ++c) h[i][j] += lanes(u + (3 * c + i) * kLanes) * grad[c][j];
    }
  }
  return h;
}

/// Adds what eight elements' own sides of the intact joints on one face pull with. @param force  (corners)
void add_joints(const JointLinks& links, std::size_t block, std::size_t face, const double* u,
                std::array<Triple, 4>& force) {
  const auto stiffness = lanes(links.stiffness.data() + block * 32 + face * kLanes);
  const std::int32_t* place = links.place.data() + block * 96 + face * 24;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corner = static_cast<std::size_t>(kFaceCorners[face][i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EightLanes other;
      for (std::size_t l = 0; l < kLanes; ++l)
        other[static_cast<Eigen::Index>(l)] = u[static_cast<std::size_t>(place[i * kLanes + l]) + axis * kLanes];
      force[corner][axis] += stiffness * (lanes(u + block * 96 + (3 * corner + axis) * kLanes) - other);
    }
  }
}

/// Hooke's forces on the corners of eight elements. @param u  of their corners, [12][8]
std::array<Triple, 4> element_forces(const StepModel& model, std::size_t block, const double* u) {
  const ElasticParams& p = model.params[static_cast<std::size_t>(model.mesh.block_group[block])];
  const double* g = model.mesh.gradient.data() + block * 72;
  std::array<Triple, 4> grad, force;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t c = 1; c < 4; ++c) grad[c][j] = lanes(g + (3 * (c - 1) + j) * kLanes);
    grad[0][j] = -(grad[1][j] + grad[2][j] + grad[3][j]);
  }
  const std::array<Triple, 3> h = displacement_gradient(grad, u);
  const EightLanes pressure = p.lambda * (h[0][0] + h[1][1] + h[2][2]);
  const auto volume = lanes(model.mesh.volume.data() + block * kLanes);
  for (std::size_t i = 0; i < 3; ++i) {
    Triple stress;
    for (std::size_t j = 0; j < 3; ++j) {
      stress[j] = p.mu * (h[i][j] + h[j][i]);
      if (i == j) stress[j] += pressure;
      stress[j] *= volume;
    }
    for (std::size_t c = 0; c < 4; ++c)
      force[c][i] = stress[0] * grad[c][0] + stress[1] * grad[c][1] + stress[2] * grad[c][2];
  }
  return force;
}

void act_on_own(const StepModel& model, std::size_t block, const double* u, double* y) {
  std::array<Triple, 4> force = element_forces(model, block, u + block * 96);
  for (std::size_t face = 0; face < 4; ++face) add_joints(model.links, block, face, u, force);
  for (std::size_t k = 0; k < 12; ++k)
    Eigen::Map<EightLanes, Eigen::Aligned64>(y + block * 96 + k * kLanes) = force[k / 3][k % 3];
}

void act_on_shared(const StepModel& model, std::size_t block, const double* u, double* y) {
  const LocalMesh& mesh = model.mesh;
  const auto* corners = mesh.shared_corners.data() + (block - static_cast<std::size_t>(mesh.num_own_blocks())) * kLanes;
  alignas(64) std::array<double, 96> gathered;
  const auto each = [&](auto&& visit) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (std::size_t k = 0; k < 12; ++k) visit(nodal(corners[lane][k / 3], static_cast<int>(k % 3)), lane, k);
    }
  };
  each([&](std::size_t place, std::size_t lane, std::size_t k) { gathered[k * kLanes + lane] = u[place]; });
  const std::array<Triple, 4> force = element_forces(model, block, gathered.data());
  each([&](std::size_t place, std::size_t lane, std::size_t k) {
    y[place] += force[k / 3][k % 3][static_cast<Eigen::Index>(lane)];
  });
}

/// Adds the forces of joints that the sweep does not evaluate.
void act_on_joints(const StepModel& model, const double* u, double* y) {
  const LocalMesh& mesh = model.mesh;
  for (const JointStiffness& joint : model.joints) {
    std::array<Index, 3> a, b;
    std::array<Vec3, 3> opening;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = mesh.corner_node(joint.slot_a, kFaceCorners[static_cast<std::size_t>(joint.face_a)][i]);
      b[i] = mesh.corner_node(joint.slot_b, matching_corner(joint.code, static_cast<int>(i)));
      opening[i] = joint.stiffness * (load_node(u, a[i]) - load_node(u, b[i]));
    }
    const Vec3 mean = 0.25 * (opening[0] + opening[1] + opening[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 force = joint.mid_edge ? Vec3(0.25 * opening[i] + mean) : opening[i];
      store_node(y, a[i], load_node(y, a[i]) + force);
      store_node(y, b[i], load_node(y, b[i]) - force);
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
  return start;
}

/// u . v over the nodes that this rank counts. Exact sum of the products of each element with nodes of its own and of
/// each shared node, so that it does not depend on who holds what.
ExactSum product_of(const LocalMesh& mesh, const Eigen::Ref<const Eigen::VectorXd>& u,
                    const Eigen::Ref<const Eigen::VectorXd>& v) {
  ExactSum sum;
  const auto add = [&](Index node, double before) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(nodal(node, axis));
      before += u[i] * v[i];
    }
    return before;
  };
  for (Index s = 0; s < mesh.num_own_slots; ++s) {
    if (!mesh.is_original(s)) continue;
    double of_element = 0;
    for (int c = 0; c < 4; ++c) of_element = add(own_corner_node(s, c), of_element);
    sum.add(of_element);
  }
  for (Index n = mesh.num_own_nodes(); n < mesh.num_nodes; ++n) {
    if (mesh.counted[static_cast<std::size_t>(n)] != 0) sum.add(add(n, 0));
  }
  return sum;
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

/// The sums are exact and the same on all ranks, and so is the error.
[[noreturn]] void refuse_stiffness() {
  throw InputError({"", 0, "", "stiffness over mass leaves the range of numbers: there is no stable time step",
                    "moduli, penalties, densities, viscosities and element sizes of materials, in the units meant",
                    ""});
}

}  // namespace

void stiffness_action(const StepModel& model, const double* u, double* y) {
  const LocalMesh& mesh = model.mesh;
  const auto own = static_cast<std::size_t>(mesh.num_own_blocks()), all = static_cast<std::size_t>(mesh.num_blocks());
  for (std::size_t block = 0; block < own; ++block) act_on_own(model, block, u, y);
  std::fill(y + own * 96, y + 3 * static_cast<std::size_t>(mesh.num_nodes), 0.0);
  for (std::size_t block = own; block < all; ++block) act_on_shared(model, block, u, y);
  act_on_joints(model, u, y);
}

double largest_eigenvalue(const StepModel& model, const RankOperations& ranks) {
  const LocalMesh& mesh = model.mesh;
  const auto dot = [&](const auto& u, const auto& v) { return ranks.total(product_of(mesh, u, v)); };
  const Eigen::VectorXd scale = inverse_root_mass(mesh);
  Eigen::VectorXd q = start_vector(mesh), previous = Eigen::VectorXd::Zero(q.size());
  q /= std::sqrt(dot(q, q));
  Field<double> displacement(static_cast<std::size_t>(q.size())), force(displacement.size());
  Eigen::Map<Eigen::VectorXd> scaled(displacement.data(), q.size()), product(force.data(), q.size());
  std::vector<double> alpha, beta;
  for (int k = 1;; ++k) {
    scaled = q.cwiseProduct(scale);
    ranks.gather(displacement);
    stiffness_action(model, displacement.data(), force.data());
    product = product.cwiseProduct(scale) - (beta.empty() ? 0.0 : beta.back()) * previous;
    alpha.push_back(dot(q, product));
    product -= alpha.back() * q;
    beta.push_back(std::sqrt(dot(product, product)));
    if (!std::isfinite(alpha.back()) || !std::isfinite(beta.back())) refuse_stiffness();
    // An invariant subspace is found whole: Ritz values are eigenvalues.
    const bool last = beta.back() <= 1e-10 * alpha.front() || k == kMostIterations;
    if (last || (k >= kFirstCheck && k % kCheckEvery == 0)) {
      const Ritz ritz = largest_ritz(alpha, beta);
      if (last || ritz.residual <= kResidual * ritz.value) return kMargin * (ritz.value + ritz.residual);
    }
    previous.swap(q);
    q = product / beta.back();
  }
}

}  // namespace breccia
