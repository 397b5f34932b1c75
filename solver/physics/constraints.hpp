#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/field.hpp"
#include "base/time_function.hpp"
#include "base/types.hpp"
#include "base/work_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_state.hpp"
#include "physics/kick.hpp"

namespace breccia {

enum class PrescribedMotion {
  velocity,     ///< m/s; a fixed node has velocity zero
  displacement  ///< m, from where the node was when the constraints were made
};

/// Nodes with imposed motion, by axis.
struct NodalConstraint {
  std::vector<Index> nodes;
  std::array<bool, 3> axes{false, false, false};
  PrescribedMotion kind = PrescribedMotion::velocity;
  std::array<TimeFunction, 3> value;  ///< of time since the start of the run
};

/// A force on a node, N.
struct NodeForce {
  Index node;
  Vec3 force;
};

/// The constraints of a stage. Where entries overlap, the later one rules that axis of the node; a node named twice
/// counts once.
///
/// In a step: `apply` right after the sweep, `account_after` when the works up to t_n have been read. O(constrained
/// nodes), no allocation, throws nothing. An axis fixed at rest does no work: for its nodes `apply` only stores the
/// velocity that the sweep gave them, from which the reaction is computed on request.
class Constraints {
 public:
  Constraints() = default;
  /// @param state  position at the stage's start, where displacements count from; velocity of the step before it
  /// @param mass_damping  alpha of the force -alpha m v that the sweep has applied, 1/s
  /// @param local_damping  beta of the other force that it has applied; it does not act on constrained axes
  /// @pre mesh outlives this object
  Constraints(const std::vector<NodalConstraint>& entries, const LocalMesh& mesh, const NodalState& state,
              double mass_damping = 0, double local_damping = 0);

  /// Overwrites v(n+1/2): by the imposed velocity at t_(n+1/2), or by (u(t_(n+1)) - (x_n - x_start)) / dt, with which
  /// positions hold to round-off; and next_position by x_n + dt v. Keeps the reactions
  ///   R = m (1 + alpha k/2) (v - v_free) / k,  k = kick_length(dt_before, dt),
  /// which with the damping force -alpha m (v(n-1/2) + v(n+1/2)) / 2 give the node this velocity, and accounts their
  /// work over the step that ended at t_n. v_free is the velocity that the sweep would have left without local damping,
  /// which is that of free motion: the reaction of a platen includes the contact force on it.
  /// @param state      position at t_n, velocity and next_position as the sweep left them
  /// @param time       t_n;  @param dt_before  t_n - t_(n-1), 0 at the start;  @param dt  t_(n+1) - t_n, s
  void apply(NodalState& state, double time, double dt_before, double dt);

  /// Accounts the work of the same reactions over the step that begins at t_n.
  void account_after(double dt);

  /// Work of the reactions on the nodes that this rank counts, J; up to t_n between `apply` and `account_after`.
  [[nodiscard]] const ExactSum& work() const { return work_.sum(); }
  /// Force of an entry on the nodes and axes it rules and this rank counts, by axis, N, at t_n. O(nodes).
  [[nodiscard]] std::array<ExactSum, 3> reaction(std::size_t entry) const;
  /// The same of all entries on some nodes. @param nodes  ascending. O(constrained nodes log nodes)
  [[nodiscard]] std::array<ExactSum, 3> reaction_on(std::span<const Index> nodes) const;
  /// Of all entries on each node that this rank moves, ascending nodes; those without a force are left out.
  [[nodiscard]] std::vector<NodeForce> reactions() const;
  /// What an entry remembers of one axis of a node.
  struct Anchor {
    std::size_t entry;
    Index node;
    int axis;
    double start;     ///< m, where displacements count from
    double velocity;  ///< m/s, of the last step
  };
  /// By entry, node and axis.
  [[nodiscard]] std::vector<Anchor> anchors() const;
  /// Restores anchors recorded elsewhere; those of nodes that are not constrained here are ignored. O(n log n).
  void restore(std::span<const Anchor> anchors);

  /// All nodes with a constrained axis, ascending.
  [[nodiscard]] const std::vector<Index>& nodes() const { return nodes_; }
  /// (nodes) which axes.
  [[nodiscard]] const std::vector<std::array<bool, 3>>& held_axes() const { return held_axes_; }
  [[nodiscard]] std::size_t num_entries() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }

 private:
  /// The nodes that an entry rules on one axis.
  struct Hold {
    int axis;
    bool still;                    ///< fixed at rest at all times
    bool rests = false;            ///< all velocities are zero: the axis is still, and has been in the last step
    std::vector<Index> nodes;      ///< ascending
    std::vector<double> start;     ///< (nodes) m
    std::vector<double> velocity;  ///< (nodes) m/s, of the last step, on this axis
    std::vector<double> free;      ///< (nodes) m/s, as the sweep left it in the last step, but for local damping
  };
  struct Entry {
    PrescribedMotion kind;
    std::array<TimeFunction, 3> value;
    std::vector<Hold> holds;  ///< ascending axes
  };
  void apply_still(Hold& hold, NodalState& state) const;
  void apply_moving(const Entry& entry, Hold& hold, NodalState& state, double time, double dt_before, double dt);
  /// m/s. @param before, after  velocities of the sweep's step
  [[nodiscard]] double change_by_local_damping(Index node, double before, double after) const;
  [[nodiscard]] bool counts(Index node) const;
  [[nodiscard]] double reaction_of(const Hold& hold, std::size_t k) const;

  const LocalMesh* mesh_ = nullptr;
  std::vector<Entry> entries_;
  std::vector<Index> nodes_;
  std::vector<std::array<bool, 3>> held_axes_;
  AppliedDamping damping_;  ///< its kick is that of the last step
  WorkSum work_;
};

/// True where the entry leaves every node at rest on the axes that it names, at all times.
[[nodiscard]] bool holds_still(const NodalConstraint& entry);

}  // namespace breccia
