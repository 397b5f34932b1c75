#pragma once

#include <array>
#include <vector>

#include "base/field.hpp"
#include "base/time_function.hpp"
#include "base/types.hpp"
#include "base/work_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_forces.hpp"
#include "discretisation/nodal_state.hpp"

namespace breccia {

/// Face of a slot on which something acts.
struct LoadedFace {
  Index slot;
  int face;  ///< 0..3, the face opposite to that corner
};

/// By slot and face.
[[nodiscard]] bool comes_before(const LoadedFace& a, const LoadedFace& b);
/// The three nodes of a face, counter-clockwise seen from outside.
[[nodiscard]] std::array<Index, 3> face_nodes(const LocalMesh& mesh, const LoadedFace& face);
/// Twice the outward area vector of a face, m2. @param place  nodal field, m
[[nodiscard]] Vec3 doubled_area(const Field<double>& place, const std::array<Index, 3>& nodes);

/// Load on faces, a third of each on every corner: pressure p, which follows its faces, f = -p(t) A / 3, A the present
/// outward area vector (positive pushes into the body); or traction t, which does not, f = t(t) |A0| / 3, A0 at rest.
///
/// In a step: `apply` before the sweep, `account_after` once velocities belong to t_(n+1/2) and constraints are
/// applied. O(faces) each, no allocation.
class SurfaceLoad {
 public:
  /// Faces are sorted by (slot, face) and named once: the order in which forces are summed. @param pressure  Pa
  SurfaceLoad(std::vector<LoadedFace> faces, TimeFunction pressure);
  /// @param traction  Pa, by axis
  SurfaceLoad(std::vector<LoadedFace> faces, std::array<TimeFunction, 3> traction);

  /// Adds the forces at t_n and accounts their work over the step that ended there.
  /// @param state      position at t_n, velocity at t_(n-1/2)
  /// @param time       t_n, s;  @param dt_before  t_n - t_(n-1), s
  void apply(const LocalMesh& mesh, const NodalState& state, double time, double dt_before, NodalForces& forces);

  /// Accounts the work of the same forces over the step that begins at t_n. @param state velocity at t_(n+1/2)
  void account_after(const LocalMesh& mesh, const NodalState& state, double dt_after);

  /// Work on the faces of this rank's originals, J; up to t_n between `apply` and `account_after`.
  [[nodiscard]] const ExactSum& work() const { return work_.sum(); }
  /// Sum of the forces at t_n, N.
  [[nodiscard]] Vec3 resultant() const;

 private:
  /// Calls account(power of the face's forces) for every face of an original.
  template <class Account>
  void for_each_power(const LocalMesh& mesh, const Field<double>& velocity, Account&& account) const;

  std::vector<LoadedFace> faces_;
  std::vector<Vec3> corner_force_;  ///< (faces) N, at t_n
  bool follows_;                    ///< a pressure
  TimeFunction pressure_;
  std::array<TimeFunction, 3> traction_;
  WorkSum work_;
};

/// Work of gravity on this rank's originals, J, to the same trapezoid rule as every other force. The sweep applies
/// gravity as an acceleration.
///
/// Gravity is uniform in space, so its work is a functional of the potential m g . (x - X): while g is constant it is
/// the difference of the potential since the last change of g, and is computed on request only. In the steps where g
/// changes, the work of the step is taken from the velocities. Cost of `advance`: three comparisons while g is
/// constant; O(elements) for every step of a ramp. Cost of `work`: O(elements).
struct GravityWork {
  ExactSum past;    ///< J, work up to the anchor, or up to the last `advance` while g changes
  ExactSum anchor;  ///< J, potential with `gravity` when it took its value
  Vec3 gravity{0, 0, 0};
  bool started = false;
  bool changing = false;  ///< g changed at the last `advance`

  /// To be called once a step, before the sweep.
  /// @param now    g(t_n), m/s2
  /// @param state  position at t_n, velocity at t_(n-1/2);  @param dt_before  t_n - t_(n-1), s
  void advance(const LocalMesh& mesh, const NodalState& state, const Vec3& now, double dt_before);

  /// Work up to t_n, J. @param position  nodal field at t_n, the one of the last `advance`
  [[nodiscard]] ExactSum work(const LocalMesh& mesh, const Field<double>& position) const;

  // When elements change hands, between the `advance` of t_(n-1) and that of t_n, at the positions of t_n:
  /// All work goes to `past`; `anchor` means nothing until `set_anchor`.
  void close(const LocalMesh& mesh, const Field<double>& position) { past = work(mesh, position); }
  void set_anchor(const LocalMesh& mesh, const Field<double>& position);
};

}  // namespace breccia
