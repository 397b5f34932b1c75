#include "simulation/step.hpp"

#include <utility>

#include "simulation/phases.hpp"

namespace breccia {

void step(Domain& domain, const StepOptions& options) {
  receive_signals(domain);
  const bool sample = options.sample || domain.state.signals.received.stop;  // the last step, for the summary
  const bool changes = changes_step(domain.state.clock);
  update_couples(domain);  // a new search if one is due; contact takes the faces that came apart a step ago
  apply_loads(domain);
  joint_forces(domain);    // active joints, by ascending ids
  contact_forces(domain);  // couples, by ascending ids
  send_signals(options.signals, domain);
  if (sample || changes) domain.scratch.velocity_before = domain.state.nodes.velocity;
  move_nodes(sample, domain);  // internal forces, intact joints, motion, constraints; proxies leave
  activate_crossed_joints(domain);
  if (changes) account_step_change(domain);
  if (sample) sample_energies(domain);
  return_elastic_joints(domain);
  account_late_work(domain);
  receive_proxies(domain);
  advance_clock(domain.state);
}

void advance_clock(State& state) {
  std::swap(state.nodes.position, state.nodes.next_position);
  Clock& clock = state.clock;
  clock.time += clock.dt;
  clock.dt_earlier = clock.dt_before;
  clock.dt_before = clock.dt;
  ++clock.steps;
}

}  // namespace breccia
