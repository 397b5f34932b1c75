#include <cmath>

#include "observe/energy_sample.hpp"
#include "simulation/phases.hpp"

/// The phases of a step before and after the motion: loads, joints, contact, samples.
namespace breccia {

void apply_loads(const LocalMesh& local, State& state, StepScratch& scratch) {
  const Clock& clock = state.clock;
  scratch.forces.clear();
  for (SurfaceLoad& p : state.loads.surfaces) p.apply(local, state.nodes, clock.time, clock.dt_before, scratch.forces);
  for (NodalLoad& f : state.loads.forces) f.apply(local, state.nodes, clock.time, clock.dt_before, scratch.forces);
  for (std::size_t i = 0; i < 3; ++i) scratch.gravity[i] = state.loads.gravity[i](clock.time);
  state.work.gravity.advance(local, state.nodes, Vec3(scratch.gravity[0], scratch.gravity[1], scratch.gravity[2]),
                             clock.dt_before);
}

void joint_forces(const Model& model, Simd simd, State& state, NodalForces& forces) {
  JointWork& work = state.work.joints;
  JointSet& joints = state.joints;
  active_joint_forces(model.joint_laws, model.local, state.nodes.position.data(), state.clock.time, simd, joints.active,
                      forces, work);
  joints.broken += static_cast<std::int64_t>(work.failed.size());
  for (const ReleasedJoint& joint : work.released) {
    if (!model.local.is_original(joint.slot_a)) continue;
    joints.released.push_back(joint);
    state.signals.released_here.push_back(joint.id);
  }
}

void account_step_change(Domain& domain) {
  domain.exchange.agree_on_failure();
  const auto timing = domain.timer.measure(Phase::energy);
  AccountedWork& work = domain.state.work;
  // Where a load sets in on a body at rest there is no energy yet but this: it counts as put in.
  double& account = begins_stage(domain.state) ? work.first_excess : work.step_change;
  account += step_change_energy(domain.scratch.velocity_before, domain);
}

void sample_energies(Domain& domain) {
  domain.exchange.agree_on_failure();
  const auto timing = domain.timer.measure(Phase::energy);
  domain.sample = energy_sample(domain.scratch.velocity_before, domain);
  double& first = domain.state.work.first_excess;
  if (std::isnan(first)) first = excess_energy(domain.sample.budget) - domain.sample.budget.step_change;
  set_residual(first, domain.model.whole.energy_floor, domain.sample.budget);
}

void return_elastic_joints(const LocalMesh& local, std::span<const ElasticJoint> elastic, ActiveJoints& active,
                           JointLinks& links) {
  const Index end = local.num_own_slots;  // the sweep evaluates the faces of these only
  std::vector<GlobalId> ids;
  for (const ElasticJoint& joint : elastic) {
    if (joint.slot_a >= end || joint.slot_b >= end) continue;
    links.attach(joint.slot_a, joint.face_a, joint.slot_b, joint.code);
    ids.push_back(joint.id);
  }
  active.erase(ids);
}

void account_late_work(const LocalMesh& local, const StepScratch& scratch, State& state) {
  for (SurfaceLoad& p : state.loads.surfaces) p.account_after(local, state.nodes, state.clock.dt);
  for (NodalLoad& f : state.loads.forces) f.account_after(local, state.nodes, state.clock.dt);
  state.constraints.account_after(state.clock.dt);
  state.absorbing.account_after(state.nodes.velocity, state.clock.dt);
  const auto merge = [](Field<double>& work, const Field<double>& late) {
    for (std::size_t i = 0; i < late.size(); ++i) work[i] += late[i];
  };
  merge(state.elements[kViscousWork], scratch.viscous_late);
  merge(state.elements[kStressWork], scratch.stress_late);
  merge(state.damping_work, scratch.damping_late);
}

}  // namespace breccia
