#pragma once

#include "domains/domain.hpp"

namespace breccia {

// The phases of a step in their order (simulation/step.cpp). Those that a rank does alone take what they read and
// write; those that exchange something, and the sweep, which sends between its parts, take the domain.

/// Whether the step to come is the first of a stage whose loads and constraints follow on other ones.
[[nodiscard]] inline bool begins_stage(const State& state) {
  return state.clock.steps > 0 && state.clock.steps == state.signals.step_motion.stage_step;
}

/// What all ranks sent in the last step: state.signals. Throws what a rank has failed with.
void receive_signals(Domain& domain);

/// Reads positions and state.signals; writes state.contact: couples searched anew when that is due, faces of the joints
/// that any rank released a step ago. Positions of proxies, and what is exchanged in every step, go with them.
void update_couples(Domain& domain);

/// Writes scratch.forces: pressures and forces at t_n; keeps gravity at t_n for the sweep. Accounts the work of all up
/// to t_n.
void apply_loads(const LocalMesh& local, State& state, StepScratch& scratch);

/// Adds the forces of the active joints and brings their histories up to date. Reads state.nodes; released joints leave
/// state.joints.active, and those of originals are noted in state.signals for the other ranks.
void joint_forces(const Model& model, Simd simd, State& state, NodalForces& forces);

/// Sends the signals of this rank to all others, received in the next step.
void send_signals(const StepSignals& signals, Domain& domain);

/// From forces to v_(n+1/2) and x_(n+1): internal forces, the sweep's joints, damping, gravity, constraints. On several
/// ranks what others wait for is final, and on its way, before the rest is begun. Joints that leave their elastic range
/// are noted in scratch.crossed.
/// @param sample  work after t_n is kept apart until account_late_work()
void move_nodes(bool sample, Domain& domain);

/// Whether t_n lies between steps of different lengths.
[[nodiscard]] inline bool changes_step(const Clock& clock) {
  return clock.dt_before > 0 && clock.dt != clock.dt_before;
}

/// Where the step changes: what the change moves the kinetic energy by at t_n, in state.work; where a stage begins it
/// counts as put in. @pre scratch.velocity_before is v_(n-1/2). Throws what any rank failed with.
void account_step_change(Domain& domain);

/// The energies at t_n: Domain::sample.
/// @pre scratch.velocity_before is v_(n-1/2). Throws what any rank failed with.
void sample_energies(Domain& domain);

/// Elastic joints return to the sweep, which evaluates them at lower cost. @param elastic  found by joint_forces()
void return_elastic_joints(const LocalMesh& local, std::span<const ElasticJoint> elastic, ActiveJoints& active,
                           JointLinks& links);

/// Work of pressures and constraints, and of what the sweep accounts, after t_n.
void account_late_work(const LocalMesh& local, const StepScratch& scratch, State& state);

/// Waits for the proxies' next positions and velocities.
void receive_proxies(Domain& domain);

/// x_n becomes x_(n+1), t_n becomes t_(n+1).
void advance_clock(State& state);

}  // namespace breccia
