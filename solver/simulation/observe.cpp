#include "simulation/observe.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/tetrahedron.hpp"
#include "physics/cauchy_stress.hpp"
#include "simulation/reduction.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void append(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), {v[0], v[1], v[2]}); }

Vec3 centroid(const LocalMesh& local, const double* field, Index slot) {
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 4; ++c) sum += load_node(field, local.corner_node(slot, c));
  return 0.25 * sum;
}

void add_element(const Stepper& stepper, const Fragments& fragments, Index slot, Frame::Elements& out) {
  const LocalMesh& local = stepper.model().local;
  const double* x = stepper.state().position.data();
  const double* v = stepper.state().velocity.data();
  const Index group = local.block_group[at(slot / kLanes)];
  for (int c = 0; c < 4; ++c) append(out.points, load_node(x, local.corner_node(slot, c)));
  out.id.push_back(local.element_of_slot[at(slot)]);
  out.body.push_back(local.slot_body[at(slot)]);
  out.material.push_back(group);
  out.rank.push_back(stepper.communicator().rank());
  out.fragment.push_back(fragments.of_slot[at(slot)]);
  const Mat3 stress = cauchy_stress(local, stepper.model().elastic[at(group)], slot, x, v);
  const auto six = components(stress);
  out.stress.insert(out.stress.end(), six.begin(), six.end());
  out.von_mises.push_back(von_mises(stress));
  append(out.principal, principal_stresses(stress));
  append(out.velocity, centroid(local, v, slot));
  append(out.displacement, centroid(local, x, slot) - centroid(local, local.reference.data(), slot));
}

/// Triangle on the face of a.
void add_released_joint(const Stepper& stepper, const ReleasedJoint& joint, Frame::Joints& out) {
  const LocalMesh& local = stepper.model().local;
  for (const int corner : kFaceCorners[at(joint.face_a)]) {
    append(out.points, load_node(stepper.state().position.data(), local.corner_node(joint.slot_a, corner)));
  }
  out.id.push_back(joint.id);
}

/// Triangle halfway between the two faces of a joint that is still held.
void add_active_joint(const Stepper& stepper, const ActiveJoint& joint, Frame::Joints& out) {
  const LocalMesh& local = stepper.model().local;
  const double* x = stepper.state().position.data();
  for (int i = 0; i < 3; ++i) {
    const Vec3 on_a = load_node(x, local.corner_node(joint.slot_a, kFaceCorners[at(joint.face_a)][at(i)]));
    const Vec3 on_b = load_node(x, local.corner_node(joint.slot_b, matching_corner(joint.code, i)));
    append(out.points, Vec3(0.5 * (on_a + on_b)));
  }
  out.id.push_back(joint.id);
}

void add_joints(const Stepper& stepper, Frame::Joints& out) {
  std::vector<ReleasedJoint> released = stepper.released_joints();
  std::sort(released.begin(), released.end(), [](const ReleasedJoint& p, const ReleasedJoint& q) { return p.id < q.id; });
  const auto add_released = [&](const ReleasedJoint& joint) {
    add_released_joint(stepper, joint, out);
    out.damage.push_back(1.0);
    out.mode.push_back(static_cast<std::int32_t>(joint.mode));
    out.opening.push_back(0.0);  // its faces have parted: there is no opening left to speak of
    out.slip.push_back(0.0);
    out.broken.push_back(1);
    out.time_of_failure.push_back(joint.time_of_failure);
    out.state.push_back(Frame::Joints::apart);
  };
  auto next = released.begin();
  for (const ActiveJoint& joint : stepper.active_joints()) {
    for (; next != released.end() && next->id < joint.id; ++next) add_released(*next);
    if (joint.damage() <= 0 || !stepper.model().local.is_original(joint.slot_a)) continue;
    add_active_joint(stepper, joint, out);
    out.damage.push_back(joint.damage());
    out.mode.push_back(static_cast<std::int32_t>(joint.mode()));
    out.opening.push_back(joint.opening());
    out.slip.push_back(joint.slip());
    const bool broken = joint.state == JointState::failed;
    out.broken.push_back(broken ? 1 : 0);
    out.time_of_failure.push_back(joint.time_of_failure);
    out.state.push_back(broken ? Frame::Joints::failed : Frame::Joints::softening);
  }
  for (; next != released.end(); ++next) add_released(*next);
}

