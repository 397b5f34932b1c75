#pragma once

#include "base/field.hpp"
#include "discretisation/local_mesh.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// How far the nodes of the whole model have moved relative to each other, m: a bound of max_n |u_n - d| for one
/// translation d, the same for all nodes, where u = now - then. What may touch does not change when everything moves by
/// d.
///
/// The smaller of max_n |u_n| (d = 0) and half the diagonal of the box around all u_n (d = its centre): a body that
/// flies as a whole has moved by nothing, two that meet by half the way between them. Exact, so independent of the
/// number of ranks.
/// @param now, then  nodal fields, m. O(nodes) and one reduction. Collective.
[[nodiscard]] double relative_displacement(const LocalMesh& local, const Field<double>& now, const Field<double>& then,
                                           const Communicator& communicator);

/// What is known of the motion in a step, m.
struct KnownMotion {
  double length = 0;      ///< the furthest that a node of any rank has moved in a step: the last, or one told late
  double unforeseen = 0;  ///< what nodes may have moved, in the steps not told yet, beyond twice as far in each
};

/// Watches relative_displacement() against an allowance, and rarely has to look: in between it is bounded by the sum of
/// the largest speeds times the step.
///
/// On several ranks the largest speed becomes known some steps late; each step not known yet counts as twice the last
/// known. What nodes may move beyond that belongs to `ahead`; a run in which they move further still ends
/// (domains/motion_limit.hpp).
class DisplacementWatch {
 public:
  /// @param late  steps by which lengths are told late
  explicit DisplacementWatch(int late = 0) : late_(late) {}
  /// Positions are those of `then` from now on.
  void restart() { start_from(0); }
  /// After every step. @param length  m, at least as far as any node has moved in the step `late` before it
  void step(double length) {
    length_ = length;
    if (before_ > 0) {
      --before_;
    } else {
      bound_ += length;
    }
  }
  /// Whether it is time to act: the nodes have really used up most of the allowance, or soon will. Collective.
  /// @param allowed  m;  @param ahead  m, that nodes may move before the next call
  [[nodiscard]] bool used_up(double allowed, double ahead, const LocalMesh& local, const Field<double>& now,
                             const Field<double>& then, const Communicator& communicator);

 private:
  void start_from(double bound) {
    bound_ = bound;
    before_ = late_;
  }

  int late_;
  int before_ = 0;     ///< lengths still to be told of steps that the bound holds already
  double bound_ = 0;   ///< m
  double length_ = 0;  ///< m, told last
};

}  // namespace breccia
