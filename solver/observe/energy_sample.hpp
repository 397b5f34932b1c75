#pragma once

#include "domains/domain.hpp"

namespace breccia {

/// Energies of the whole model at t_n, in the middle of a step: after the motion, before work after t_n is accounted.
/// The residual is not set. @param velocity_before  nodal field, v_(n-1/2). Collective, O(elements).
[[nodiscard]] EnergySample energy_sample(const Field<double>& velocity_before, const Domain& domain);

/// Energy and dissipated energy beyond the external work, J: what the first sample leaves to the later ones.
[[nodiscard]] double excess_energy(const EnergyBudget& budget);

/// @param first_excess  J, of the first sample
/// @param floor         J, terms below are round-off: the relative residual is never against less
void set_residual(double first_excess, double floor, EnergyBudget& budget);

}  // namespace breccia
