#include "simulation/balance.hpp"

#include <algorithm>
#include <numeric>

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// An element that shares its nodes costs this much of one that owns them (no joints to look across).
constexpr double kSharedNodes = 1.0 / 3;
/// A look that finds a rank slower or faster than this at the same work has met a stall, and counts as this.
constexpr double kMostSlow = 2;

/// How many elements (in cost), active joints and couples a rank has to compute.
std::array<double, 3> amounts(const Stepper& stepper) {
  const LocalMesh& local = stepper.model().local;
  double elements = 0;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (local.is_original(s)) elements += s < local.num_own_slots ? 1.0 : kSharedNodes;
  }
  const double couples = stepper.contact() != nullptr ? static_cast<double>(stepper.contact()->contact().couples.size()) : 0.0;
  return {elements, static_cast<double>(stepper.active_joints().size()), couples};
}

}  // namespace

Balance::Work Balance::work(const Stepper& stepper) {
  const PhaseTimer& timer = stepper.timer();
  return {timer.seconds(Phase::sweep) + timer.seconds(Phase::loads), timer.seconds(Phase::joints),
          timer.seconds(Phase::contact) + timer.seconds(Phase::search)};
}

double Balance::look(const Stepper& stepper) {
  struct Share {
    Work seconds;
    std::array<double, 3> amount;
  };
  Share mine{work(stepper), amounts(stepper)};
  for (std::size_t k = 0; k < 3; ++k) mine.seconds[k] -= seen_[k];
  seen_ = work(stepper);
  Share all{};
  double slowest = 0, sum = 0;
  const auto shares = stepper.communicator().all_gather(std::span<const Share>(&mine, 1));
  for (const std::vector<Share>& share : shares) {
    for (std::size_t k = 0; k < 3; ++k) {
      all.seconds[k] += share[0].seconds[k];
      all.amount[k] += share[0].amount[k];
    }
    const double seconds = std::accumulate(share[0].seconds.begin(), share[0].seconds.end(), 0.0);
    slowest = std::max(slowest, seconds);
    sum += seconds;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (all.amount[k] > 0 && all.seconds[0] > 0) unit_[k] = all.seconds[k] / all.amount[k] * all.amount[0] / all.seconds[0];
  }
  double usual = 0;  // s, for this rank's work at the speed of all
  for (std::size_t k = 0; k < 3; ++k) {
    if (all.amount[k] > 0) usual += all.seconds[k] * mine.amount[k] / all.amount[k];
  }
  const double busy = std::accumulate(mine.seconds.begin(), mine.seconds.end(), 0.0);
  if (usual > 0) slowness_ = 0.5 * (slowness_ + std::clamp(busy / usual, 1 / kMostSlow, kMostSlow));
  const double mean = sum / static_cast<double>(shares.size());
  before_ = now_;
  now_ = {(slowest - mean) / static_cast<double>(kInterval), mean > 0 ? slowest / mean : 1.0};
  told_ = now_.imbalance;
  load_ = mean > 0 ? busy / mean : 1.0;
  return std::min(now_.lost, before_.lost);
}

std::vector<double> Balance::weights(const Stepper& stepper) const {
  const LocalMesh& local = stepper.model().local;
  std::vector<double> of_slot(at(local.num_slots), 0.0);
  for (Index s = 0; s < local.num_slots; ++s) of_slot[at(s)] = unit_[0] * (s < local.num_own_slots ? 1.0 : kSharedNodes);
  // A joint or couple is computed by the ranks of both its elements: half of it to each.
  for (const ActiveJoint& joint : stepper.active_joints()) {
    for (const Index slot : {joint.slot_a, joint.slot_b}) of_slot[at(slot)] += 0.5 * unit_[1];
  }
  if (stepper.contact() != nullptr) {
    const ContactState& contact = stepper.contact()->contact();
    for (const ContactCouple& couple : contact.couples) {
      of_slot[at(contact.points[at(couple.point)].slot)] += 0.5 * unit_[2];
      of_slot[at(contact.contactors[at(couple.contactor)])] += 0.5 * unit_[2];
    }
  }
  std::vector<double> weights;
  for (const Index slot : local.slot_of_element) {
    if (local.is_original(slot)) weights.push_back(slowness_ * of_slot[at(slot)]);
  }
  return weights;
}

}  // namespace breccia
