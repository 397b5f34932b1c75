#pragma once

#include <string>

#include "domains/domain.hpp"

namespace breccia {

/// Energies of the whole model at t_n, in the middle of a step: after the motion, before work after t_n is accounted.
/// The residual is not set. @param velocity_before  nodal field, v_(n-1/2). Collective, O(elements).
[[nodiscard]] EnergySample energy_sample(const Field<double>& velocity_before, const Domain& domain);

/// What the change of the step at t_n has moved the kinetic energy of the whole model by, J; when energy_sample is
/// called. Collective, O(elements).
[[nodiscard]] double step_change_energy(const Field<double>& velocity_before, const Domain& domain);

/// Energy and dissipated energy beyond the external work, J: what the first sample leaves to the later ones.
[[nodiscard]] double excess_energy(const EnergyBudget& budget);

/// The residual and the energy gained, both also as shares of the largest term. What changes of the step moved is
/// accounted in the residual, but never counts as put in: a step in rhythm with a vibration drives it.
/// @param first_excess  J, of the first sample
/// @param floor         J, terms below are round-off: shares are never of less
void set_residual(double first_excess, double floor, EnergyBudget& budget);

/// Reason to end a run, and the key of the exceeded limit; both empty: none.
struct EnergyFault {
  std::string what, key;
};

/// Checks a budget by its gain and its residual. While no term exceeds round-off, only non-finite numbers are faults,
/// since the residual has no reference.
[[nodiscard]] EnergyFault energy_fault(const EnergyBudget& budget, double residual_limit, double gain_limit);

}  // namespace breccia
