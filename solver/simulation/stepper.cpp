#include "simulation/stepper.hpp"

#include <algorithm>
#include <utility>

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Corners of shared-node elements as the sweep wants them: [shared block][4][8].
std::vector<Index> blocked_corners(const LocalMesh& local) {
  std::vector<Index> blocked;
  blocked.reserve(local.shared_corners.size() * 4);
  for (std::size_t first = 0; first < local.shared_corners.size(); first += kLanes) {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) blocked.push_back(local.shared_corners[first + lane][c]);
    }
  }
  return blocked;
}

}  // namespace

Stepper::Stepper(const Model& model, const ContactSearchParams& search) : Stepper(model, nullptr) {
  start_joints();
  if (model.has_contact)
    contact_ = std::make_unique<ContactSearch>(search, model.contact, model.mesh, model.topology, model.local);
}

/// Fields at rest, links, and what the sweep wants.
Stepper::Stepper(const Model& model, std::nullptr_t)
    : model_(model),
      links_(build_links(model)),
      forces_(model.local.num_own_blocks(), model.local.num_nodes),
      simd_(best_simd()),
      shared_corners_(blocked_corners(model.local)) {
  const LocalMesh& local = model_.local;
  state_.position = local.reference;
  state_.next_position = local.reference;
  state_.velocity.assign(local.reference.size(), 0.0);
  for (Index n = 0; n < local.num_nodes; ++n) {
    if (local.node_id[at(n)] < 0) padding_nodes_.push_back(n);
  }
  for (const ElasticParams& p : model_.elastic) {
    viscous_on_ = viscous_on_ || p.viscosity > 0;
    stress_work_on_ = stress_work_on_ || !is_hyperelastic(p.law);
  }
  if (viscous_on_) viscous_.resize(at(local.num_slots));
  if (stress_work_on_) stress_work_.resize(at(local.num_slots));
  if (viscous_on_ || stress_work_on_) kept_stress_.resize(at(local.num_slots) * 18);
  index_joints();
  find_relevant();
}

void Stepper::index_joints() {
  const LocalMesh& local = model_.local;
  joint_of_face_.assign(at(local.num_slots) * 4, -1);
  const auto note = [&](Index element, int face, std::size_t joint) {
    joint_of_face_[at(local.slot_of_element[at(element)]) * 4 + static_cast<std::size_t>(face)] =
        static_cast<Index>(joint);
  };
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const JointFace& face = model_.joints[j].face;
    note(face.a, face.face_a, j);
    note(face.b, face.code / 3, j);
  }
}

void Stepper::start_joints() {
  std::vector<ActiveJoint> from_start;
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    if (!starts_intact(model_, model_.joints[j])) from_start.push_back(make_active(j));
  }
  active_.insert(from_start);
}

ActiveJoint Stepper::make_active(std::size_t index) const {
  const ModelJoint& joint = model_.joints[index];
  ActiveJoint active;
  active.id = model_.joint_id(index);
  active.slot_a = model_.local.slot_of_element[at(joint.face.a)];
  active.slot_b = model_.local.slot_of_element[at(joint.face.b)];
  active.face_a = joint.face.face_a;
  active.code = joint.face.code;
  active.law = joint.law;
  active.area = joint.face.area;
  return active;
}

void Stepper::begin_stage(StageLoads loads, double dt) {
  for (const PressureLoad& p : pressures_) past_external_.add(p.work());
  past_external_.add(constraints_.work());
  pressures_ = std::move(loads.pressures);
  gravity_ = std::move(loads.gravity);
  entries_ = std::move(loads.constraints);
  constraints_ = Constraints(entries_, model_.local, state_);
  mass_damping_ = loads.mass_damping;
  local_damping_ = loads.local_damping;
  if (mass_damping_ > 0 || local_damping_ > 0) damping_.resize(at(model_.local.num_nodes));
  dt_ = dt;
  if (near_) plan_order();
}

void Stepper::break_joints(std::span<const LoadedFace> faces) {
  std::vector<GlobalId> by_hand;
  const auto matters = [&](std::size_t joint) {
    const JointFace& face = model_.joints[joint].face;
    return relevant(model_.local.slot_of_element[at(face.a)]) || relevant(model_.local.slot_of_element[at(face.b)]);
  };
  for (const LoadedFace& face : faces) {
    const Index id = joint_of_face_[at(face.slot) * 4 + static_cast<std::size_t>(face.face)];
    if (id >= 0 && swept(face.slot, face.face) && matters(at(id))) crossed_.push_back(at(id));
    if (id >= 0) by_hand.push_back(model_.joint_id(at(id)));
  }
  std::sort(by_hand.begin(), by_hand.end());
  activate_crossing();
  active_.break_points(by_hand);
}

