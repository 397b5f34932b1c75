#include "observe/gauges.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/index.hpp"
#include "case/groups.hpp"
#include "model/parameters.hpp"
#include "parallel/totals.hpp"
#include "physics/kick.hpp"

namespace breccia {
namespace {

/// Moments of inertia below this share of the largest one are round-off.
constexpr double kNoInertia = 1e-12;

/// Some exact sums of a gauge on this rank.
class Sums {
 public:
  explicit Sums(std::size_t count) : sums_(count) {}
  void add(std::size_t first, const Vec3& vector) {
    for (std::size_t i = 0; i < 3; ++i) sums_[first + i].add(vector[static_cast<Eigen::Index>(i)]);
  }
  void add(std::size_t first, const std::array<ExactSum, 3>& vector) {
    for (std::size_t i = 0; i < 3; ++i) sums_[first + i].add(vector[i]);
  }
  void add_scalar(std::size_t place, double value) { sums_[place].add(value); }
  void append_to(std::vector<ExactSum>& all) const { all.insert(all.end(), sums_.begin(), sums_.end()); }

 private:
  std::vector<ExactSum> sums_;
};

Vec3 vector_at(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// The fields of the step that was sampled: x_n, v_(n-1/2), v_(n+1/2).
struct Motion {
  explicit Motion(const Domain& domain)
      : local(domain.model.local),
        place(domain.state.nodes.next_position.data()),  // position and next_position have been swapped since
        before(domain.scratch.velocity_before.data()),
        after(domain.state.nodes.velocity.data()),
        kick(kick_length(domain.state.clock.dt_earlier, domain.state.clock.dt_before)) {}

  [[nodiscard]] Vec3 x(Index node) const { return load_node(place, node); }
  [[nodiscard]] Vec3 v(Index node) const { return load_node(after, node); }
  [[nodiscard]] Vec3 acceleration(Index node) const { return (v(node) - load_node(before, node)) / kick; }
  [[nodiscard]] Vec3 displacement(Index node) const { return x(node) - load_node(local.reference.data(), node); }

  const LocalMesh& local;
  const double *place, *before, *after;
  double kick;  ///< s
};

/// Calls visit(nodes, mass of the gauge at each of them) for its elements, or the nodes of a surface: what one rank has
/// as a whole, so that sums over it do not depend on the number of ranks.
template <class Visit>
void for_each_carrier(const Domain& domain, const Gauge& gauge, Visit&& visit) {
  const LocalMesh& local = domain.model.local;
  if (gauge.is_surface()) {
    for (const Index node : gauge.nodes) visit(std::span(&node, 1), local.node_mass[at(node)]);
    return;
  }
  for (const Index slot : gauge.slots) {
    const std::array nodes{local.corner_node(slot, 0), local.corner_node(slot, 1), local.corner_node(slot, 2),
                           local.corner_node(slot, 3)};
    const double density = domain.model.density[at(local.block_group[at(slot / kLanes)])];
    visit(std::span<const Index>(nodes), 0.25 * density * local.volume[at(slot)]);
  }
}

bool holds(const LocalMesh& local, const Gauge& gauge, Index slot) {
  if (!gauge.members.empty()) return gauge.members[at(slot)] != 0;
  return gauge.body >= 0 ? local.slot_body[at(slot)] == gauge.body
                         : local.block_group[at(slot / kLanes)] == gauge.volume_group;
}

/// Reaction, contact force, momentum, mass times reference place, mass times displacement, resultant force; mass.
constexpr std::size_t kNumFirst = 19;

Sums first_sums(const Domain& domain, const Gauge& gauge) {
  Sums sums(kNumFirst);
  const LocalMesh& local = domain.model.local;
  const Constraints& constraints = domain.state.constraints;
  if (!gauge.is_surface()) sums.add(0, constraints.reaction_on(gauge.nodes));
  for (const std::size_t entry : gauge.constraints) sums.add(0, constraints.reaction(entry));
  if (!gauge.is_surface() && domain.contact) {
    sums.add(3, contact_force_on(domain.state.contact, local, [&](Index slot) { return holds(local, gauge, slot); }));
  }
  const Motion motion(domain);
  for_each_carrier(domain, gauge, [&](std::span<const Index> nodes, double mass) {
    Vec3 v = Vec3::Zero(), reference = v, displacement = v, a = v;
    for (const Index node : nodes) {
      v += motion.v(node);
      reference += load_node(local.reference.data(), node);
      displacement += motion.displacement(node);
      a += motion.acceleration(node);
    }
    sums.add(6, mass * v);
    sums.add(9, mass * reference);
    sums.add(12, mass * displacement);
    sums.add(15, mass * a);
    sums.add_scalar(18, mass * static_cast<double>(nodes.size()));
  });
  return sums;
}

/// Angular momentum and torque about the centre; the tensor of inertia about it: xx, yy, zz, xy, yz, zx of
/// sum m (r r), from which it is made.
constexpr std::size_t kNumSecond = 12;

Sums second_sums(const Domain& domain, const Gauge& gauge, const Vec3& centre) {
  Sums sums(kNumSecond);
  const Motion motion(domain);
  for_each_carrier(domain, gauge, [&](std::span<const Index> nodes, double mass) {
    Vec3 angular = Vec3::Zero(), torque = angular, squares = angular, products = angular;
    for (const Index node : nodes) {
      const Vec3 arm = motion.x(node) - centre;
      angular += arm.cross(motion.v(node));
      torque += arm.cross(motion.acceleration(node));
      squares += arm.cwiseProduct(arm);
      products += arm.cwiseProduct(Vec3(arm[1], arm[2], arm[0]));
    }
    sums.add(0, mass * angular);
    sums.add(3, mass * torque);
    sums.add(6, mass * squares);
    sums.add(9, mass * products);
  });
  return sums;
}

/// I^-1 L on the axes that have inertia. @param squares, products  sum m (xx, yy, zz), sum m (xy, yz, zx)
Vec3 spin_of(const Vec3& angular, const Vec3& squares, const Vec3& products) {
  Mat3 inertia = squares.sum() * Mat3::Identity();
  inertia.diagonal() -= squares;
  inertia(0, 1) = inertia(1, 0) = -products[0];
  inertia(1, 2) = inertia(2, 1) = -products[1];
  inertia(2, 0) = inertia(0, 2) = -products[2];
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
  Vec3 spin = Vec3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double moment = axes.eigenvalues()[i];
    if (!(moment > kNoInertia * axes.eigenvalues()[2])) continue;
    const Vec3 axis = axes.eigenvectors().col(i);
    spin += axis.dot(angular) / moment * axis;
  }
  return spin;
}

/// Largest displacements of a gauge's nodes, upwards and downwards by axis, m.
std::array<double, 6> extremes(const Domain& domain, const Gauge& gauge) {
  const Motion motion(domain);
  std::array<double, 6> most{};
  for (const Index node : gauge.nodes) {
    const Vec3 displacement = motion.displacement(node);
    for (std::size_t i = 0; i < 3; ++i) {
      most[2 * i] = std::max(most[2 * i], displacement[static_cast<Eigen::Index>(i)]);
      most[2 * i + 1] = std::max(most[2 * i + 1], -displacement[static_cast<Eigen::Index>(i)]);
    }
  }
  return most;
}

void read_extremes(const Domain& domain, const std::vector<Gauge>& gauges, std::vector<GaugeReading>& readings) {
  std::vector<double> most;
  for (const Gauge& gauge : gauges) {
    const auto of_nodes = extremes(domain, gauge);
    most.insert(most.end(), of_nodes.begin(), of_nodes.end());
  }
  domain.exchange.communicator().max(most);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const double* m = most.data() + 6 * g;
    for (int i = 0; i < 3; ++i) readings[g].max_displacement[i] = m[2 * i] >= m[2 * i + 1] ? m[2 * i] : -m[2 * i + 1];
  }
}

void take_nodes_of_body(const Model& model, Index body, Gauge& gauge) {
  const LocalMesh& local = model.local;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (local.slot_body[at(s)] != body) continue;
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(s, c);
      if (local.counted[at(node)] != 0) gauge.nodes.push_back(node);
    }
  }
  std::sort(gauge.nodes.begin(), gauge.nodes.end());
  gauge.nodes.erase(std::unique(gauge.nodes.begin(), gauge.nodes.end()), gauge.nodes.end());
}

}  // namespace

