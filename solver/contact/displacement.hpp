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

/// Known motion in a step, m.
struct KnownMotion {
  double length = 0;      ///< largest motion of a node of any rank in the last step, or in an earlier one if received
                          ///< with delay
  double unforeseen = 0;  ///< allowance for motion beyond twice that in each of the steps not received yet
};

/// Compares relative_displacement() with an allowance; between evaluations, which are rare, it is bounded by the sum of
/// the largest speeds times the step.
///
/// On several ranks the largest speed is received some steps later; each step not received counts as twice the last
/// one. Larger motion is part of `ahead`; a run in which nodes move further still ends (domains/motion_limit.hpp).
class DisplacementWatch {
 public:
  /// @param late  delay of the lengths, in steps
  explicit DisplacementWatch(int late = 0) : late_(late) {}
  /// Positions are those of `then` from now on.
  void restart() { start_from(0); }
  /// After every step. @param length  m, at least the largest motion of any node in the step `late` steps before
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
  int before_ = 0;     ///< lengths not received yet of steps that the bound includes already
  double bound_ = 0;   ///< m
  double length_ = 0;  ///< m, received last
};

}  // namespace breccia
