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

namespace breccia {

enum class PrescribedMotion {
  velocity,     ///< m/s; a fixed node has velocity zero
  displacement  ///< m, from where the node was when the constraints were made
};

/// Nodes that move as told, by axis.
struct NodalConstraint {
  std::vector<Index> nodes;
  std::array<bool, 3> axes{false, false, false};
  PrescribedMotion kind = PrescribedMotion::velocity;
  std::array<TimeFunction, 3> value;  ///< of time since the start of the run
};

/// The constraints of a stage. Where entries overlap, the later one rules that axis of the node; a node named twice
/// counts once.
///
/// In a step: `apply` right after the sweep, `book_after` when the works up to t_n have been read. O(constrained
/// nodes), no allocation, throws nothing.
class Constraints {
 public:
  Constraints() = default;
  /// @param state  position at the stage's start, where displacements count from; velocity of the step before it
  Constraints(const std::vector<NodalConstraint>& entries, const LocalMesh& mesh, const NodalState& state);

  /// Overwrites v(n+1/2): by the velocity asked for at t_(n+1/2), or by (u(t_(n+1)) - (x_n - x_start)) / dt, with which
  /// positions hold to round-off; and next_position by x_n + dt v. Keeps the reactions m (v - v_free) / dt and books
  /// their work over the step that ended at t_n.
  /// @param state      position at t_n, velocity and next_position as the sweep left them
  /// @param time       t_n;  @param dt_before  t_n - t_(n-1), 0 at the start;  @param dt  t_(n+1) - t_n, s
  void apply(const LocalMesh& mesh, NodalState& state, double time, double dt_before, double dt);

  /// Books the work of the same reactions over the step that begins at t_n.
  void book_after(double dt);

  /// Work of the reactions on the nodes that this rank counts, J; up to t_n between `apply` and `book_after`.
  [[nodiscard]] const ExactSum& work() const { return work_.sum(); }
  /// Force of an entry on the nodes and axes it rules and this rank counts, by axis, N, at t_n. O(nodes).
  [[nodiscard]] std::array<ExactSum, 3> reaction(std::size_t entry) const;
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
  /// Takes over what was remembered elsewhere; anchors that hold nothing here are passed over. O(n log n).
  void restore(std::span<const Anchor> anchors);

  [[nodiscard]] std::size_t num_entries() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }

 private:
  /// One axis of one node.
  struct Hold {
    Index node;
    int axis;
    double start;     ///< m
    double velocity;  ///< m/s, of the last step, on this axis
    double reaction;  ///< N
    bool counted;     ///< by this rank
  };
  struct Entry {
    PrescribedMotion kind;
    std::array<TimeFunction, 3> value;
    std::vector<Hold> holds;  ///< ascending nodes
  };
  std::vector<Entry> entries_;
  WorkSum work_;
};

}  // namespace breccia
