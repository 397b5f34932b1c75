#include "observe/point_gauges.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/cauchy_stress.hpp"

namespace breccia {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

std::vector<std::uint8_t> corners_on(const Model& model, const std::string& group) {
  std::vector<std::uint8_t> corners(model.mesh.elements.size(), 0);
  const Index number = corner_group(model.mesh, group);
  for (const CornerTag& tag : model.corner_tags) {
    const Index e = tag.group == number ? model.mesh.element_with(tag.element) : -1;
    if (e >= 0) corners[at(e)] = tag.corners;
  }
  return corners;
}

/// Of this rank's originals.
std::int64_t failed_joints_at(const Domain& domain, const std::vector<std::uint8_t>& corners) {
  const LocalMesh& local = domain.model.local;
  const auto touches = [&](Index slot, int face) {
    const auto& of_face = kFaceCorners[at(face)];
    const std::uint8_t marked = corners[at(local.mesh_element[at(slot)])];
    return std::any_of(of_face.begin(), of_face.end(), [&](int c) { return (marked >> c & 1) != 0; });
  };
  std::int64_t count = 0;
  for (const ActiveJoint& joint : domain.state.joints.active) {
    const bool counts = local.is_original(joint.slot_a) && joint.state() == JointState::failed;
    if (counts && touches(joint.slot_a, joint.face_a)) ++count;
  }
  for (const ReleasedJoint& joint : domain.state.joints.released)
    if (touches(joint.slot_a, joint.face_a)) ++count;
  return count;
}

}  // namespace

void PointGauges::find(const Domain& domain) {
  if (input_.gauges.empty()) return;
  const Model& model = domain.model;
  const std::vector<HoldingElement> found = holding_elements(model.mesh, places_of(points_));
  std::vector<double> held(points_.size(), kNone);  // minus the lowest id
  for (std::size_t p = 0; p < found.size(); ++p)
    if (found[p].element >= 0) held[p] = -static_cast<double>(model.mesh.element_id(found[p].element));
  domain.exchange.communicator().max(held);
  refuse_points_outside(domain, held);
  places_.clear();
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Index e = found[p].element;
    if (e < 0 || -static_cast<double>(model.mesh.element_id(e)) != held[p]) continue;
    const Index slot = model.local.slot_of_element[at(e)];
    if (model.local.is_original(slot)) places_.push_back({p, slot, found[p].weights});
  }
  marked_.clear();
  for (std::size_t g = 0; g < input_.gauges.size(); ++g)
    if (input_.gauges[g].kind == case_::GaugeKind::cracks)
      marked_.push_back({g, corners_on(model, input_.gauges[g].group)});
}

void PointGauges::refuse_points_outside(const Domain& domain, const std::vector<double>& held) const {
  std::vector<Problem> problems;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (held[p] != kNone) continue;
    const Vec3 mine = nearest_place(domain.model.mesh, points_[p].place);
    Vec3 nearest = mine;
    for (const std::vector<double>& other :
         domain.exchange.communicator().all_gather(std::span<const double>(mine.data(), 3))) {
      const Vec3 place(other[0], other[1], other[2]);
      if ((place - points_[p].place).norm() < (nearest - points_[p].place).norm()) nearest = place;
    }
    problems.push_back(point_outside(input_, points_[p], nearest));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::array<double, PointGauges::kNumbers> PointGauges::numbers_at(const Domain& domain, const Place& place) const {
  const Model& model = domain.model;
  const LocalMesh& local = model.local;
  const double* const x = domain.state.nodes.next_position.data();  // t_n: swapped with position since
  Vec3 displacement = Vec3::Zero(), velocity = displacement;
  for (int c = 0; c < 4; ++c) {
    const Index node = local.corner_node(place.slot, c);
    displacement += place.weights[at(c)] * (load_node(x, node) - load_node(local.reference.data(), node));
    velocity += place.weights[at(c)] * load_node(domain.state.nodes.velocity.data(), node);
  }
  const ElasticParams& params = model.elastic[at(local.block_group[at(place.slot / kLanes)])];
  const auto stress = components(cauchy_stress(local, params, place.slot, x, domain.scratch.velocity_before.data(),
                                               material_memory(domain.state.elements)));
  std::array<double, kNumbers> numbers{displacement[0], displacement[1], displacement[2],
                                       velocity[0],     velocity[1],     velocity[2]};
  std::copy(stress.begin(), stress.end(), numbers.begin() + 6);
  return numbers;
}

std::array<double, 2> PointGauges::elongation(std::size_t first, const std::vector<double>& numbers) const {
  const auto displacement = [&](std::size_t point) {
    const double* const u = &numbers[point * kNumbers];
    return Vec3(u[0], u[1], u[2]);
  };
  const Vec3 apart = points_[first + 1].place - points_[first].place;
  const Vec3 moved = displacement(first + 1) - displacement(first);
  const double length = apart.norm();
  // |D + m| - |D| without the difference of nearly equal lengths.
  const double longer = (2 * apart + moved).dot(moved) / ((apart + moved).norm() + length);
  return {longer, longer / length};
}

std::vector<double> PointGauges::read(const Domain& domain) const {
  if (input_.gauges.empty()) return {};
  const std::size_t of_points = points_.size() * kNumbers;
  std::vector<std::int64_t> words(of_points + marked_.size(), 0);  // each of one rank, the others add zero bits
  for (const Place& place : places_) {
    const auto numbers = numbers_at(domain, place);
    for (std::size_t i = 0; i < kNumbers; ++i)
      words[place.point * kNumbers + i] = std::bit_cast<std::int64_t>(numbers[i]);
  }
  for (std::size_t m = 0; m < marked_.size(); ++m) words[of_points + m] = failed_joints_at(domain, marked_[m].corners);
  domain.exchange.communicator().sum(words);
  std::vector<double> numbers(of_points);
  for (std::size_t i = 0; i < of_points; ++i) numbers[i] = std::bit_cast<double>(words[i]);

  std::vector<double> row;
  std::size_t point = 0, mark = of_points;
  const auto add_points = [&](std::size_t count) {
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(point * kNumbers);
    row.insert(row.end(), from, from + static_cast<std::ptrdiff_t>(count * kNumbers));
    point += count;
  };
  for (const case_::Gauge& gauge : input_.gauges) {
    switch (gauge.kind) {
      case case_::GaugeKind::point:
        add_points(1);
        break;
      case case_::GaugeKind::line:
        add_points(at(gauge.points));
        break;
      case case_::GaugeKind::extensometer: {
        const auto both = elongation(point, numbers);
        row.insert(row.end(), both.begin(), both.end());
        point += 2;
        break;
      }
      case case_::GaugeKind::cracks:
        row.push_back(static_cast<double>(words[mark++]));
        break;
    }
  }
  return row;
}

}  // namespace breccia
