#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "simulation/stepper.hpp"

/// The part of Stepper that hands its elements over to the next decomposition and takes them from the last.
namespace breccia {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::array<double, 3> array_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

ElementRecord bare_record(const Model& model, Index element) {
  const Mesh& mesh = model.mesh;
  ElementRecord record;
  record.id = mesh.element_id(element);
  record.source_id = mesh.element_source_id[at(element)];
  record.group = mesh.element_group[at(element)];
  record.body = mesh.element_body[at(element)];
  for (std::size_t c = 0; c < 4; ++c) {
    const Index node = mesh.elements[at(element)][c];
    record.vertex[c] = mesh.node_id(node);
    record.reference[c] = array_of(mesh.nodes[at(node)]);
  }
  for (std::size_t f = 0; f < 4; ++f) {
    // An element beyond the piece can be one that has broken off and left: for what remains, the face is simply free.
    const FaceLink& link = model.topology.links[at(element)][f];
    record.neighbour[f] = link.inner() ? mesh.element_id(link.neighbour) : -1;
    record.code[f] = link.inner() ? link.code : std::int8_t{0};
  }
  return record;
}

/// Tags of an original element in a list that ascends by element.
template <class Tag>
void append_tags(const std::vector<Tag>& tags, GlobalId element, std::size_t& next, std::vector<Tag>& chosen) {
  while (next < tags.size() && tags[next].element < element) ++next;
  for (; next < tags.size() && tags[next].element == element; ++next) chosen.push_back(tags[next]);
}

std::vector<FaceTag> face_tags(const Model& model) {
  std::vector<FaceTag> tags;
  for (std::size_t g = 0; g < model.topology.surface_groups.size(); ++g) {
    for (const Topology::Face& face : model.topology.surface_groups[g]) {
      tags.push_back({model.mesh.element_id(face.element), static_cast<Index>(g), face.face});
    }
  }
  std::stable_sort(tags.begin(), tags.end(), [](const FaceTag& p, const FaceTag& q) { return p.element < q.element; });
  return tags;
}

}  // namespace

Stepper::Stepper(const Model& model, const ContactSearchParams& search, const Records& records,
                 Accumulators accumulators)
    : Stepper(model, nullptr) {
  time_ = accumulators.time;
  dt_ = accumulators.dt;
  dt_before_ = accumulators.dt_before;
  max_speed_ = accumulators.max_speed;
  steps_ = accumulators.steps;
  crushed_ = accumulators.crushed;
  broken_joints_ = accumulators.broken_joints;
  searches_before_ = accumulators.searches;
  past_external_ = std::move(accumulators.past_external);
  signals_ = accumulators.signals;
  sent_signals_ = accumulators.pending_signals;
  releasing_ = std::move(accumulators.released);
  messages_ = accumulators.messages;
  bytes_ = accumulators.bytes;
  joint_work_ = std::move(accumulators.joint_work);
  contact_work_ = std::move(accumulators.contact_work);
  first_total_ = accumulators.first_total;
  budget_ = accumulators.budget;
  timer_ = accumulators.timer;
  restore_elements(records);
  restore_joints(records);
  gravity_work_ = GravityWork(accumulators.gravity, model.local, state_.position);
  if (model.has_contact) contact_ = std::make_unique<ContactSearch>(search, model, records);
}

void Stepper::restore_elements(const Records& records) {
  const LocalMesh& local = model_.local;
  for (std::size_t e = 0; e < records.elements.size(); ++e) {
    const ElementRecord& record = records.elements[e];
    const Index slot = local.slot_of_element[e];
    if (viscous_on_) viscous_[at(slot)] = record.viscous;
    if (stress_work_on_) stress_work_[at(slot)] = record.stress_work;
    const bool damped = std::any_of(record.damping.begin(), record.damping.end(), [](double w) { return w != 0; });
    if (damped) damping_.resize(at(local.num_nodes));
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      store_node(state_.position.data(), node, vector_of(record.position[at(c)]));
      store_node(state_.velocity.data(), node, vector_of(record.velocity[at(c)]));
      if (!damping_.empty()) damping_[at(node)] = record.damping[at(c)];
    }
  }
  state_.next_position = state_.position;
}

void Stepper::restore_joints(const Records& records) {
  const LocalMesh& local = model_.local;
  std::vector<ActiveJoint> active;
  for (const JointRecord& record : records.joints) {
    const Index a = records.place_of(record.element), b = records.place_of(record.other);
    if (b < 0) continue;  // joins a proxy to an element that is nobody's concern here
    ActiveJoint joint = record.joint;
    joint.slot_a = local.slot_of_element[at(a)];
    joint.slot_b = local.slot_of_element[at(b)];
    if (relevant(joint.slot_a) || relevant(joint.slot_b)) active.push_back(joint);
  }
  active_.insert(active);
  for (const ActiveJoint& joint : active_) {
    detach(joint.slot_a, joint.face_a);
    detach(joint.slot_b, joint.code / 3);
  }
  for (const ReleasedRecord& record : records.released) {
    const Index slot = local.slot_of_element[at(records.place_of(record.element))];
    const Index joint = joint_of_face_[at(slot) * 4 + at(record.joint.face_a)];
    if (joint >= 0) {
      const JointFace& face = model_.joints[at(joint)].face;
      detach(slot, face.face_a);
      detach(local.slot_of_element[at(face.b)], face.code / 3);
    }
    if (!local.is_original(slot)) continue;
    released_.push_back(record.joint);
    released_.back().slot_a = slot;
  }
}