void Stepper::step(bool sample, const StepSignals& signals) {
  finish_reduction();
  receive_releases();
  update_contact();
  external_forces();
  joint_forces();
  contact_forces();
  sent_signals_ = signals;
  begin_reduction();
  Field<double> velocity_before;
  if (sample) velocity_before = state_.velocity;
  const SweepArgs args = sweep_args(sample);
  remember_held();
  move(args);
  finish_motion(args);
  activate_crossing();
  if (sample) agree_on_failure();
  if (sample) take_budget(velocity_before);
  return_elastic();
  book_after(sample);
  receive_proxies();
  std::swap(state_.position, state_.next_position);
  time_ += dt_;
  dt_earlier_ = dt_before_;
  dt_before_ = dt_;
  ++steps_;
}

void Stepper::external_forces() {
  const auto lap = timer_.measure(Phase::loads);
  forces_.clear();
  for (PressureLoad& p : pressures_) p.apply(model_.local, state_, time_, dt_before_, forces_);
  for (std::size_t i = 0; i < 3; ++i) gravity_now_[i] = gravity_[i](time_);
  gravity_work_.advance(model_.local, state_, Vec3(gravity_now_[0], gravity_now_[1], gravity_now_[2]), dt_before_);
}

void Stepper::joint_forces() {
  const auto lap = timer_.measure(Phase::joints);
  active_joint_forces(model_.joint_laws, model_.local, state_.position.data(), time_, simd_, active_, forces_,
                      joint_work_);
  broken_joints_ += static_cast<std::int64_t>(joint_work_.failed.size());
  for (const ReleasedJoint& joint : joint_work_.released) {
    if (!model_.local.is_original(joint.slot_a)) continue;
    released_.push_back(joint);
    releasing_.push_back(joint.id);
  }
}

void Stepper::contact_forces() {
  if (!contact_) return;
  const auto lap = timer_.measure(Phase::contact);
  contact_->forces(state_, dt_before_, forces_, contact_work_);
}

/// An element's limit is that of its weakest joint: whether this one has left its elastic range is seen here, alike
/// from both sides, since only one of them may be swept on this rank.
void Stepper::crossing(void* context, Index slot, int face, double* force) {
  auto& self = *static_cast<Stepper*>(context);
  const Index id = self.joint_of_face_[at(slot) * 4 + static_cast<std::size_t>(face)];
  const ActiveJoint virgin = self.make_active(at(id));
  const JointLawParams& law = self.model_.joint_laws[at(virgin.law)];
  const double* x = self.state_.position.data();
  if (!(largest_opening_squared(self.model_.local, x, virgin) > law.screen_limit())) return;
  virgin_forces(law, self.model_.local, x, virgin, virgin.slot_a == slot, force);
  self.crossed_.push_back(at(id));
}

void Stepper::activate_crossing() {
  if (crossed_.empty()) return;
  const auto lap = timer_.measure(Phase::joints);
  std::sort(crossed_.begin(), crossed_.end());
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
  std::vector<ActiveJoint> batch;
  for (const std::size_t joint_index : crossed_) {
    batch.push_back(make_active(joint_index));
    const ActiveJoint& joint = batch.back();
    links_.detach(joint.slot_a, joint.face_a);
    links_.detach(joint.slot_b, joint.code / 3);
  }
  crossed_.clear();
  start_history(model_.joint_laws, model_.local, state_.position.data(), batch);
  active_.insert(batch);
}

/// Joints that are as if nothing had happened go back to the sweep, which has them far cheaper.
void Stepper::return_elastic() {
  const auto lap = timer_.measure(Phase::joints);
  const Index end = model_.local.num_own_slots;  // the sweep looks across the faces of these only
  std::vector<GlobalId> ids;
  for (const ElasticJoint& joint : joint_work_.elastic) {
    if (joint.slot_a >= end || joint.slot_b >= end) continue;
    links_.attach(joint.slot_a, joint.face_a, joint.slot_b, joint.code);
    ids.push_back(joint.id);
  }
  active_.erase(ids);
}

void Stepper::book_after(bool sample) {
  const auto lap = timer_.measure(Phase::loads);
  for (PressureLoad& p : pressures_) p.book_after(model_.local, state_, dt_);
  constraints_.book_after(dt_);
  if (!sample) return;
  const auto merge = [](Field<double>& work, const Field<double>& late) {
    for (std::size_t i = 0; i < work.size(); ++i) work[i] += late[i];
  };
  merge(viscous_, viscous_late_);
  merge(stress_work_, stress_work_late_);
  merge(damping_, damping_late_);
}

}  // namespace breccia
