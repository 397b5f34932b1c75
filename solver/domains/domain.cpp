#include "domains/domain.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "domains/motion_limit.hpp"
#include "domains/state_records.hpp"

namespace breccia {
namespace {

/// Nodes at rest in their places, and the fields that the materials need.
void start_state(const Model& model, State& state) {
  const LocalMesh& local = model.local;
  state.nodes.position = local.reference;
  state.nodes.next_position = local.reference;
  state.nodes.velocity.assign(local.reference.size(), 0.0);
  bool viscous = false, stress_work = false, memory = false;
  for (const ElasticParams& p : model.elastic) {
    viscous = viscous || p.viscosity > 0;
    stress_work = stress_work || !is_hyperelastic(p.law);
    memory = memory || memory_size(p.law) > 0;
  }
  if (viscous) state.elements.allocate(kViscousWork, local.num_slots);
  if (stress_work) state.elements.allocate(kStressWork, local.num_slots);
  if (memory) state.elements.allocate(kMaterialMemory, local.num_slots);
}

/// Dissipation by a viscosity of an earlier run that this one lacks remains accounted.
void keep_earlier_work(const Records& records, const LocalMesh& local, State& state) {
  const auto done = [](const ElementRecord& record) { return record.numbers[first_number(kViscousWork)] != 0; };
  if (state.elements[kViscousWork].empty() && std::any_of(records.elements.begin(), records.elements.end(), done))
    state.elements.allocate(kViscousWork, local.num_slots);
}

/// Of the present stage but for gravity, J.
ExactSum work_of_loads(const State& state) {
  ExactSum sum = state.constraints.work();
  sum.add(state.absorbing.work());
  for (const SurfaceLoad& load : state.loads.surfaces) sum.add(load.work());
  for (const NodalLoad& load : state.loads.forces) sum.add(load.work());
  return sum;
}

}  // namespace

Domain::Domain(const Model& of, const ContactSearchParams& search) : model(of), derived(derive(of)), scratch(of.local) {
  start_state(model, state);
  start_joints(*this);
  if (!model.has_contact) return;
  const ContactModel parts{model.contact, model.mesh, model.topology, model.local};
  contact = std::make_unique<ContactSearch>(search, parts, state.contact);
}

Domain::Domain(const Model& of, const ContactSearchParams& search, const Records& records, const Continuation& from)
    : model(of), derived(derive(of)), timer(from.timer), sample(from.sample), scratch(of.local) {
  start_state(model, state);
  copy_model_fields(from.state, state);
  keep_earlier_work(records, model.local, state);
  restore(records, model, state, derived);
  state.work.gravity.set_anchor(model.local, state.nodes.position);
  if (model.has_contact) contact = std::make_unique<ContactSearch>(search, model, records, state.contact);
}

void Domain::connect(const Communicator& communicator, std::vector<SharedSlots> shared, ExchangeKind kind) {
  exchange.connect(communicator, model, std::move(shared), kind, contact && contact->verifies());
  if (contact) contact->restrict_to(derived.relevant);
  plan_exchange();
  exchange.begin_reduction(state.clock, state.signals);
}

/// Near are elements on whose positions the forces computed here depend: those relevant, those that had a joint with
/// them at first, and those in couples. Moving are those on whose velocities they depend as well: those that contact
/// may touch, and of shared nodes (viscosity).
void Domain::plan_exchange() {
  std::vector<std::uint8_t> near = derived.relevant, moving(derived.relevant.size(), 0);
  for (const ModelJoint& joint : model.joints) {
    const Index a = model.local.slot_of_element[at(joint.face.a)], b = model.local.slot_of_element[at(joint.face.b)];
    if (derived.is_relevant(a) || derived.is_relevant(b)) near[at(a)] = near[at(b)] = 1;
  }
  std::fill(moving.begin() + model.local.num_own_slots, moving.end(), std::uint8_t{1});
  if (contact) {
    contact->mark_coupled(near);
    contact->mark_coupled(moving);
  }
  exchange.plan_near(model.local, near, moving);
  plan_sweep_order(model, state.loads, exchange.sent_blocks(), derived);
}

void start_joints(Domain& domain) {
  const Model& model = domain.model;
  std::vector<ActiveJoint> from_start;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (starts_intact(model, model.joints[j])) continue;
    const ActiveJoint joint = new_active_joint(model, j);
    if (domain.derived.is_relevant(joint.slot_a) || domain.derived.is_relevant(joint.slot_b))
      from_start.push_back(joint);
  }
  domain.state.joints.active.insert(from_start);
}

void add_velocity(Domain& domain, const InitialVelocity& initial) {
  const Model& model = domain.model;
  add_initial_velocity(model.local, initial, domain.state.nodes.position, domain.state.nodes.velocity,
                       mass_share(model.local, model.density, initial));
  domain.state.signals.max_speed = fastest_node(domain).speed;
}

