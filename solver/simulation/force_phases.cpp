#include <cmath>

#include "observe/energy_sample.hpp"
#include "simulation/phases.hpp"

/// The phases of a step before and after the motion: loads, joints, contact, samples.
namespace breccia {

void apply_loads(Domain& domain) {
  const auto lap = domain.timer.measure(Phase::loads);
  State& state = domain.state;
  StepScratch& scratch = domain.scratch;
  const LocalMesh& local = domain.model.local;
  scratch.forces.clear();
  for (SurfaceLoad& p : state.loads.surfaces)
    p.apply(local, state.nodes, state.clock.time, state.clock.dt_before, scratch.forces);
  for (NodalLoad& f : state.loads.forces)
    f.apply(local, state.nodes, state.clock.time, state.clock.dt_before, scratch.forces);
  for (std::size_t i = 0; i < 3; ++i) scratch.gravity[i] = state.loads.gravity[i](state.clock.time);
  state.work.gravity.advance(local, state.nodes, Vec3(scratch.gravity[0], scratch.gravity[1], scratch.gravity[2]),
                             state.clock.dt_before);
}

void joint_forces(Domain& domain) {
  const auto lap = domain.timer.measure(Phase::joints);
  State& state = domain.state;
  JointWork& work = state.work.joints;
  active_joint_forces(domain.model.joint_laws, domain.model.local, state.nodes.position.data(), state.clock.time,
                      domain.simd, state.joints.active, domain.scratch.forces, work);
  state.joints.broken += static_cast<std::int64_t>(work.failed.size());
  for (const ReleasedJoint& joint : work.released) {
    if (!domain.model.local.is_original(joint.slot_a)) continue;
    state.joints.released.push_back(joint);
    state.signals.released_here.push_back(joint.id);
  }
}

void contact_forces(Domain& domain) {
  if (!domain.contact) return;
  const auto lap = domain.timer.measure(Phase::contact);
  State& state = domain.state;
  contact_forces(domain.model.contact, domain.model.local, state.nodes, state.clock.dt_before, state.contact,
                 domain.scratch.forces, state.work.contact, domain.simd);
}

void activate_crossed_joints(Domain& domain) {
  if (domain.scratch.crossed.empty()) return;
  const auto lap = domain.timer.measure(Phase::joints);
  activate_joints(domain.model, domain.scratch.crossed, domain.state, domain.derived);
}

void account_step_change(Domain& domain) {
  domain.exchange.agree_on_failure();
  const auto lap = domain.timer.measure(Phase::energy);
  AccountedWork& work = domain.state.work;
  // Where a load sets in on a body at rest there is no energy yet but this: it counts as put in.
  double& account = begins_stage(domain.state) ? work.first_excess : work.step_change;
  account += step_change_energy(domain.scratch.velocity_before, domain);
}

void sample_energies(Domain& domain) {
  domain.exchange.agree_on_failure();
  const auto lap = domain.timer.measure(Phase::energy);
  domain.sample = energy_sample(domain.scratch.velocity_before, domain);
  double& first = domain.state.work.first_excess;
  if (std::isnan(first)) first = excess_energy(domain.sample.budget) - domain.sample.budget.step_change;
  set_residual(first, domain.model.whole.energy_floor, domain.sample.budget);
}

void return_elastic_joints(Domain& domain) {
  const auto lap = domain.timer.measure(Phase::joints);
  const Index end = domain.model.local.num_own_slots;  // the sweep evaluates the faces of these only
  std::vector<GlobalId> ids;
  for (const ElasticJoint& joint : domain.state.work.joints.elastic) {
    if (joint.slot_a >= end || joint.slot_b >= end) continue;
    domain.derived.links.attach(joint.slot_a, joint.face_a, joint.slot_b, joint.code);
    ids.push_back(joint.id);
  }
  domain.state.joints.active.erase(ids);
}

void account_late_work(Domain& domain) {
  const auto lap = domain.timer.measure(Phase::loads);
  State& state = domain.state;
  for (SurfaceLoad& p : state.loads.surfaces) p.account_after(domain.model.local, state.nodes, state.clock.dt);
  for (NodalLoad& f : state.loads.forces) f.account_after(domain.model.local, state.nodes, state.clock.dt);
  state.constraints.account_after(state.clock.dt);
  state.absorbing.account_after(state.nodes.velocity, state.clock.dt);
  const auto merge = [](Field<double>& work, const Field<double>& late) {
    for (std::size_t i = 0; i < late.size(); ++i) work[i] += late[i];
  };
  merge(state.elements[kViscousWork], domain.scratch.viscous_late);
  merge(state.elements[kStressWork], domain.scratch.stress_late);
  merge(state.damping_work, domain.scratch.damping_late);
}

}  // namespace breccia
