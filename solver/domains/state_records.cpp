#include "domains/state_records.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "domains/mesh_records.hpp"
#include "parallel/totals.hpp"

namespace breccia {
namespace {

Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
std::array<double, 3> array_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// The element with its state; what belongs to it in the lists of contact and constraints is appended to `lists`.
class ElementCollector {
 public:
  explicit ElementCollector(const Domain& domain) : domain_(domain), anchors_(domain.state.constraints.anchors()) {
    std::sort(anchors_.begin(), anchors_.end(), [](const auto& p, const auto& q) { return p.node < q.node; });
  }

  [[nodiscard]] ElementRecord record(Index element, Records& lists) const {
    const LocalMesh& local = domain_.model.local;
    const State& state = domain_.state;
    const Index slot = local.slot_of_element[at(element)];
    ElementRecord record = mesh_record(domain_.model.mesh, domain_.model.topology, element);
    record.torn = domain_.model.torn[at(element)];
    record.numbers = state.elements.of(slot);
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      record.position[at(c)] = array_of(load_node(state.nodes.position.data(), node));
      record.velocity[at(c)] = array_of(load_node(state.nodes.velocity.data(), node));
      if (!state.damping_work.empty()) record.damping[at(c)] = state.damping_work[at(node)];
      add_holds(record.id, node, c, lists.holds);
    }
    if (domain_.contact) domain_.contact->store(element, record, lists);
    return record;
  }

 private:
  /// A shared node is remembered by each of its elements.
  void add_holds(GlobalId element, Index node, int corner, std::vector<HoldRecord>& holds) const {
    auto anchor =
        std::lower_bound(anchors_.begin(), anchors_.end(), node, [](const auto& p, Index n) { return p.node < n; });
    for (; anchor != anchors_.end() && anchor->node == node; ++anchor) {
      holds.push_back({element, static_cast<Index>(anchor->entry), static_cast<std::int8_t>(corner),
                       static_cast<std::int8_t>(anchor->axis), anchor->start, anchor->velocity});
    }
  }

  const Domain& domain_;
  std::vector<Constraints::Anchor> anchors_;  ///< ascending nodes
};

/// Forces that hold the corners of elements.
class HeldCollector {
 public:
  explicit HeldCollector(const Domain& domain) : local_(domain.model.local), forces_(held_forces(domain)) {}

  /// A shared node is remembered by each of its elements.
  void add(Index element, GlobalId id, std::vector<HeldRecord>& held) const {
    for (int c = 0; c < 4; ++c) {
      const Index node = local_.corner_node(local_.slot_of_element[at(element)], c);
      const auto force = std::lower_bound(forces_.begin(), forces_.end(), node,
                                          [](const NodeForce& f, Index n) { return f.node < n; });
      if (force == forces_.end() || force->node != node) continue;
      held.push_back({id, static_cast<std::int8_t>(c), array_of(force->force)});
    }
  }

 private:
  const LocalMesh& local_;
  std::vector<NodeForce> forces_;  ///< ascending nodes
};

/// Calls visit(record) for the joints of this rank's originals that the sweep does not evaluate.
template <class Visit>
void for_each_joint_record(const Domain& domain, Visit&& visit) {
  const LocalMesh& local = domain.model.local;
  for (const ActiveJoint& joint : domain.state.joints.active) {
    if (!local.is_original(joint.slot_a)) continue;
    visit(JointRecord{local.element_of_slot[at(joint.slot_a)], local.element_of_slot[at(joint.slot_b)], joint});
  }
  for (const ReleasedJoint& joint : domain.state.joints.released)
    visit(ReleasedRecord{local.element_of_slot[at(joint.slot_a)], joint});
}

}  // namespace

Records records_of(const Domain& domain) {
  const Model& model = domain.model;
  Records records;
  const ElementCollector collector(domain);
  const HeldCollector held(domain);
  const std::vector<FaceTag> faces = face_tags(model.mesh, model.topology);
  std::size_t next_face = 0, next_corner = 0;
  records.elements.reserve(at(model.mesh.num_elements()));
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    if (!model.local.is_original(model.local.slot_of_element[at(e)])) continue;
    const ElementRecord record = collector.record(e, records);
    append_tags(faces, record.id, next_face, records.faces);
    const std::size_t untagged = records.corners.size();
    append_tags(model.corner_tags, record.id, next_corner, records.corners);
    if (records.corners.size() > untagged) held.add(e, record.id, records.held);  // others are on no absorbing surface
    records.elements.push_back(record);
  }
  for_each_joint_record(domain, [&](const auto& record) {
    if constexpr (std::is_same_v<std::decay_t<decltype(record)>, JointRecord>) {
      records.joints.push_back(record);
    } else {
      records.released.push_back(record);
    }
  });
  std::stable_sort(records.released.begin(), records.released.end(),
                   [](const ReleasedRecord& p, const ReleasedRecord& q) { return p.element < q.element; });
  return records;
}

