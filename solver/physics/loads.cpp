#include "physics/loads.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/topology.hpp"

namespace breccia {
namespace {

/// The three nodes of a face, counter-clockwise seen from outside.
std::array<Index, 3> face_nodes(const LocalMesh& mesh, const LoadedFace& loaded) {
  std::array<Index, 3> nodes{};
  for (std::size_t i = 0; i < 3; ++i) {
    nodes[i] = mesh.corner_node(loaded.slot, kFaceCorners[static_cast<std::size_t>(loaded.face)][i]);
  }
  return nodes;
}

}  // namespace

PressureLoad::PressureLoad(std::vector<LoadedFace> faces, TimeFunction pressure)
    : faces_(std::move(faces)), pressure_(std::move(pressure)) {
  const auto key = [](const LoadedFace& f) { return std::tuple(f.slot, f.face); };
  std::sort(faces_.begin(), faces_.end(), [&](const LoadedFace& a, const LoadedFace& b) { return key(a) < key(b); });
  const auto end = std::unique(faces_.begin(), faces_.end(),
                               [&](const LoadedFace& a, const LoadedFace& b) { return key(a) == key(b); });
  faces_.erase(end, faces_.end());
  corner_force_.assign(faces_.size(), Vec3::Zero());
}

void PressureLoad::apply(const LocalMesh& mesh, const State& state, double time, double dt_before,
                         NodalForces& forces) {
  const double factor = -pressure_(time) / 6.0;  // area vector = half the cross product, a third to each corner
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto nodes = face_nodes(mesh, faces_[k]);
    const Vec3 x0 = load_node(state.position.data(), nodes[0]);
    const Vec3 a = load_node(state.position.data(), nodes[1]) - x0;
    const Vec3 b = load_node(state.position.data(), nodes[2]) - x0;
    corner_force_[k] = factor * a.cross(b);
    for (const Index node : nodes) forces.add(node, corner_force_[k]);
  }
  work_.add_before(power(mesh, state.velocity), dt_before);
}

void PressureLoad::book_after(const LocalMesh& mesh, const State& state, double dt_after) {
  work_.add_after(power(mesh, state.velocity), dt_after);
}

double PressureLoad::power(const LocalMesh& mesh, const Field<double>& velocity) const {
  CompensatedSum sum;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto nodes = face_nodes(mesh, faces_[k]);
    Vec3 v = Vec3::Zero();
    for (const Index node : nodes) v += load_node(velocity.data(), node);
    sum.add(corner_force_[k].dot(v));
  }
  return sum.value();
}

Vec3 PressureLoad::resultant() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : corner_force_) sum += 3.0 * f;
  return sum;
}

GravityWork::GravityWork(const LocalMesh& mesh, const Field<double>& position) : mass_(mesh.node_mass) {
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    if (mesh.node_id[n] < 0) mass_[n] = 0.0;
  }
  anchor_ = moment(mesh, position);
}

Vec3 GravityWork::moment(const LocalMesh& mesh, const Field<double>& position) const {
  return weighted_sum(mass_, position.data(), mesh.reference.data());
}

void GravityWork::advance(const LocalMesh& mesh, const State& state, const Vec3& gravity, double dt_before) {
  if (!started_) {
    started_ = true;
    gravity_ = gravity;
    return;
  }
  if (gravity == gravity_) {
    anchored_last_step_ = false;
    return;
  }
  // g changed between t_(n-1) and t_n: the old value holds from the anchor to t_(n-1), their mean over the last step.
  const Vec3 last_step = dt_before * weighted_sum(mass_, state.velocity.data(), nullptr);
  const Vec3 now = anchored_last_step_ ? Vec3(anchor_ + last_step) : moment(mesh, state.position);
  const Vec3 before_it = now - last_step - anchor_;
  past_.add(gravity_.dot(before_it));
  past_.add(0.5 * (gravity_ + gravity).dot(last_step));
  gravity_ = gravity;
  anchor_ = now;
  anchored_last_step_ = true;
}

double GravityWork::work(const LocalMesh& mesh, const Field<double>& position) const {
  if (anchored_last_step_) return past_.value();
  return past_.value() + gravity_.dot(moment(mesh, position) - anchor_);
}

Vec3 weighted_sum(const Field<double>& mass, const double* plus, const double* minus) {
  constexpr std::size_t kRun = 64;  // blocks summed plainly before compensation: rounding grows with its root only
  const std::size_t blocks = mass.size() / kLanes;
  std::array<CompensatedSum, 3> total;
  for (std::size_t first = 0; first < blocks; first += kRun) {
    double lanes[3][kLanes] = {};
    for (std::size_t b = first; b < std::min(first + kRun, blocks); ++b) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = b * 24 + axis * 8;
        for (std::size_t l = 0; l < kLanes; ++l) {
          lanes[axis][l] += mass[b * 8 + l] * (minus ? plus[at + l] - minus[at + l] : plus[at + l]);
        }
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double lane : lanes[axis]) total[axis].add(lane);
    }
  }
  return {total[0].value(), total[1].value(), total[2].value()};
}

}  // namespace breccia
