#include "physics/initial_velocity.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "mesh/random_rotation.hpp"

namespace breccia {
namespace {

/// Stream of random bits kept apart from the mesh generator's rotations of the same seed.
constexpr std::uint64_t kVelocityStream = 0x56454c4f43495459ULL;

/// Body of every node that is moved, -1 for the others.
std::vector<Index> bodies_of_nodes(const LocalMesh& mesh, const InitialVelocity& initial) {
  std::vector<Index> body(static_cast<std::size_t>(mesh.num_nodes), -1);
  for (Index s = 0; s < mesh.num_slots; ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (!initial.moves(mesh, s)) continue;
    for (int c = 0; c < 4; ++c) {
      Index& known = body[static_cast<std::size_t>(mesh.corner_node(s, c))];
      if (known < 0) known = mesh.slot_body[i];
    }
  }
  return body;
}

}  // namespace

Vec3 random_velocity(std::uint64_t seed, std::uint64_t body, const std::array<double, 2>& speed) {
  std::uint64_t drawn = 0;
  const auto unit = [&] {
    return static_cast<double>(random_bits(seed, body ^ kVelocityStream, drawn++) >> 11) * 0x1p-53;
  };
  const double length = speed[0] + (speed[1] - speed[0]) * unit();
  Vec3 direction;
  double square = 0;
  do {  // points of the cube that lie in the ball: uniform directions without a sine
    for (Eigen::Index i = 0; i < 3; ++i) direction[i] = 2.0 * unit() - 1.0;
    square = direction.squaredNorm();
  } while (square > 1.0 || square < 1e-6);
  return length / std::sqrt(square) * direction;
}

std::vector<double> mass_share(const LocalMesh& mesh, const std::vector<double>& density,
                               const InitialVelocity& initial) {
  const auto size = static_cast<std::size_t>(mesh.num_nodes);
  std::vector<double> all(size, 0.0), mine(size, 0.0), share(size, 1.0);
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (mesh.element_of_slot[i] < 0) continue;
    const double mass = density[static_cast<std::size_t>(mesh.block_group[i / kLanes])] * mesh.volume[i];
    const bool moved = initial.moves(mesh, s);
    for (int c = 0; c < 4; ++c) {
      const auto node = static_cast<std::size_t>(mesh.corner_node(s, c));
      all[node] += mass;
      if (moved) mine[node] += mass;
    }
  }
  bool several = false;
  for (std::size_t n = 0; n < size; ++n) {
    if (!(mine[n] > 0) || mine[n] == all[n]) continue;
    share[n] = mine[n] / all[n];
    several = true;
  }
  return several ? share : std::vector<double>{};
}

void add_initial_velocity(const LocalMesh& mesh, const InitialVelocity& initial, const Field<double>& position,
                          Field<double>& velocity, const std::vector<double>& share) {
  const std::vector<Index> body = bodies_of_nodes(mesh, initial);
  const bool random = initial.speed[0] != 0 || initial.speed[1] != 0;
  for (Index n = 0; n < mesh.num_nodes; ++n) {
    const Index b = body[static_cast<std::size_t>(n)];
    if (b < 0) continue;
    Vec3 added = initial.uniform;
    if (random) added += random_velocity(initial.seed, static_cast<std::uint64_t>(b), initial.speed);
    if (!initial.centre.empty()) {
      const Vec3 arm = load_node(position.data(), n) - initial.centre[static_cast<std::size_t>(b)];
      added += initial.angular.cross(arm);
      added += initial.strain_rate.cwiseProduct(arm);
    }
    if (!share.empty()) added *= share[static_cast<std::size_t>(n)];
    store_node(velocity.data(), n, load_node(velocity.data(), n) + added);
  }
}

}  // namespace breccia