namespace {

void restore_elements(const Records& records, const LocalMesh& local, State& state) {
  for (std::size_t e = 0; e < records.elements.size(); ++e) {
    const ElementRecord& record = records.elements[e];
    const Index slot = local.slot_of_element[e];
    state.elements.set(slot, record.numbers);
    const bool damped = std::any_of(record.damping.begin(), record.damping.end(), [](double w) { return w != 0; });
    if (damped) state.damping_work.resize(at(local.num_nodes));
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      store_node(state.nodes.position.data(), node, vector_of(record.position[at(c)]));
      store_node(state.nodes.velocity.data(), node, vector_of(record.velocity[at(c)]));
      if (!state.damping_work.empty()) state.damping_work[at(node)] = record.damping[at(c)];
    }
  }
  state.nodes.next_position = state.nodes.position;
}

void restore_held(const Records& records, const LocalMesh& local, State& state) {
  for (const HeldRecord& record : records.held) {
    const Index slot = local.slot_of_element[at(records.place_of(record.element))];
    const Index node = local.corner_node(slot, record.corner);
    if (local.is_moved(node)) state.held.push_back({node, vector_of(record.force)});
  }
  const auto before = [](const NodeForce& a, const NodeForce& b) { return a.node < b.node; };
  std::stable_sort(state.held.begin(), state.held.end(), before);
  const auto same = [](const NodeForce& a, const NodeForce& b) { return a.node == b.node; };
  state.held.erase(std::unique(state.held.begin(), state.held.end(), same), state.held.end());
  state.held_before = state.clock.steps;
}

void restore_active(const Records& records, const Model& model, JointSet& joints, Derived& derived) {
  const LocalMesh& local = model.local;
  const auto detach = [&](Index slot, int face) {
    if (slot < local.num_own_slots) derived.links.detach(slot, face);
  };
  std::vector<ActiveJoint> active;
  for (const JointRecord& record : records.joints) {
    const Index a = records.place_of(record.element), b = records.place_of(record.other);
    if (b < 0) continue;  // joins a proxy to an element that no force here depends on
    ActiveJoint joint = record.joint;
    joint.slot_a = local.slot_of_element[at(a)];
    joint.slot_b = local.slot_of_element[at(b)];
    if (derived.is_relevant(joint.slot_a) || derived.is_relevant(joint.slot_b)) active.push_back(joint);
  }
  joints.active.insert(active);
  for (const ActiveJoint& joint : active) {
    detach(joint.slot_a, joint.face_a);
    detach(joint.slot_b, joint.code / 3);
  }
  for (const ReleasedRecord& record : records.released) {
    const Index slot = local.slot_of_element[at(records.place_of(record.element))];
    const Index joint = derived.joint_at(slot, record.joint.face_a);
    if (joint >= 0) {
      const JointFace& face = model.joints[at(joint)].face;
      detach(slot, face.face_a);
      detach(local.slot_of_element[at(face.b)], face.code / 3);
    }
    if (!local.is_original(slot)) continue;
    joints.released.push_back(record.joint);
    joints.released.back().slot_a = slot;
  }
}

}  // namespace

void restore(const Records& records, const Model& model, State& state, Derived& derived) {
  restore_elements(records, model.local, state);
  restore_held(records, model.local, state);
  restore_active(records, model, state.joints, derived);
}

void restore_holds(Domain& domain, const Records& records) {
  const LocalMesh& local = domain.model.local;
  std::vector<Constraints::Anchor> anchors;
  for (const HoldRecord& record : records.holds) {
    const Index slot = local.slot_of_element[at(records.place_of(record.element))];
    anchors.push_back(
        {at(record.entry), local.corner_node(slot, record.corner), record.axis, record.start, record.velocity});
  }
  domain.state.constraints.restore(anchors);
}

namespace {

/// What the model's rows contribute: numbers that are alike on all ranks, totals of counts and of exact sums.
SequenceHash hash_of_model(const Domain& domain) {
  SequenceHash hash;
  const Communicator& communicator = domain.exchange.communicator();
  std::vector<ExactSum> sums{external_work(domain)};
  for_each_field(domain.state, [&](const auto& row, const auto& field) {
    using Value = std::decay_t<decltype(field)>;
    if (!row.use.hashed) return;
    if constexpr (std::is_same_v<Value, ExactSum>) {
      sums.push_back(field);
    } else if constexpr (std::is_same_v<Value, std::int64_t>) {
      hash.add(static_cast<std::uint64_t>(row.use.across == AcrossRanks::sum ? communicator.sum(field) : field));
    } else if constexpr (std::is_same_v<Value, double>) {
      hash.add(field);
    } else {
      DEMAND(false, std::string(row.name) + " cannot be hashed");
    }
  });
  for (const double total : totals(communicator, sums)) hash.add(total);
  return hash;
}

}  // namespace

StateHash hash_of(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  StateHash mine;
  const ElementCollector collector(domain);
  Records lists;
  for (Index e = 0; e < domain.model.mesh.num_elements(); ++e) {
    if (!local.is_original(local.slot_of_element[at(e)])) continue;
    mine.add(hash_of_record(collector.record(e, lists)));
    for_each_list(lists, [&](const char*, auto& list) {
      for (const auto& record : list) mine.add(hash_of_record(record));
      list.clear();
    });
  }
  for_each_joint_record(domain, [&](const auto& record) { mine.add(hash_of_record(record)); });
  StateHash all;
  const std::uint64_t sum = mine.value();
  for (const auto& part : domain.exchange.communicator().all_gather(std::span<const std::uint64_t>(&sum, 1)))
    all.add(StateHash(part[0]));
  all.add(hash_of_model(domain));
  return all;
}

}  // namespace breccia
