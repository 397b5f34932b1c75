#pragma once

#include "base/field.hpp"
#include "parallel/communicator.hpp"
#include "state/local_mesh.hpp"

namespace breccia {

/// How far the nodes of the whole model have moved relative to each other, m: a bound of max_n |u_n - d| for one translation d,
/// the same for all nodes, where u = now - then. What may touch does not change when everything moves by d.
///
/// The smaller of max_n |u_n| (d = 0) and half the diagonal of the box around all u_n (d = its centre): a body that flies as a
/// whole has moved by nothing, two that meet by half the way between them. Exact, so independent of the number of ranks.
/// @param now, then  nodal fields, m. O(nodes) and one reduction. Collective.
[[nodiscard]] double relative_displacement(const LocalMesh& local, const Field<double>& now, const Field<double>& then,
                                           const Communicator& communicator);

/// Watches relative_displacement() against an allowance, and rarely has to look: in between it is bounded by the sum of the
/// largest speeds times the step.
class DisplacementWatch {
 public:
  /// Positions are those of `then` from now on.
  void restart() { bound_ = 0; }
  /// @param length  m, at least as far as any node has moved in the step
  void step(double length) { bound_ += length; }
  /// Whether it is time to act: the nodes have really used up most of the allowance, or soon will. Collective.
  /// @param allowed  m;  @param ahead  m, that nodes may move before the next call
  [[nodiscard]] bool used_up(double allowed, double ahead, const LocalMesh& local, const Field<double>& now,
                             const Field<double>& then, const Communicator& communicator);

 private:
  double bound_ = 0;  ///< m
};

}  // namespace breccia
