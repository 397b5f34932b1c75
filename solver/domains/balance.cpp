#include "domains/balance.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "base/index.hpp"

namespace breccia {
namespace {

/// An element that shares its nodes costs this much of one that owns them (no joints to evaluate).
constexpr double kSharedNodes = 1.0 / 3;
/// Weight of the last evaluation in a rank's slowness: other processes on the machine come and go.
constexpr double kNewest = 0.25;
/// Limit of the measured slowness: larger values are due to a stall.
constexpr double kMostSlow = 2;

/// How many elements (in cost), active joints and couples a rank has to compute.
std::array<double, 3> amounts(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  double elements = 0;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (local.is_original(s)) elements += s < local.num_own_slots ? 1.0 : kSharedNodes;
  }
  const double couples = domain.contact ? static_cast<double>(domain.state.contact.couples.size()) : 0.0;
  return {elements, static_cast<double>(domain.state.joints.active.size()), couples};
}

double largest_of(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Balance::Work Balance::work(const Domain& domain) {
  const PhaseTimer& timer = domain.timer;
  return {timer.seconds(Phase::sweep) + timer.seconds(Phase::loads), timer.seconds(Phase::joints),
          timer.seconds(Phase::contact) + timer.seconds(Phase::search)};
}

double Balance::look(const Domain& domain) {
  struct RankLoad {
    Work seconds;
    std::array<double, 3> amount;
  };
  RankLoad mine{work(domain), amounts(domain)};
  for (std::size_t k = 0; k < 3; ++k) mine.seconds[k] -= seen_[k];
  seen_ = work(domain);
  RankLoad all{};
  const auto shares = domain.exchange.communicator().all_gather(std::span<const RankLoad>(&mine, 1));
  std::vector<double> busy;  // s, of each rank since the last evaluation
  for (const std::vector<RankLoad>& share : shares) {
    for (std::size_t k = 0; k < 3; ++k) {
      all.seconds[k] += share[0].seconds[k];
      all.amount[k] += share[0].amount[k];
    }
    busy.push_back(std::accumulate(share[0].seconds.begin(), share[0].seconds.end(), 0.0));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (all.amount[k] > 0 && all.seconds[0] > 0)
      unit_[k] = all.seconds[k] / all.amount[k] * all.amount[0] / all.seconds[0];
  }
  double usual = 0;  // s, for this rank's work at the speed of all
  for (std::size_t k = 0; k < 3; ++k) {
    if (all.amount[k] > 0) usual += all.seconds[k] * mine.amount[k] / all.amount[k];
  }
  const double here = busy[static_cast<std::size_t>(domain.exchange.communicator().rank())];
  if (usual > 0) slowness_ += kNewest * (std::clamp(here / usual, 1 / kMostSlow, kMostSlow) - slowness_);
  const double mean = mean_of(busy);
  told_ = mean > 0 ? largest_of(busy) / mean : 1.0;
  load_ = mean > 0 ? here / mean : 1.0;
  busy_.resize(busy.size());
  std::transform(busy.begin(), busy.end(), busy_.begin(), busy_.begin(), std::plus<>());
  return largest_of(busy_) - mean_of(busy_);
}

std::vector<double> Balance::weights(const Domain& domain) const {
  const LocalMesh& local = domain.model.local;
  std::vector<double> of_slot(at(local.num_slots), 0.0);
  for (Index s = 0; s < local.num_slots; ++s)
    of_slot[at(s)] = unit_[0] * (s < local.num_own_slots ? 1.0 : kSharedNodes);
  // A joint or couple is computed by the ranks of both its elements: half of it to each.
  for (const ActiveJoint& joint : domain.state.joints.active) {
    for (const Index slot : {joint.slot_a, joint.slot_b}) of_slot[at(slot)] += 0.5 * unit_[1];
  }
  if (domain.contact) {
    const ContactState& contact = domain.state.contact;
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

std::vector<double> Balance::weights_at_rest(const Records& records,
                                             const std::vector<Discretisation>& discretisation) {
  std::vector<double> weights;
  for (const ElementRecord& element : records.elements)
    weights.push_back(discretisation[at(element.group)] == Discretisation::own_nodes ? 1.0 : kSharedNodes);
  return weights;
}

}  // namespace breccia