void Stepper::detach(Index slot, int face) {
  if (slot < model_.local.num_own_slots) links_.detach(slot, face);
}

Records Stepper::records() const {
  const LocalMesh& local = model_.local;
  Records records;
  const std::vector<FaceTag> faces = face_tags(model_);
  std::size_t next_face = 0, next_corner = 0;
  records.elements.reserve(at(model_.mesh.num_elements()));
  for (Index e = 0; e < model_.mesh.num_elements(); ++e) {
    const Index slot = local.slot_of_element[at(e)];
    if (!local.is_original(slot)) continue;
    ElementRecord record = bare_record(model_, e);
    if (viscous_on_) record.viscous = viscous_[at(slot)];
    if (stress_work_on_) record.stress_work = stress_work_[at(slot)];
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      record.position[at(c)] = array_of(load_node(state_.position.data(), node));
      record.velocity[at(c)] = array_of(load_node(state_.velocity.data(), node));
      if (!damping_.empty()) record.damping[at(c)] = damping_[at(node)];
    }
    if (contact_) contact_->remember(e, record, records);
    append_tags(faces, record.id, next_face, records.faces);
    append_tags(model_.corner_tags, record.id, next_corner, records.corners);
    records.elements.push_back(record);
  }
  remember_joints(records);
  remember_holds(records);
  return records;
}

void Stepper::remember_joints(Records& records) const {
  const LocalMesh& local = model_.local;
  for (const ActiveJoint& joint : active_) {
    if (!local.is_original(joint.slot_a)) continue;
    records.joints.push_back({local.element_of_slot[at(joint.slot_a)], local.element_of_slot[at(joint.slot_b)], joint});
  }
  for (const ReleasedJoint& joint : released_)
    records.released.push_back({local.element_of_slot[at(joint.slot_a)], joint});
  std::stable_sort(records.released.begin(), records.released.end(),
                   [](const ReleasedRecord& p, const ReleasedRecord& q) { return p.element < q.element; });
}

/// A shared node is remembered by each of its elements.
void Stepper::remember_holds(Records& records) const {
  const LocalMesh& local = model_.local;
  std::vector<Constraints::Anchor> anchors = constraints_.anchors();
  if (anchors.empty()) return;
  std::sort(anchors.begin(), anchors.end(), [](const auto& p, const auto& q) { return p.node < q.node; });
  for (const ElementRecord& record : records.elements) {
    const Index slot = local.slot_of_element[at(element_with(record.id))];
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      auto anchor =
          std::lower_bound(anchors.begin(), anchors.end(), node, [](const auto& p, Index n) { return p.node < n; });
      for (; anchor != anchors.end() && anchor->node == node; ++anchor) {
        records.holds.push_back({record.id, static_cast<Index>(anchor->entry), static_cast<std::int8_t>(c),
                                 static_cast<std::int8_t>(anchor->axis), anchor->start, anchor->velocity});
      }
    }
  }
}

/// Index in the rank's mesh of an element that is there, or where it would stand.
Index Stepper::element_with(GlobalId id) const {
  const std::vector<GlobalId>& ids = model_.mesh.element_ids;
  return ids.empty() ? static_cast<Index>(id)
                     : static_cast<Index>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

void Stepper::restore_holds(const Records& records) {
  std::vector<Constraints::Anchor> anchors;
  for (const HoldRecord& record : records.holds) {
    const Index slot = model_.local.slot_of_element[at(records.place_of(record.element))];
    anchors.push_back(
        {at(record.entry), model_.local.corner_node(slot, record.corner), record.axis, record.start, record.velocity});
  }
  constraints_.restore(anchors);
}

Accumulators Stepper::close() {
  Accumulators accumulators;
  accumulators.signals = signals_;
  conclude();
  begin_stage({}, dt_);
  accumulators.time = time_;
  accumulators.dt = dt_;
  accumulators.dt_before = dt_before_;
  accumulators.max_speed = max_speed_;
  accumulators.steps = steps_;
  accumulators.crushed = crushed_;
  accumulators.broken_joints = broken_joints_;
  accumulators.searches = searches();
  accumulators.past_external = past_external_;
  accumulators.pending_signals = signals_;
  accumulators.released = releasing_;
  accumulators.messages = messages();
  accumulators.bytes = bytes();
  accumulators.gravity = gravity_work_.close(model_.local, state_.position);
  accumulators.joint_work = joint_work_;
  accumulators.contact_work = contact_work_;
  accumulators.first_total = first_total_;
  accumulators.budget = budget_;
  accumulators.timer = timer_;
  return accumulators;
}

}  // namespace breccia
