#include <array>
#include <cmath>
#include <limits>

#include "simulation/reduction.hpp"
#include "simulation/stepper.hpp"

/// The part of Stepper that takes stock.
namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sum over what this rank counts. @param counted  as long as the values
ExactSum sum_of(const Field<double>& values, const std::vector<std::uint8_t>& counted) {
  ExactSum sum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (counted[i] != 0) sum.add(values[i]);
  }
  return sum;
}

}  // namespace

ExactSum Stepper::external_work() const {
  ExactSum sum = past_external_;
  sum.add(constraints_.work());
  sum.add(gravity_work_.work(model_.local, state_.position));
  for (const PressureLoad& p : pressures_) sum.add(p.work());
  return sum;
}

void Stepper::take_budget(const Field<double>& velocity_before) {
  const auto lap = timer_.measure(Phase::energy);
  const LocalMesh& local = model_.local;
  ElasticEnergy elastic = elastic_energy(local, model_.elastic, state_.position.data());
  elastic.total.add(sum_of(stress_work_, local.original));
  JointEnergy joints = joint_energy(local, active_, joint_work_);
  joints.stored.add(intact_joint_energy(local, links_, state_.position.data()));
  ExactSum contact = contact_work_.stored;
  contact.add(contact_work_.friction_stored);
  const std::vector<double> terms = totals(
      communicator_, std::array{kinetic_energy(local, velocity_before.data(), state_.velocity.data()), elastic.total,
                                joints.stored, contact, joints.mode_1, joints.mode_2, joints.friction,
                                contact_work_.dissipated, contact_work_.friction_dissipated,
                                sum_of(viscous_, local.original), sum_of(damping_, local.counted), external_work()});
  budget_ = {terms[0], terms[1], terms[2], terms[3], terms[4],  terms[5],
             terms[6], terms[7], terms[8], terms[9], terms[10], terms[11]};
  find_worst(elastic);

  double total = 0, largest = std::abs(budget_.external_work);
  for (std::size_t t = 0; t + 1 < terms.size(); ++t) {
    total += terms[t];
    largest = std::max(largest, std::abs(terms[t]));
  }
  if (!first_total_) first_total_ = total - budget_.external_work;
  budget_.residual = *first_total_ + budget_.external_work - total;
  budget_.residual_relative = std::abs(budget_.residual) / std::max(largest, model_.whole.energy_floor);
}

/// The element of largest strain energy density on any rank; of equal ones the lowest.
void Stepper::find_worst(const ElasticEnergy& elastic) {
  const double largest = communicator_.max(elastic.largest_density);
  const bool mine = elastic.worst_slot >= 0 && elastic.largest_density == largest;
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
  const std::int64_t lowest = communicator_.max(mine ? -model_.local.element_of_slot[at(elastic.worst_slot)] : kNone);
  worst_element_ = lowest == kNone ? -1 : -lowest;
}

}  // namespace breccia
