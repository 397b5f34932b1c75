#include "observe/energy_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/index.hpp"
#include "parallel/totals.hpp"
#include "physics/energy.hpp"

namespace breccia {
namespace {

/// Sum over what this rank counts. @param counted  as long as the values
ExactSum sum_of(const Field<double>& values, const std::vector<std::uint8_t>& counted) {
  ExactSum sum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (counted[i] != 0) sum.add(values[i]);
  }
  return sum;
}

/// The element of largest strain energy density on any rank; of equal ones the lowest. -1: none
GlobalId densest_element(const ElasticEnergy& elastic, const Domain& domain) {
  const Communicator& communicator = domain.exchange.communicator();
  const double largest = communicator.max(elastic.largest_density);
  const bool mine = elastic.worst_slot >= 0 && elastic.largest_density == largest;
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
  const std::int64_t lowest =
      communicator.max(mine ? -domain.model.local.element_of_slot[at(elastic.worst_slot)] : kNone);
  return lowest == kNone ? -1 : -lowest;
}

constexpr std::array kEnergies{&EnergyBudget::kinetic,          &EnergyBudget::elastic,
                               &EnergyBudget::joint_elastic,    &EnergyBudget::contact_stored,
                               &EnergyBudget::joint_mode_1,     &EnergyBudget::joint_mode_2,
                               &EnergyBudget::joint_friction,   &EnergyBudget::contact_dissipated,
                               &EnergyBudget::contact_friction, &EnergyBudget::plastic,
                               &EnergyBudget::viscous,          &EnergyBudget::damping};

/// What is there, not dissipated.
constexpr std::array kStoredEnergies{&EnergyBudget::kinetic, &EnergyBudget::elastic, &EnergyBudget::joint_elastic,
                                     &EnergyBudget::contact_stored};

/// s of kinetic_energy in physics/energy.hpp.
double step_change(const Clock& clock) {
  return clock.dt_before > 0 ? (clock.dt_before - clock.dt) / (clock.dt_before + clock.dt) : 0.0;
}

}  // namespace

EnergySample energy_sample(const Field<double>& velocity_before, const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  const State& state = domain.state;
  const double* x = state.nodes.position.data();
  const MaterialMemory memory = material_memory(state.elements);
  ElasticEnergy elastic = elastic_energy(local, domain.model.elastic, x, memory);
  elastic.total.add(sum_of(state.elements[kStressWork], local.original));
  JointEnergy joints = joint_energy(local, state.joints.active, state.work.joints);
  joints.stored.add(intact_joint_energy(local, domain.derived.links, x));
  joints.viscous.add(sum_of(state.elements[kViscousWork], local.original));
  ExactSum contact = state.work.contact.stored;
  contact.add(state.work.contact.friction_stored);
  const double change = step_change(state.clock);
  const std::array parts{kinetic_energy(local, velocity_before.data(), state.nodes.velocity.data(), change),
                         elastic.total,
                         joints.stored,
                         contact,
                         joints.mode_1,
                         joints.mode_2,
                         joints.friction,
                         state.work.contact.dissipated,
                         state.work.contact.friction_dissipated,
                         plastic_work(local, domain.model.elastic, memory),
                         joints.viscous,
                         sum_of(state.damping_work, local.counted),
                         external_work(domain)};
  static_assert(parts.size() == kEnergies.size() + 1);
  const std::vector<double> terms = totals(domain.exchange.communicator(), parts);
  EnergySample sample;
  for (std::size_t t = 0; t < kEnergies.size(); ++t) sample.budget.*kEnergies[t] = terms[t];
  sample.budget.external_work = terms.back();
  sample.budget.step_change = state.work.step_change;
  sample.worst_element = densest_element(elastic, domain);
  return sample;
}

double step_change_energy(const Field<double>& velocity_before, const Domain& domain) {
  const double change = step_change(domain.state.clock);
  if (change == 0) return 0.0;
  const double* after = domain.state.nodes.velocity.data();
  const std::array parts{step_change_energy(domain.model.local, velocity_before.data(), after, change)};
  return totals(domain.exchange.communicator(), parts)[0];
}

double excess_energy(const EnergyBudget& budget) {
  double total = 0;
  for (const auto term : kEnergies) total += budget.*term;
  return total - budget.external_work;
}

void set_residual(double first_excess, double floor, EnergyBudget& budget) {
  double total = 0, largest = std::abs(budget.external_work);
  for (const auto term : kEnergies) {
    total += budget.*term;
    largest = std::max(largest, std::abs(budget.*term));
  }
  budget.residual = first_excess + budget.external_work + budget.step_change - total;
  budget.residual_relative = std::abs(budget.residual) / std::max(largest, floor);
  double held = 0;
  for (const auto term : kStoredEnergies) held += budget.*term;
  budget.gain_relative = (held - first_excess - budget.external_work) / std::max(largest, floor);
  budget.is_round_off = largest < floor;
}

EnergyFault energy_fault(const EnergyBudget& budget, double residual_limit, double gain_limit) {
  const auto share = [](const char* words, double value, double limit) {
    char text[160];
    std::snprintf(text, sizeof text, "%s %.6g %% of the largest term (limit %.6g %%)", words, 100 * value, 100 * limit);
    return std::string(text);
  };
  // Of shares that are no numbers every comparison below is false, and the run would end as a sound one.
  if (!std::isfinite(budget.residual) || std::isnan(budget.residual_relative) || std::isnan(budget.gain_relative))
    return {"the energies are not finite", "time.residual_limit"};
  if (budget.is_round_off) return {};
  if (budget.gain_relative > gain_limit)
    return {share("the stored energy exceeds the energy put in by", budget.gain_relative, gain_limit),
            "time.energy_gain_limit"};
  if (budget.residual_relative > residual_limit)
    return {share("the energy residual is", budget.residual_relative, residual_limit), "time.residual_limit"};
  return {};
}

}  // namespace breccia