std::vector<Gauge> make_gauges(const Model& model, const std::vector<std::string>& names, const case_::Stage& stage) {
  const LocalMesh& local = model.local;
  std::vector<Gauge> gauges;
  for (const std::string& name : names) {
    Gauge gauge;
    gauge.name = name;
    gauge.volume_group = group_index(model.mesh.volume_groups, name);
    if (gauge.volume_group >= 0 || corner_group(model.mesh, name) >= 0) {
      gauge.nodes = counted_nodes_of_group(model, name);
      if (gauge.volume_group < 0) gauge.members = slots_of_set(model, name);
    } else {
      gauge.body = static_cast<Index>(case_::numbered_body(name));
      take_nodes_of_body(model, gauge.body, gauge);
    }
    for (Index s = 0; s < local.num_slots && !gauge.is_surface(); ++s) {
      if (local.is_original(s) && holds(local, gauge, s)) gauge.slots.push_back(s);
    }
    for (std::size_t c = 0; gauge.is_surface() && c < stage.constraints.size(); ++c) {
      if (stage.constraints[c].group == name) gauge.constraints.push_back(c);
    }
    gauges.push_back(std::move(gauge));
  }
  return gauges;
}

std::vector<GaugeReading> read_gauges(const Domain& domain, const std::vector<Gauge>& gauges) {
  std::vector<GaugeReading> readings(gauges.size());
  std::vector<ExactSum> parts;
  for (const Gauge& gauge : gauges) first_sums(domain, gauge).append_to(parts);
  const std::vector<double> first = totals(domain.exchange.communicator(), parts);
  parts.clear();
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const double* s = first.data() + g * kNumFirst;
    GaugeReading& reading = readings[g];
    const double mass = s[18] > 0 ? s[18] : 1.0;
    reading.reaction = vector_at(s);
    reading.contact_force = vector_at(s + 3);
    reading.momentum = vector_at(s + 6);
    reading.velocity = reading.momentum / mass;
    reading.displacement = vector_at(s + 12) / mass;
    reading.centre = vector_at(s + 9) / mass + reading.displacement;
    reading.force = vector_at(s + 15);
    second_sums(domain, gauges[g], reading.centre).append_to(parts);
  }
  const std::vector<double> second = totals(domain.exchange.communicator(), parts);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const double* s = second.data() + g * kNumSecond;
    readings[g].spin = spin_of(vector_at(s), vector_at(s + 6), vector_at(s + 9));
    readings[g].torque = vector_at(s + 3);
  }
  read_extremes(domain, gauges, readings);
  return readings;
}

}  // namespace breccia
