#pragma once

#include <array>
#include <vector>

#include "base/compensated_sum.hpp"
#include "base/field.hpp"
#include "base/time_function.hpp"
#include "base/types.hpp"
#include "state/local_mesh.hpp"
#include "state/nodal_forces.hpp"
#include "state/state.hpp"

namespace breccia {

/// Face of a slot on which something acts.
struct LoadedFace {
  Index slot;
  int face;  ///< 0..3, the face opposite to that corner
};

/// Pressure that follows its faces: each corner of a face gets f = -p(t) A / 3, A the current outward area vector;
/// positive pressure pushes into the body.
///
/// In a step: `apply` before the sweep, `book_after` once velocities belong to t_(n+1/2) and constraints have had their
/// say. O(faces) each, no allocation.
class PressureLoad {
 public:
  /// Faces are sorted by (slot, face) and named once: the order in which forces are summed.
  PressureLoad(std::vector<LoadedFace> faces, TimeFunction pressure);

  /// Adds the forces at t_n and books their work over the step that ended there.
  /// @param state      position at t_n, velocity at t_(n-1/2)
  /// @param time       t_n, s;  @param dt_before  t_n - t_(n-1), s
  void apply(const LocalMesh& mesh, const State& state, double time, double dt_before, NodalForces& forces);

  /// Books the work of the same forces over the step that begins at t_n. @param state velocity at t_(n+1/2)
  void book_after(const LocalMesh& mesh, const State& state, double dt_after);

  /// Work on the body, J; up to t_n between `apply` and `book_after`.
  [[nodiscard]] double work() const { return work_.value(); }
  /// Sum of the forces at t_n, N.
  [[nodiscard]] Vec3 resultant() const;

 private:
  [[nodiscard]] double power(const LocalMesh& mesh, const Field<double>& velocity) const;

  std::vector<LoadedFace> faces_;
  std::vector<Vec3> corner_force_;  ///< (faces) N, at t_n
  TimeFunction pressure_;
  WorkSum work_;
};

/// Work of gravity, J, to the same trapezoid rule as every other force. The sweep applies gravity as an acceleration.
///
/// Gravity is uniform in space, so its work is a functional of the first moment S = sum m (x - X): as long as g does
/// not change it is g . (S_n - S_start), and nothing is computed until someone asks. In a step where g changes, S and
/// the momentum are needed. Cost of `advance`: three comparisons while g is constant; O(nodes), 32 bytes a node, for
/// every step of a ramp (80 bytes in its first). Cost of `work`: O(nodes), 56 bytes a node.
class GravityWork {
 public:
  /// @param position  nodal field at the time of the first `advance`
  GravityWork(const LocalMesh& mesh, const Field<double>& position);

  /// To be called once a step, before the sweep.
  /// @param gravity    g(t_n), m/s2
  /// @param state      position at t_n, velocity at t_(n-1/2);  @param dt_before  t_n - t_(n-1), s
  void advance(const LocalMesh& mesh, const State& state, const Vec3& gravity, double dt_before);

  /// Work up to t_n, J. @param position  nodal field at t_n, the one of the last `advance`
  [[nodiscard]] double work(const LocalMesh& mesh, const Field<double>& position) const;

 private:
  [[nodiscard]] Vec3 moment(const LocalMesh& mesh, const Field<double>& position) const;

  Field<double> mass_;     ///< (num_nodes) kg, 0 for padding
  Vec3 gravity_{0, 0, 0};  ///< since the anchor
  Vec3 anchor_;            ///< kg m: S when gravity_ took its value
  bool anchored_last_step_ = false;
  bool started_ = false;
  CompensatedSum past_;  ///< work up to the anchor
};

/// Sum over all nodes of mass times the difference of two nodal fields, in a fixed order: partial sums of the eight
/// lanes over runs of blocks, then compensated. O(nodes).
/// @param mass  (num_nodes);  @param minus  nodal field, or nullptr for zero
[[nodiscard]] Vec3 weighted_sum(const Field<double>& mass, const double* plus, const double* minus);

}  // namespace breccia