std::vector<NodeForce> held_forces(const Domain& domain) {
  const State& state = domain.state;
  if (state.clock.steps == state.held_before) return state.held;
  std::vector<NodeForce> forces = state.constraints.reactions();
  const std::vector<NodeForce> supports = state.absorbing.supports();
  forces.insert(forces.end(), supports.begin(), supports.end());
  std::stable_sort(forces.begin(), forces.end(),
                   [](const NodeForce& a, const NodeForce& b) { return a.node < b.node; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (kept > 0 && forces[kept - 1].node == forces[i].node)
      forces[kept - 1].force += forces[i].force;
    else
      forces[kept++] = forces[i];
  }
  forces.resize(kept);
  return forces;
}

void begin_stage(Domain& domain, StageLoads loads, double dt) {
  State& state = domain.state;
  state.held = held_forces(domain);
  state.held_before = state.clock.steps;
  state.work.past_loads.add(work_of_loads(state));
  state.loads = std::move(loads);
  state.constraints = Constraints(state.loads.constraints, domain.model.local, state.nodes, state.loads.mass_damping,
                                  state.loads.local_damping);
  state.absorbing = AbsorbingBoundary(state.loads.absorbing, domain.model.local, state.constraints, state.held);
  if (state.loads.mass_damping > 0 || state.loads.local_damping > 0 || !state.loads.absorbing.empty())
    state.damping_work.resize(at(domain.model.local.num_nodes));
  state.clock.dt = dt;
  if (!domain.exchange.alone())
    plan_sweep_order(domain.model, state.loads, domain.exchange.sent_blocks(), domain.derived);
}

void break_joints(Domain& domain, std::span<const LoadedFace> faces) {
  const Model& model = domain.model;
  std::vector<GlobalId> by_hand;
  std::vector<std::size_t> crossed;
  const auto has_relevant_side = [&](Index joint) {
    const JointFace& face = model.joints[at(joint)].face;
    return domain.derived.is_relevant(model.local.slot_of_element[at(face.a)]) ||
           domain.derived.is_relevant(model.local.slot_of_element[at(face.b)]);
  };
  for (const LoadedFace& face : faces) {
    const Index joint = domain.derived.joint_at(face.slot, face.face);
    if (joint < 0) continue;
    if (is_swept(model, domain.derived, face.slot, face.face) && has_relevant_side(joint)) crossed.push_back(at(joint));
    by_hand.push_back(model.joint_id(at(joint)));
  }
  std::sort(by_hand.begin(), by_hand.end());
  activate_joints(model, crossed, domain.state, domain.derived);
  domain.state.joints.active.break_points(by_hand);
}

void activate_joints(const Model& model, std::vector<std::size_t>& crossed, State& state, Derived& derived) {
  if (crossed.empty()) return;
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  std::vector<ActiveJoint> batch;
  for (const std::size_t index : crossed) {
    const ActiveJoint& joint = batch.emplace_back(new_active_joint(model, index));
    derived.links.detach(joint.slot_a, joint.face_a);
    derived.links.detach(joint.slot_b, joint.code / 3);
  }
  crossed.clear();
  start_history(model.joint_laws, model.local, state.nodes.position.data(), batch);
  state.joints.active.insert(batch);
}

ExactSum external_work(const Domain& domain) {
  const State& state = domain.state;
  ExactSum sum = state.work.past_loads;
  sum.add(work_of_loads(state));
  sum.add(state.work.gravity.work(domain.model.local, state.nodes.position));
  return sum;
}

void conclude(Domain& domain) {
  const auto timing = domain.timer.measure(Phase::communication);
  domain.exchange.conclude(domain.state.clock, domain.state.signals);
  record_received_motion(domain);
}

State closed_fields(const Domain& domain) {
  const State& state = domain.state;
  State closed;
  copy_model_fields(state, closed);
  closed.work.past_loads.add(work_of_loads(state));
  closed.work.gravity = state.work.gravity;  // with its anchor, which is no row of the table
  closed.work.gravity.close(domain.model.local, state.nodes.position);
  closed.counters.messages = domain.messages();
  closed.counters.bytes = domain.bytes();
  return closed;
}

Continuation close(Domain& domain) {
  State& state = domain.state;
  // What the last step received counts until the next one has received, which receives the rest again.
  const StepSignals received = state.signals.received;
  const bool released = state.signals.released;
  conclude(domain);
  state.signals.sent = state.signals.received;
  state.signals.received = received;
  state.signals.released = released;
  Continuation carried{closed_fields(domain), domain.timer, domain.sample};
  begin_stage(domain, {}, state.clock.dt);
  return carried;
}

}  // namespace breccia
