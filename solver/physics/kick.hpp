#pragma once

namespace breccia {

/// Time from v_(n-1/2) to v_(n+1/2), s: the mean of the steps before and after t_n (central differences of variable
/// step). With the next step alone, every change of it would add or remove energy. The first step is from rest.
/// @param before  t_n - t_(n-1), 0 at the start;  @param dt  t_(n+1) - t_n, s
/// @pre both steps are stable for the node with its present constraints and loads: the last one of a stage also by the
/// next stage
[[nodiscard]] constexpr double kick_length(double before, double dt) { return before > 0 ? 0.5 * (before + dt) : dt; }

/// Damping as the sweep applies it (physics/sweep.hpp) to a component of a node that moves from v(n-1/2) to v(n+1/2).
struct AppliedDamping {
  double mass = 0;   ///< alpha, 1/s
  double local = 0;  ///< beta
  double kick = 0;   ///< s

  /// Local damping force that led to v(n+1/2), N. @param before, after  m/s;  @param node_mass  kg
  [[nodiscard]] constexpr double local_force(double before, double after, double node_mass) const {
    const double half = 0.5 * mass * kick;
    const double net = node_mass * ((1.0 + half) * after - (1.0 - half) * before) / kick;  // unbalanced and local
    const double opposed = before == 0.0 ? 0.0 : (net > 0) == (before > 0) ? -local : local;
    return net - net / (1.0 + opposed);
  }
};

}  // namespace breccia
