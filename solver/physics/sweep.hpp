#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/index.hpp"
#include "physics/elasticity.hpp"

namespace breccia {

/// Result of the sweep for its elements. Flags, not exceptions: the step turns them into errors.
struct SweepStatus {
  double max_speed_squared = 0;  ///< m2/s2, over all nodes, after the step
  double speed_squared_sum = 0;  ///< m2/s2; NaN or infinite when any node's velocity is
  std::int64_t crushed = 0;      ///< originals with J < j_min in this step
  Index first_not_finite = -1;   ///< block

  /// Likewise for more elements, which stand behind these.
  void add(const SweepStatus& next) {
    max_speed_squared = max_speed_squared < next.max_speed_squared ? next.max_speed_squared : max_speed_squared;
    speed_squared_sum += next.speed_squared_sum;
    crushed += next.crushed;
    if (first_not_finite < 0) first_not_finite = next.first_not_finite;
  }
};

/// A joint's opening has passed the range in which it is surely elastic: forces on the three corners of this side's
/// face, from the virgin state. Called by the sweep, seldom.
/// @param force  out: [corner 0..2 of the face][axis], N
using CrossingFunction = void (*)(void* context, Index slot, int face, double* force);

/// Everything the sweep reads and writes; raw pointers, so that one kernel source serves every instruction set.
/// Layouts: discretisation/layout.hpp, local_mesh.hpp, joint_links.hpp, nodal_forces.hpp.
struct SweepArgs {
  Index first_own_block = 0;             ///< own-node blocks to sweep: from this one
  Index end_own_block = 0;               ///< to before this one
  Index num_own_blocks = 0;              ///< of the model: where shared-node blocks begin
  const Index* shared_blocks = nullptr;  ///< shared-node blocks to sweep, ascending
  Index num_shared_blocks = 0;
  Index num_moved_nodes = 0;  ///< end of the shared nodes to move

  const double* position = nullptr;     ///< nodal field, x_n
  double* next_position = nullptr;      ///< nodal field, out: x_(n+1)
  double* velocity = nullptr;           ///< nodal field, in: v_(n-1/2), out: v_(n+1/2)
  const double* gradient = nullptr;     ///< [block][9][8]
  const double* volume = nullptr;       ///< [block][8]
  const double* node_mass = nullptr;    ///< (num_nodes)
  const double* free_across = nullptr;  ///< (num_nodes) 1: moves along the axis `across`, 0: does not and never
                                        ///< has; null: all nodes move along all axes
  std::size_t across = 0;
  const std::int32_t* shared_corners = nullptr;  ///< [shared block][4][8] nodes

  const std::int32_t* link = nullptr;   ///< [own block][4][8]
  const std::int32_t* place = nullptr;  ///< [own block][4][3][8]
  const double* stiffness = nullptr;    ///< [own block][4][8]
  const double* limit = nullptr;        ///< [own block][8]
  CrossingFunction crossing = nullptr;
  void* crossing_context = nullptr;

  const Index* force_slot = nullptr;  ///< (own blocks) slot of the block's nodal forces, -1: none
  const double* own_force = nullptr;  ///< [slot][4][3][8] N
  double* shared_force = nullptr;     ///< nodal field of the shared nodes, N; internal forces are added to it

  const Index* block_group = nullptr;      ///< (num_blocks)
  const std::uint8_t* original = nullptr;  ///< (num_slots) 1: of this rank; others do not count in SweepStatus::crushed
  const ElasticParams* params = nullptr;   ///< (groups)

  double* memory = nullptr;       ///< [slot][memory_stride] what elements remember whose law has a memory
  std::size_t memory_stride = 0;  ///< (physics/material/bulk_law.hpp)

  double dt = 0;                           ///< s, from x_n to x_(n+1)
  double kick = 0;                         ///< s, from v_(n-1/2) to v_(n+1/2): kick_length()
  std::array<double, 3> gravity{0, 0, 0};  ///< m/s2
  double mass_damping = 0;                 ///< 1/s, f = -alpha m (v_(n-1/2) + v_(n+1/2)) / 2
  double local_damping = 0;                ///< f = -beta |f| sign(v_(n-1/2)) by component of the unbalanced force

  /// Work done so far against viscosity and by the elastic stress of laws without an energy, by element slot, J;
  /// dissipated by damping, by node, J. Each step adds its half before t_n to *_before and its half after t_n to
  /// *_after (reason: base/work_sum.hpp); both may be the same array. Null: not required.
  double* viscous_before = nullptr;
  double* viscous_after = nullptr;
  double* stress_before = nullptr;
  double* stress_after = nullptr;
  double* kept_stress = nullptr;  ///< scratch [block][18][8], needed when one of the four above is wanted
  double* damping_before = nullptr;
  double* damping_after = nullptr;
};

/// Accounts the halves after t_n of viscous and stress work, from the stress the sweep has kept and the velocities as
/// they are after constraints. To be called once a step when kept_stress is given. O(elements of such laws).
using RateWorkFunction = void (*)(const SweepArgs&);

/// One step of all elements and nodes, the heart of the solver.
///
/// Own-node blocks: each element computes its elastic and viscous forces, its own side of its four intact joints
/// (f += k A0/3 (x_neighbour - x)), adds the forces others put on its nodes, and moves its nodes by central
/// differences. No scatter: the order of summation of a node is fixed by its own element. Shared-node blocks: forces
/// are scattered in ascending slots, then all shared nodes are moved. O(elements); 560 bytes an own-node element are
/// read or written. Allocates nothing, throws nothing. The same bits for every instruction set.
using SweepFunction = SweepStatus (*)(const SweepArgs&);

enum class Simd { sse2, avx2, avx512 };
[[nodiscard]] std::string_view name_of(Simd simd);

/// Widest instruction set of this machine that the kernel is built for; BRECCIA_SIMD=sse2|avx2|avx512 in the
/// environment selects a narrower one.
[[nodiscard]] Simd best_simd();
[[nodiscard]] bool simd_available(Simd simd);
/// @pre simd_available(simd)
[[nodiscard]] SweepFunction sweep_for(Simd simd);
[[nodiscard]] RateWorkFunction rate_work_for(Simd simd);

}  // namespace breccia
