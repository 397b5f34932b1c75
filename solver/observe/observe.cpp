#include "observe/observe.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/tetrahedron.hpp"
#include "model/parameters.hpp"
#include "observe/frames.hpp"
#include "parallel/totals.hpp"
#include "physics/cauchy_stress.hpp"
#include "physics/energy.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// What a gauge reads on this rank, as sums: reaction, contact force, displacement and velocity of the nodes, their
/// number.
class GaugeSums {
 public:
  static constexpr std::size_t kCount = 13;

  GaugeSums(const Domain& domain, const Gauge& gauge) {
    const LocalMesh& local = domain.model.local;
    for (const std::size_t entry : gauge.constraints) add(0, domain.state.constraints.reaction(entry));
    if (gauge.volume_group >= 0 && domain.contact) {
      add(3, contact_force_on_group(domain.state.contact, local, gauge.volume_group));
    }
    const double* x = domain.state.nodes.position.data();
    for (const Index node : gauge.nodes) {
      add(6, load_node(x, node) - load_node(local.reference.data(), node));
      add(9, load_node(domain.state.nodes.velocity.data(), node));
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
std::array<double, 6> extremes(const Domain& domain, const Gauge& gauge) {
  std::array<double, 6> most{};
  for (const Index node : gauge.nodes) {
    const Vec3 displacement =
        load_node(domain.state.nodes.position.data(), node) - load_node(domain.model.local.reference.data(), node);
    for (std::size_t i = 0; i < 3; ++i) {
      most[2 * i] = std::max(most[2 * i], displacement[static_cast<Eigen::Index>(i)]);
      most[2 * i + 1] = std::max(most[2 * i + 1], -displacement[static_cast<Eigen::Index>(i)]);
    }
  }
  return most;
}

std::vector<GaugeReading> read_gauges(const Domain& domain, const std::vector<Gauge>& gauges) {
  std::vector<ExactSum> parts;
  std::vector<double> most;
  for (const Gauge& gauge : gauges) {
    const GaugeSums of_gauge(domain, gauge);
    parts.insert(parts.end(), of_gauge.sums().begin(), of_gauge.sums().end());
    const auto of_nodes = extremes(domain, gauge);
    most.insert(most.end(), of_nodes.begin(), of_nodes.end());
  }
  const std::vector<double> sums = totals(domain.exchange.communicator(), parts);
  domain.exchange.communicator().max(most);
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

/// Adds up this rank's counts over all ranks.
void count_joints(const Domain& domain, HistoryRow& row) {
  const auto count_mode = [&](FailureMode mode) {
    if (mode == FailureMode::mode_1) ++row.broken_mode_1;
    if (mode == FailureMode::mode_2) ++row.broken_mode_2;
  };
  row.broken_joints = domain.state.joints.broken;
  for (const ActiveJoint& joint : domain.state.joints.active) {
    if (!domain.model.local.is_original(joint.slot_a)) continue;
    if (joint.damage() > 0 || joint.state() == JointState::failed) ++row.damaged_joints;
    if (joint.state() == JointState::failed) count_mode(joint.mode());
  }
  for (const ReleasedJoint& joint : domain.state.joints.released) count_mode(joint.mode);
  row.damaged_joints += static_cast<std::int64_t>(domain.state.joints.released.size());
  if (domain.contact) {
    const ContactState& contact = domain.state.contact;
    row.couples = std::count_if(contact.couples.begin(), contact.couples.end(), [&](const ContactCouple& c) {
      return domain.model.local.is_original(contact.points[at(c.point)].slot);
    });
    row.contacts = domain.state.work.contact.touching;
  }
  std::array counts{row.broken_joints,  row.broken_mode_1, row.broken_mode_2,
                    row.damaged_joints, row.couples,       row.contacts};
  domain.exchange.communicator().sum(counts);
  row.broken_joints = counts[0];
  row.broken_mode_1 = counts[1];
  row.broken_mode_2 = counts[2];
  row.damaged_joints = counts[3];
  row.couples = counts[4];
  row.contacts = counts[5];
}

}  // namespace

void Observer::begin_stage(const case_::Stage& stage) {
  stage_ = &stage;
  make_gauges();
}

/// The groups' nodes on this rank as it is now.
void Observer::make_gauges() {
  gauges_.clear();
  gauged_ = partition_.decompositions();
  for (const std::string& group : input_.output.gauges) {
    Gauge gauge;
    gauge.group = group;
    gauge.nodes = counted_nodes_of_group(partition_.model(), group);
    const auto& names = partition_.model().mesh.volume_groups;
    const auto found = std::find(names.begin(), names.end(), group);
    if (found != names.end()) gauge.volume_group = static_cast<Index>(found - names.begin());
    for (std::size_t c = 0; c < stage_->constraints.size(); ++c) {
      if (stage_->constraints[c].group == gauge.group) gauge.constraints.push_back(c);
    }
    gauges_.push_back(std::move(gauge));
  }
}

HistoryRow Observer::row(double time) {
  if (gauged_ != partition_.decompositions()) make_gauges();
  const Domain& domain = partition_.domain();
  HistoryRow row;
  row.step = domain.state.clock.steps;
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
  row.max_speed = domain.exchange.communicator().max(domain.state.signals.max_speed);
  row.gauges = read_gauges(domain, gauges_);
  return row;
}

Frame Observer::picture(std::int64_t number, const FrameParts& parts) {
  static const Fragments none;
  const bool labelled = parts.elements || parts.surface;
  return make_frame(
      partition_.domain(), number, parts,
      {labelled ? labels() : none, labelled ? partition_.costs() : std::vector<double>{}, partition_.load()});
}

}  // namespace breccia
