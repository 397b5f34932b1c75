#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/local_mesh.hpp"

namespace breccia {

/// Velocity with which the bodies of a volume group or an element set start.
struct InitialVelocity {
  Index group = 0;                    ///< volume group; of no effect where there are members
  Vec3 uniform{0, 0, 0};              ///< m/s
  std::array<double, 2> speed{0, 0};  ///< m/s: range of a random velocity by body, added
  std::uint64_t seed = 1;
  Vec3 angular{0, 0, 0};                ///< rad/s about `centre`, added
  Vec3 strain_rate{0, 0, 0};            ///< 1/s along the axes from `centre`, added
  std::vector<Vec3> centre{};           ///< (bodies) m, centres of mass; empty: neither of them
  std::vector<std::uint8_t> members{};  ///< (slots) 1: in the element set; empty: it is a volume group

  [[nodiscard]] bool moves(const LocalMesh& mesh, Index slot) const {
    const auto s = static_cast<std::size_t>(slot);
    return mesh.element_of_slot[s] >= 0 && (members.empty() ? mesh.block_group[s / kLanes] == group : members[s] != 0);
  }
};

/// Share of the elements that are moved in the mass of nodes that they share with others, (num_nodes); empty: with none
/// @param density  (volume groups) kg/m3. O(elements that share nodes).
[[nodiscard]] std::vector<double> mass_share(const LocalMesh& mesh, const std::vector<double>& density,
                                             const InitialVelocity& initial);

/// Adds uniform + random(body) + angular x r + strain_rate * r, r = x - centre, * by components, to every node of the
/// group, each node once. A node shared by two bodies of the group counts with the one of the element of lowest slot.
/// A node shared by several groups gets the mean of their velocities by mass: what keeps its momentum.
/// @param share  as mass_share has it
/// @param position, velocity  nodal fields, m, m/s. O(nodes).
void add_initial_velocity(const LocalMesh& mesh, const InitialVelocity& initial, const Field<double>& position,
                          Field<double>& velocity, const std::vector<double>& share = {});

/// Velocity of length uniform in [speed[0], speed[1]] and direction uniform over the sphere, m/s. Depends on (seed,
/// body) alone, not on how many bodies there are, and uses integer arithmetic, + - * / and sqrt only: the same on every
/// machine.
[[nodiscard]] Vec3 random_velocity(std::uint64_t seed, std::uint64_t body, const std::array<double, 2>& speed);

}  // namespace breccia
