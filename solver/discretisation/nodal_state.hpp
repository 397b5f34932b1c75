#pragma once

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/layout.hpp"

namespace breccia {

/// Nodal fields that every step changes. Velocities belong to the middle of the last step (central differences):
/// v(n-1/2) before the step's sweep, v(n+1/2) after it.
struct NodalState {
  Field<double> position;       ///< nodal field, m, at t_n
  Field<double> next_position;  ///< nodal field, m, at t_(n+1); swapped with `position` at the end of a step
  Field<double> velocity;       ///< nodal field, m/s
};

}  // namespace breccia
