#pragma once

namespace breccia {

/// The budget at one instant, J.
struct EnergyBudget {
  double kinetic = 0, elastic = 0, joint_elastic = 0, contact_stored = 0;
  double joint_mode_1 = 0, joint_mode_2 = 0, joint_friction = 0;
  double contact_dissipated = 0, contact_friction = 0;
  double plastic = 0, viscous = 0, damping = 0;
  double external_work = 0;  ///< of loads, gravity and constraints
  double step_change = 0;    ///< what changes of the step moved the kinetic energy by (physics/energy.hpp)
  double residual = 0;       ///< energy at the start + external work + step changes - all above those: unaccounted
  double residual_relative = 0;
  double gain_relative = 0;  ///< what is kinetic and stored beyond what was put in; < 0: dissipated or lost
  bool is_round_off = true;  ///< no term is large enough to measure the others by
};

}  // namespace breccia
