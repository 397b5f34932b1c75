#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "base/index.hpp"
#include "base/number_text.hpp"
#include "domains/motion_limit.hpp"
#include "physics/kick.hpp"
#include "simulation/phases.hpp"

/// The phase of a step that takes nodes from forces to their next positions.
namespace breccia {
namespace {

/// An element's limit is that of its weakest joint: whether this one has left its elastic range is seen here, alike
/// from both sides, since only one of them may be swept on this rank. @param force  stays as it is if it has not
void note_crossing(void* context, Index slot, int face, double* force) {
  auto& domain = *static_cast<Domain*>(context);
  const Model& model = domain.model;
  const Index index = domain.derived.joint_at(slot, face);
  const ActiveJoint virgin = new_active_joint(model, at(index));
  const JointLawParams& law = model.joint_laws[at(virgin.law)];
  const double* x = domain.state.nodes.position.data();
  if (!(largest_opening_squared(model.local, x, virgin) > law.screen_limit())) return;
  virgin_forces(law, model.local, x, virgin, virgin.slot_a == slot, force);
  domain.scratch.crossed.push_back(at(index));
}

/// Where the sweep accounts the work of one kind: the half before t_n, and the half after it, which waits in `late`
/// for account_late_work() when the energies at t_n are sampled.
void split_work(bool wait, Field<double>& work, Field<double>& late, double*& before, double*& after) {
  late.clear();
  if (work.empty()) return;
  if (wait) late.assign(work.size(), 0.0);
  before = work.data();
  after = wait ? late.data() : work.data();
}

void set_model_args(const Domain& domain, SweepArgs& args) {
  const LocalMesh& local = domain.model.local;
  const Derived& derived = domain.derived;
  args.end_own_block = local.num_own_originals / kLanes;
  args.num_own_blocks = local.num_own_blocks();
  args.shared_blocks = derived.shared_blocks.data();
  args.num_shared_blocks = static_cast<Index>(derived.shared_blocks.size());
  args.num_moved_nodes = local.num_moved_nodes;
  args.gradient = local.gradient.data();
  args.volume = local.volume.data();
  args.node_mass = local.node_mass.data();
  if (domain.model.plane) {
    args.free_across = derived.free_across.data();
    args.across = static_cast<std::size_t>(domain.model.plane->axis);
  }
  args.shared_corners = derived.shared_corners.data();
  args.link = derived.links.link.data();
  args.place = derived.links.place.data();
  args.stiffness = derived.links.stiffness.data();
  args.limit = derived.links.limit.data();
  args.block_group = local.block_group.data();
  args.original = local.original.data();
  args.params = domain.model.elastic.data();
}

SweepArgs sweep_args(bool sample, Domain& domain) {
  State& state = domain.state;
  StepScratch& scratch = domain.scratch;
  SweepArgs args;
  set_model_args(domain, args);
  args.position = state.nodes.position.data();
  args.next_position = state.nodes.next_position.data();
  args.velocity = state.nodes.velocity.data();
  args.crossing = &note_crossing;
  args.crossing_context = &domain;
  args.force_slot = scratch.forces.slots();
  args.own_force = scratch.forces.own();
  args.shared_force = scratch.forces.shared();
  args.memory = state.elements[kMaterialMemory].data();
  args.memory_stride = kElementFields[kMaterialMemory].components;
  args.dt = state.clock.dt;
  args.kick = kick_length(state.clock.dt_before, state.clock.dt);
  args.gravity = scratch.gravity;
  args.mass_damping = state.loads.mass_damping;
  args.local_damping = state.loads.local_damping;
  Field<double>&viscous = state.elements[kViscousWork], &stress = state.elements[kStressWork];
  if (!viscous.empty() || !stress.empty()) {
    scratch.kept_stress.resize(at(domain.model.local.num_slots) * 18);
    args.kept_stress = scratch.kept_stress.data();
  }
  split_work(sample, viscous, scratch.viscous_late, args.viscous_before, args.viscous_after);
  split_work(sample, stress, scratch.stress_late, args.stress_before, args.stress_after);
  // That of constrained nodes is corrected afterwards (account_held_damping): it is always deferred, so that the sums
  // are bitwise the same whether the energies are sampled or not.
  scratch.damping_late.clear();
  if (args.mass_damping > 0 || args.local_damping > 0 || !state.absorbing.empty())
    split_work(sample || !state.constraints.empty(), state.damping_work, scratch.damping_late, args.damping_before,
               args.damping_after);
  return args;
}

bool is_finite(const Vec3& v) { return v.squaredNorm() < 1e300; }

/// The lowest of the elements here that have a node whose velocity is not finite; -1: none
GlobalId first_not_finite(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  GlobalId lowest = -1;
  for (Index slot = 0; slot < local.num_slots; ++slot) {
    const GlobalId id = local.element_of_slot[at(slot)];
    if (id < 0 || !local.is_original(slot) || (lowest >= 0 && id > lowest)) continue;
    for (int corner = 0; corner < 4; ++corner) {
      if (!is_finite(load_node(domain.state.nodes.velocity.data(), local.corner_node(slot, corner)))) lowest = id;
    }
  }
  return lowest;
}

/// What may be wrong where a velocity is not finite, by what the state shows.
std::string remedy_of(const Domain& domain) {
  if (domain.state.counters.crushed > 0)
    return "elements have been crushed or turned inside out: lower speeds and loads, use larger elements there, or "
           "lower time.safety (or time.step)";
  if (!domain.state.loads.surfaces.empty() || !domain.state.loads.forces.empty())
    return "a pressure, traction or force keeps accelerating fragments that have separated: end it or lower it, or "
           "lower time.safety (or time.step)";
  return "the time step is too long for the motion there: lower time.safety (or time.step), or the penalties";
}

/// Ends the run, with a state whose numbers can be shown: positions are those before this step.
void check_finite(const SweepStatus& status, Domain& domain) {
  if (status.speed_squared_sum < 1e300 || domain.exchange.failed()) return;
  const GlobalId element = first_not_finite(domain);
  const std::string place = element >= 0 ? " in element " + std::to_string(element) : "";
  NodalState& nodes = domain.state.nodes;
  for (Index node = 0; node < domain.model.local.num_nodes; ++node) {
    if (!is_finite(load_node(nodes.velocity.data(), node))) store_node(nodes.velocity.data(), node, Vec3::Zero());
  }
  const Clock& clock = domain.state.clock;
  domain.exchange.fail("step " + std::to_string(clock.steps) + ", time " + number_text(clock.time, 6) +
                       " s: a velocity is not finite" + place + "; " + remedy_of(domain));
}

void note_status(const SweepStatus& status, Domain& domain) {
  domain.state.counters.crushed += status.crushed;
  check_finite(status, domain);
  double& max_speed = domain.state.signals.max_speed;
  max_speed = std::max(max_speed, std::sqrt(status.max_speed_squared));
}

/// Own-node blocks only. @param pause  called now and then
void sweep_runs(SweepFunction sweep, std::span<const BlockRun> runs, SweepArgs args, SweepStatus& status,
                const auto& pause) {
  args.num_shared_blocks = 0;
  args.num_moved_nodes = 0;
  Index since_pause = 0;
  for (const BlockRun& run : runs) {
    args.first_own_block = run.first;
    args.end_own_block = run.end;
    status.add(sweep(args));
    since_pause += run.end - run.first;
    if (since_pause < kLongestRun) continue;
    since_pause = 0;
    pause();
  }
}

void sweep_all(const SweepArgs& args, Domain& domain) {
  const auto timing = domain.timer.measure(Phase::sweep);
  note_status(sweep_for(domain.simd)(args), domain);
}

/// Shared nodes, and the blocks that others wait for.
void sweep_ahead(const SweepArgs& args, Domain& domain) {
  const auto timing = domain.timer.measure(Phase::sweep);
  SweepArgs only_shared = args;
  only_shared.end_own_block = 0;
  SweepStatus status = sweep_for(domain.simd)(only_shared);
  sweep_runs(sweep_for(domain.simd), domain.derived.ahead, args, status, [] {});
  note_status(status, domain);
}

/// Messages move on meanwhile.
void sweep_rest(const SweepArgs& args, Domain& domain) {
  const auto timing = domain.timer.measure(Phase::sweep);
  SweepStatus status;
  sweep_runs(sweep_for(domain.simd), domain.derived.rest, args, status,
             [&] { domain.exchange.communicator().make_progress(); });
  note_status(status, domain);
}

/// A rank that has failed: what others receive of it from now on is finite.
void stand_still_if_failed(Domain& domain) {
  if (!domain.exchange.failed()) return;
  NodalState& nodes = domain.state.nodes;
  nodes.next_position = nodes.position;
  std::fill(nodes.velocity.begin(), nodes.velocity.end(), 0.0);
}

void send_proxies(Domain& domain) {
  const auto timing = domain.timer.measure(Phase::communication);
  domain.exchange.communicator().set_phase("gather of proxies");
  domain.exchange.begin_gather(domain.state.nodes.next_position, domain.state.nodes.velocity);
}

/// Local damping force of the sweep on the constrained axes of a node, N, recovered from its effect on their
/// velocities.
Vec3 local_force_on_held(const SweepArgs& args, const std::array<bool, 3>& held, const Vec3& before, const Vec3& after,
                         double mass) {
  const AppliedDamping damping{args.mass_damping, args.local_damping, args.kick};
  Vec3 force = Vec3::Zero();
  for (std::size_t i = 0; i < 3 && args.local_damping > 0; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (held[i]) force[axis] = damping.local_force(before[axis], after[axis], mass);
  }
  return force;
}

/// Velocities of the nodes of the constraints.
void keep_held(const Domain& domain, std::vector<Vec3>& velocities) {
  velocities.clear();
  for (const Index node : domain.state.constraints.nodes())
    velocities.push_back(load_node(domain.state.nodes.velocity.data(), node));
}

/// The sweep accounted the damping of constrained nodes with their unconstrained velocities. Mass damping acts on their
/// imposed mean velocity, local damping not at all.
void account_held_damping(const SweepArgs& args, Domain& domain) {
  const std::vector<Vec3>& free = domain.scratch.held_free;
  const std::vector<Index>& nodes = domain.state.constraints.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t node = at(nodes[i]);
    const Vec3 held = load_node(domain.state.nodes.velocity.data(), nodes[i]);
    const Vec3& before = domain.scratch.held_before[i];
    const double mass = domain.model.local.node_mass[node];
    const Vec3 change = 0.5 * args.mass_damping * mass * (free[i] - held);  // of the force
    const Vec3 force = -0.5 * args.mass_damping * mass * (before + free[i]);
    const Vec3 local = local_force_on_held(args, domain.state.constraints.held_axes()[i], before, free[i], mass);
    args.damping_before[node] += (args.kick - 0.5 * args.dt) * (local - change).dot(before);
    args.damping_after[node] += 0.5 * args.dt * (force.dot(free[i] - held) + local.dot(free[i]) - change.dot(held));
  }
}

void absorb(const SweepArgs& args, Domain& domain) {
  State& state = domain.state;
  if (state.absorbing.empty()) return;
  const auto timing = domain.timer.measure(Phase::loads);
  state.absorbing.apply(state.nodes, state.clock.dt_before, state.clock.dt, args.damping_before, args.damping_after);
}

void constrain(const SweepArgs& args, Domain& domain) {
  State& state = domain.state;
  if (state.constraints.empty()) return;
  const auto timing = domain.timer.measure(Phase::loads);
  const bool damped = args.damping_after != nullptr;
  if (damped) keep_held(domain, domain.scratch.held_free);
  state.constraints.apply(state.nodes, state.clock.time, state.clock.dt_before, state.clock.dt);
  if (damped) account_held_damping(args, domain);
  double& max_speed = state.signals.max_speed;
  for (const NodalConstraint& entry : state.loads.constraints) {
    if (holds_still(entry)) continue;  // slower than others, or counted anew (correct_max_speed)
    for (const Index node : entry.nodes) {
      if (!domain.model.local.is_moved(node)) continue;
      max_speed = std::max(max_speed, load_node(state.nodes.velocity.data(), node).norm());
    }
  }
}

/// Right after the sweep: m/s, the largest unconstrained speed of constrained nodes. 0: none
double fastest_if_free(const Domain& domain) {
  double fastest = 0;
  for (const Index node : domain.state.constraints.nodes())
    fastest = std::max(fastest, load_node(domain.state.nodes.velocity.data(), node).norm());
  return fastest;
}

/// The largest speed of the sweep is computed again if it may be the unconstrained speed of a constrained node.
void correct_max_speed(double fastest_if_free, Domain& domain) {
  constexpr double kRoundOff = 1e-12;
  double& max_speed = domain.state.signals.max_speed;
  if (fastest_if_free > 0 && fastest_if_free >= (1 - kRoundOff) * max_speed) max_speed = fastest_node(domain).speed;
}

/// Padding stays where it is; work of the halves after t_n with the velocities as constraints left them.
void finish_motion(const SweepArgs& args, Domain& domain) {
  const auto timing = domain.timer.measure(Phase::loads);
  if (args.kept_stress != nullptr) rate_work_for(domain.simd)(args);
  NodalState& nodes = domain.state.nodes;
  for (const Index node : domain.derived.padding_nodes) {
    store_node(nodes.velocity.data(), node, Vec3::Zero());
    store_node(nodes.next_position.data(), node, load_node(nodes.position.data(), node));
    if (args.damping_after != nullptr) args.damping_before[at(node)] = args.damping_after[at(node)] = 0.0;
  }
}

}  // namespace

void move_nodes(bool sample, Domain& domain) {
  const SweepArgs args = sweep_args(sample, domain);
  if (args.damping_after != nullptr) keep_held(domain, domain.scratch.held_before);
  domain.state.absorbing.begin(domain.state.nodes.velocity);
  domain.state.signals.max_speed = 0;
  double held_if_free = 0;
  if (domain.exchange.alone()) {
    sweep_all(args, domain);
    held_if_free = fastest_if_free(domain);
    absorb(args, domain);
    constrain(args, domain);
  } else {
    sweep_ahead(args, domain);
    held_if_free = fastest_if_free(domain);
    absorb(args, domain);
    constrain(args, domain);
    stand_still_if_failed(domain);
    send_proxies(domain);
    sweep_rest(args, domain);
    stand_still_if_failed(domain);
  }
  finish_motion(args, domain);
  correct_max_speed(held_if_free, domain);
  note_motion(domain);
}

}  // namespace breccia
