#pragma once

#include <array>
#include <vector>

#include "base/time_function.hpp"
#include "base/types.hpp"
#include "base/work_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "discretisation/nodal_state.hpp"

namespace breccia {

/// A node's share of a force on many.
struct NodeShare {
  Index node;
  double share;  ///< -, of all nodes of the whole model: 1
};

/// A force F(t) in a direction that stays, shared among nodes: f_i = share_i F(t). In a step as SurfaceLoad: `apply`
/// before the sweep, `account_after` once velocities belong to t_(n+1/2). O(nodes) each, no allocation.
class NodalLoad {
 public:
  /// @param nodes  of this rank, ascending, each once;  @param force  N, by axis
  NodalLoad(std::vector<NodeShare> nodes, std::array<TimeFunction, 3> force);

  /// Adds the forces at t_n and accounts their work over the step that ended there.
  /// @param state  velocity at t_(n-1/2);  @param time  t_n, s;  @param dt_before  t_n - t_(n-1), s
  void apply(const LocalMesh& mesh, const NodalState& state, double time, double dt_before, NodalForces& forces);

  /// Accounts the work of the same forces over the step that begins at t_n. @param state  velocity at t_(n+1/2)
  void account_after(const LocalMesh& mesh, const NodalState& state, double dt_after);

  /// Work on the nodes that this rank counts, J; up to t_n between `apply` and `account_after`.
  [[nodiscard]] const ExactSum& work() const { return work_.sum(); }

 private:
  /// Calls account(power of the node's force) for every node that this rank counts.
  template <class Account>
  void for_each_power(const LocalMesh& mesh, const Field<double>& velocity, Account&& account) const;

  std::vector<NodeShare> nodes_;
  std::array<TimeFunction, 3> force_;
  Vec3 now_{0, 0, 0};  ///< N, F(t_n)
  WorkSum work_;
};

}  // namespace breccia