void add_contacts(const Stepper& stepper, Frame::Contacts& out) {
  if (stepper.contact() == nullptr) return;
  const LocalMesh& local = stepper.model().local;
  const ContactState& contact = stepper.contact()->contact();
  const FaceRule& rule = face_rule(stepper.model().contact.points_per_face);
  const double* x = stepper.state().position.data();
  for (const TouchingCouple& couple : contact.touching) {
    const ContactPoint& point = contact.points[at(couple.point)];
    if (couple.force.squaredNorm() == 0.0 || !local.is_original(point.slot)) continue;
    out.id.push_back(point.id);
    append(out.points, at_point(rule, point, x));
    append(out.force, couple.force);
    out.body.push_back(local.slot_body[at(point.slot)]);
    out.other_body.push_back(local.slot_body[at(contact.contactors[at(couple.contactor)])]);
  }
}

/// What a gauge reads on this rank, as sums: reaction, contact force, displacement and velocity of the nodes, their number.
class GaugeSums {
 public:
  static constexpr std::size_t kCount = 13;

  GaugeSums(const Stepper& stepper, const Gauge& gauge) {
    const LocalMesh& local = stepper.model().local;
    for (const std::size_t entry : gauge.constraints) add(0, stepper.constraints().reaction(entry));
    if (gauge.volume_group >= 0 && stepper.contact() != nullptr) {
      add(3, contact_force_on_group(stepper.contact()->contact(), local, gauge.volume_group));
    }
    const double* x = stepper.state().position.data();
    for (const Index node : gauge.nodes) {
      add(6, load_node(x, node) - load_node(local.reference.data(), node));
      add(9, load_node(stepper.state().velocity.data(), node));
    }
    sums_[12].add(static_cast<double>(gauge.nodes.size()));
  }
  [[nodiscard]] const std::array<ExactSum, kCount>& sums() const { return sums_; }

 private:
  void add(std::size_t first, const std::array<ExactSum, 3>& vector) {
    for (std::size_t i = 0; i < 3; ++i) sums_[first + i].add(vector[i]);
  }
  void add(std::size_t first, const Vec3& vector) {
    for (std::size_t i = 0; i < 3; ++i) sums_[first + i].add(vector[static_cast<Eigen::Index>(i)]);
  }
  std::array<ExactSum, kCount> sums_;
};

/// Largest displacements of a gauge's nodes, upwards and downwards by axis, m.
std::array<double, 6> extremes(const Stepper& stepper, const Gauge& gauge) {
  std::array<double, 6> most{};
  for (const Index node : gauge.nodes) {
    const Vec3 displacement = load_node(stepper.state().position.data(), node) - load_node(stepper.model().local.reference.data(), node);
    for (std::size_t i = 0; i < 3; ++i) {
      most[2 * i] = std::max(most[2 * i], displacement[static_cast<Eigen::Index>(i)]);
      most[2 * i + 1] = std::max(most[2 * i + 1], -displacement[static_cast<Eigen::Index>(i)]);
    }
  }
  return most;
}

std::vector<GaugeReading> read_gauges(const Stepper& stepper, const std::vector<Gauge>& gauges) {
  std::vector<ExactSum> parts;
  std::vector<double> most;
  for (const Gauge& gauge : gauges) {
    const GaugeSums of_gauge(stepper, gauge);
    parts.insert(parts.end(), of_gauge.sums().begin(), of_gauge.sums().end());
    const auto of_nodes = extremes(stepper, gauge);
    most.insert(most.end(), of_nodes.begin(), of_nodes.end());
  }
  const std::vector<double> sums = totals(stepper.communicator(), parts);
  stepper.communicator().max(most);
  std::vector<GaugeReading> readings;
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const double* s = sums.data() + g * GaugeSums::kCount;
    const double* m = most.data() + g * 6;
    const double count = std::max(s[12], 1.0);
    GaugeReading reading;
    reading.reaction = {s[0], s[1], s[2]};
    reading.contact_force = {s[3], s[4], s[5]};
    reading.displacement = Vec3(s[6], s[7], s[8]) / count;
    reading.velocity = Vec3(s[9], s[10], s[11]) / count;
    for (int i = 0; i < 3; ++i) reading.max_displacement[i] = m[2 * i] >= m[2 * i + 1] ? m[2 * i] : -m[2 * i + 1];
    readings.push_back(reading);
  }
  return readings;
}

ExactSum sum_of_stress_yy(const Stepper& stepper) {
  const LocalMesh& local = stepper.model().local;
  ExactSum sum;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (!local.is_original(s)) continue;
    const ElasticParams& params = stepper.model().elastic[at(local.block_group[at(s / kLanes)])];
    sum.add(std::abs(cauchy_stress(local, params, s, stepper.state().position.data(), nullptr)(1, 1)));
  }
  return sum;
}

