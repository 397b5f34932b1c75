#include "observe/observe.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.hpp"
#include "domains/motion_limit.hpp"
#include "mesh/tetrahedron.hpp"
#include "model/parameters.hpp"
#include "observe/frames.hpp"
#include "parallel/totals.hpp"
#include "physics/cauchy_stress.hpp"
#include "physics/energy.hpp"

namespace breccia {
namespace {

ExactSum sum_of_stress_yy(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  ExactSum sum;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (!local.is_original(s)) continue;
    const ElasticParams& params = domain.model.elastic[at(local.block_group[at(s / kLanes)])];
    const double* x = domain.state.nodes.position.data();
    sum.add(std::abs(cauchy_stress(local, params, s, x, nullptr, material_memory(domain.state.elements))(1, 1)));
  }
  return sum;
}

/// Number and area of the joints that have failed, by their mode: this rank's, or those of all ranks.
struct BrokenJoints {
  std::int64_t mode_1 = 0, mode_2 = 0;
  ExactSum area, area_mode_1, area_mode_2;

  void add(FailureMode mode, double of_joint) {
    area.add(of_joint);
    if (mode == FailureMode::mode_1) ++mode_1, area_mode_1.add(of_joint);
    if (mode == FailureMode::mode_2) ++mode_2, area_mode_2.add(of_joint);
  }
};

/// Adds up this rank's counts over all ranks.
void count_joints(const Domain& domain, HistoryRow& row) {
  const Model& model = domain.model;
  // Not that of the model's joint: where the faces have flown apart, the element on the other side may not be here.
  const auto area_of = [&](Index slot, int face) {
    return geometry::face_area(model.mesh, model.local.mesh_element[at(slot)], face);
  };
  BrokenJoints broken;
  for (const ActiveJoint& joint : domain.state.joints.active) {
    if (!domain.model.local.is_original(joint.slot_a)) continue;
    const bool failed = joint.state() == JointState::failed;
    if (joint.damage() > 0 || failed) ++row.damaged_joints;
    if (failed) broken.add(joint.mode(), area_of(joint.slot_a, joint.face_a));
  }
  for (const ReleasedJoint& joint : domain.state.joints.released)
    broken.add(joint.mode, area_of(joint.slot_a, joint.face_a));
  row.damaged_joints += static_cast<std::int64_t>(domain.state.joints.released.size());
  if (domain.contact) {
    const ContactState& contact = domain.state.contact;
    row.couples = std::count_if(contact.couples.begin(), contact.couples.end(), [&](const ContactCouple& c) {
      return domain.model.local.is_original(contact.points[at(c.point)].slot);
    });
    row.contacts = domain.state.work.contact.touching;
  }
  std::array counts{domain.state.joints.broken, broken.mode_1, broken.mode_2,
                    row.damaged_joints,         row.couples,   row.contacts};
  domain.exchange.communicator().sum(counts);
  row.broken_joints = counts[0];
  row.broken_mode_1 = counts[1];
  row.broken_mode_2 = counts[2];
  row.damaged_joints = counts[3];
  row.couples = counts[4];
  row.contacts = counts[5];
  const std::vector<double> areas =
      totals(domain.exchange.communicator(), std::array{broken.area, broken.area_mode_1, broken.area_mode_2});
  row.broken_area = areas[0];
  row.broken_area_mode_1 = areas[1];
  row.broken_area_mode_2 = areas[2];
}

}  // namespace

void Observer::begin_stage(const case_::Stage& stage) {
  stage_ = &stage;
  make_gauges();
}

/// The groups' nodes on this rank as it is now.
void Observer::make_gauges() {
  gauged_ = partition_.decompositions();
  gauges_ = breccia::make_gauges(partition_.model(), input_.output.gauges, *stage_);
  point_gauges_.find(partition_.domain());
}

HistoryRow Observer::row(double time) {
  if (gauged_ != partition_.decompositions()) make_gauges();
  const Domain& domain = partition_.domain();
  HistoryRow row;
  row.step = domain.state.clock.steps - 1;
  row.time = time;
  row.time_step = domain.state.clock.dt;
  row.energy = domain.sample.budget;
  count_joints(domain, row);
  row.fragments = num_fragments();
  const Momentum p =
      momentum(domain.model.local, domain.state.nodes.position.data(), domain.state.nodes.velocity.data());
  const std::vector<double> sums =
      totals(domain.exchange.communicator(), std::array{p.linear[0], p.linear[1], p.linear[2], p.angular[0],
                                                        p.angular[1], p.angular[2], sum_of_stress_yy(domain)});
  row.momentum = {sums[0], sums[1], sums[2]};
  row.angular_momentum = {sums[3], sums[4], sums[5]};
  row.stress_yy_sum = sums[6];
  row.max_speed = domain.exchange.communicator().max(fastest_node(domain).speed);
  row.gauges = read_gauges(domain, gauges_);
  row.at_points = point_gauges_.read(domain);
  return row;
}

Frame Observer::picture(std::int64_t number, const FrameParts& parts) {
  static const Fragments no_fragments;
  static const std::vector<SurfaceFace> no_faces;
  const bool labelled = parts.elements || parts.surface;
  return make_frame(
      partition_.domain(), number, parts,
      {labelled ? labels() : no_fragments, parts.surface ? fragments_.free_faces(partition_.domain()) : no_faces,
       labelled ? partition_.costs() : std::vector<double>{}, partition_.load()});
}

}  // namespace breccia
