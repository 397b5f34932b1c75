#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "domains/motion_limit.hpp"
#include "simulation/phases.hpp"

/// The phases of a step that exchange something with other ranks.
namespace breccia {
namespace {

/// Joints that any rank released in the last step, as faces of elements that are here.
void receive_releases(Domain& domain) {
  domain.scratch.freed.clear();
  if (!domain.state.signals.released) return;
  const auto timing = domain.timer.measure(Phase::communication);
  const Model& model = domain.model;
  const Communicator& communicator = domain.exchange.communicator();
  std::vector<GlobalId>& mine = domain.state.signals.released_here;
  communicator.set_phase("joints that were released");
  for (const std::vector<GlobalId>& of_rank : communicator.all_gather(std::span<const GlobalId>(mine))) {
    for (const GlobalId id : of_rank) {
      const Index a = model.mesh.element_with(id / 4);
      if (a >= 0) domain.scratch.freed.push_back({model.local.slot_of_element[at(a)], static_cast<int>(id % 4)});
    }
  }
  mine.clear();
}

/// Proxies come to where they are now, as far as a search or a verification needs them.
/// @return  (slots) 1: near enough to be searched; empty: all
std::vector<std::uint8_t> receive_moved(bool search, Domain& domain) {
  if (domain.exchange.alone() || !(search || domain.exchange.gathers_all())) return {};
  const auto timing = domain.timer.measure(Phase::communication);
  NodalState& nodes = domain.state.nodes;
  domain.exchange.gather_all(nodes.position, nodes.velocity);
  if (!search) return {};
  return domain.exchange.receive_positions(domain.model.local, domain.derived.relevant,
                                           domain.contact->extent(nodes.position),
                                           domain.contact->search_reach(domain.state.signals.motion), nodes.position);
}

/// How far nodes of couples have moved in the last step at most, m: those that this rank moves, and those it received.
/// Delayed data of other ranks are not needed for it.
double motion_here(const Domain& domain) {
  const double received = domain.exchange.fastest_received(domain.state.nodes.velocity);
  return std::max(domain.state.signals.max_speed, received) * domain.state.clock.dt_before;
}

/// Histories of points that came into couples here, and what is gathered from now on.
void follow_couples(bool search, bool meets_others, Domain& domain) {
  if (domain.exchange.alone() || !(search || domain.state.signals.released)) return;
  const auto timing = domain.timer.measure(Phase::communication);
  if (!search && domain.exchange.communicator().max(static_cast<std::int64_t>(meets_others)) == 0) return;
  domain.contact->adopt(domain.exchange.receive_touching(*domain.contact));
  domain.plan_exchange();
  domain.exchange.begin_gather(domain.state.nodes.position, domain.state.nodes.velocity);
  domain.exchange.finish_gather();
}

}  // namespace

void receive_signals(Domain& domain) {
  const auto timing = domain.timer.measure(Phase::communication);
  domain.exchange.finish_reduction(domain.state.clock, domain.state.signals);
  record_received_motion(domain);
  check_motion(domain);
}

void send_signals(const StepSignals& signals, Domain& domain) {
  domain.state.signals.sent = signals;
  domain.exchange.begin_reduction(domain.state.clock, domain.state.signals);
}

/// All waits of ranks for each other are here, at the beginning of a step, one after the other: a delay of one of them
/// in the rest of the step is waited for once.
void update_couples(Domain& domain) {
  receive_releases(domain);
  if (!domain.contact) return;
  State& state = domain.state;
  ContactSearch& contact = *domain.contact;
  domain.exchange.communicator().set_phase("contact search");
  bool due = false, meets_others = false;
  {
    const auto timing = domain.timer.measure(Phase::search);
    contact.count_travel(motion_here(domain));
    due =
        contact.due(state.nodes, {state.signals.motion, unforeseen_motion(domain, 1)}, domain.exchange.communicator());
  }
  const std::vector<std::uint8_t> current = receive_moved(due, domain);
  {
    const auto timing = domain.timer.measure(Phase::search);
    // In this order, so that what fracture makes touch is known as such also when nothing has been searched yet.
    if (due) contact.search(state.nodes, state.signals.motion, current);
    if (due) ++state.counters.searches;
    if (!domain.scratch.freed.empty()) meets_others = contact.release_faces(domain.scratch.freed);
  }
  follow_couples(due, meets_others, domain);
  contact.verify(state.nodes);
}

void receive_proxies(Domain& domain) {
  if (domain.exchange.alone()) return;
  const auto timing = domain.timer.measure(Phase::communication);
  domain.exchange.communicator().set_phase("gather of proxies");
  domain.exchange.finish_gather();
}

}  // namespace breccia