/// Adds up this rank's counts over all ranks.
void count_joints(const Stepper& stepper, HistoryRow& row) {
  const auto count_mode = [&](FailureMode mode) {
    if (mode == FailureMode::mode_1) ++row.broken_mode_1;
    if (mode == FailureMode::mode_2) ++row.broken_mode_2;
  };
  row.broken_joints = stepper.broken_joints();
  for (const ActiveJoint& joint : stepper.active_joints()) {
    if (!stepper.model().local.is_original(joint.slot_a)) continue;
    if (joint.damage() > 0) ++row.damaged_joints;
    if (joint.state == JointState::failed) count_mode(joint.mode());
  }
  for (const ReleasedJoint& joint : stepper.released_joints()) count_mode(joint.mode);
  row.damaged_joints += static_cast<std::int64_t>(stepper.released_joints().size());
  if (stepper.contact() != nullptr) {
    const ContactState& contact = stepper.contact()->contact();
    row.couples = std::count_if(contact.couples.begin(), contact.couples.end(), [&](const ContactCouple& c) {
      return stepper.model().local.is_original(contact.points[at(c.point)].slot);
    });
    row.contacts = stepper.contact_work().touching;
  }
  std::array counts{row.broken_joints, row.broken_mode_1, row.broken_mode_2, row.damaged_joints, row.couples, row.contacts};
  stepper.communicator().sum(counts);
  row.broken_joints = counts[0];
  row.broken_mode_1 = counts[1];
  row.broken_mode_2 = counts[2];
  row.damaged_joints = counts[3];
  row.couples = counts[4];
  row.contacts = counts[5];
}

}  // namespace

Frame make_frame(const Stepper& stepper, std::int64_t number, const FrameParts& parts, std::vector<double> cost) {
  Frame frame;
  frame.step = stepper.steps();
  frame.time = stepper.time();
  frame.number = number;
  const LocalMesh& local = stepper.model().local;
  if (parts.elements) {
    const Fragments fragments = find_fragments(stepper);
    for (const Index slot : local.slot_of_element) {
      if (local.is_original(slot)) add_element(stepper, fragments, slot, frame.elements);
    }
    frame.elements.cost = std::move(cost);
  }
  if (parts.joints) add_joints(stepper, frame.joints);
  if (parts.contacts) add_contacts(stepper, frame.contacts);
  return frame;
}

HistoryRow make_history_row(const Stepper& stepper, const std::vector<Gauge>& gauges, double time) {
  HistoryRow row;
  row.step = stepper.steps();
  row.time = time;
  row.time_step = stepper.dt();
  row.energy = stepper.budget();
  count_joints(stepper, row);
  row.fragments = find_fragments(stepper).count;
  const Momentum p = momentum(stepper.model().local, stepper.state().position.data(), stepper.state().velocity.data());
  const std::vector<double> sums = totals(stepper.communicator(), std::array{p.linear[0], p.linear[1], p.linear[2], p.angular[0],
                                                                             p.angular[1], p.angular[2], sum_of_stress_yy(stepper)});
  row.momentum = {sums[0], sums[1], sums[2]};
  row.angular_momentum = {sums[3], sums[4], sums[5]};
  row.stress_yy_sum = sums[6];
  row.max_speed = stepper.communicator().max(stepper.max_speed());
  row.gauges = read_gauges(stepper, gauges);
  return row;
}

StateHash hash_of(const Stepper& stepper) {
  const LocalMesh& local = stepper.model().local;
  StateHash mine = hash_elements(local, stepper.state());
  for (const ActiveJoint& joint : stepper.active_joints()) {
    if (!local.is_original(joint.slot_a)) continue;
    SequenceHash hash;
    hash.add(static_cast<std::uint64_t>(joint.id));
    for (const JointPointHistory& p : joint.points) {
      hash.add(p.damage);
      for (const double slip : p.slip) hash.add(slip);
    }
    mine.add(hash);
  }
  if (stepper.contact() != nullptr) {
    const ContactState& contact = stepper.contact()->contact();
    for (const TouchingCouple& c : contact.touching) {
      if (!local.is_original(contact.points[at(c.point)].slot)) continue;
      SequenceHash hash;
      hash.add(static_cast<std::uint64_t>(contact.id(c.point)));
      hash.add(static_cast<std::uint64_t>(local.element_of_slot[at(contact.contactors[at(c.contactor)])]));
      for (const double number : {c.d, c.d_max, c.offset, c.spring[0], c.spring[1], c.spring[2]}) hash.add(number);
      mine.add(hash);
    }
  }
  StateHash all;
  const std::uint64_t sum = mine.value();
  for (const auto& part : stepper.communicator().all_gather(std::span<const std::uint64_t>(&sum, 1))) all.add(StateHash(part[0]));
  return all;
}

}  // namespace breccia
