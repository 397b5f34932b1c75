#include "simulation/step.hpp"

#include <utility>

#include "simulation/phases.hpp"

namespace breccia {

void step(Domain& domain, const StepOptions& options) {
  const Model& model = domain.model;
  State& state = domain.state;
  StepScratch& scratch = domain.scratch;
  const auto timed = [&](Phase phase, const auto& f) {
    const auto timing = domain.timer.measure(phase);
    f();
  };
  receive_signals(domain);
  const bool sample = options.sample || state.signals.received.stop;  // the last step, for the summary
  const bool changes = changes_step(state.clock);
  update_couples(domain);  // a new search if one is due; contact takes the faces that came apart a step ago
  timed(Phase::loads, [&] { apply_loads(model.local, state, scratch); });
  timed(Phase::joints, [&] { joint_forces(model, domain.simd, state, scratch.forces); });  // by ascending ids
  if (domain.contact) {
    timed(Phase::contact, [&] {  // couples, by ascending ids
      contact_forces(model.contact, model.local, state.nodes, state.clock.dt_before, state.contact, scratch.forces,
                     state.work.contact, domain.simd);
    });
  }
  send_signals(options.signals, domain);
  if (sample || changes) scratch.velocity_before = state.nodes.velocity;
  move_nodes(sample, domain);  // internal forces, intact joints, motion, constraints; proxies leave
  if (!scratch.crossed.empty())
    timed(Phase::joints, [&] { activate_joints(model, scratch.crossed, state, domain.derived); });
  if (changes) account_step_change(domain);
  if (sample) sample_energies(domain);
  timed(Phase::joints, [&] {
    return_elastic_joints(model.local, state.work.joints.elastic, state.joints.active, domain.derived.links);
  });
  timed(Phase::loads, [&] { account_late_work(model.local, scratch, state); });
  receive_proxies(domain);
  advance_clock(state);
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
