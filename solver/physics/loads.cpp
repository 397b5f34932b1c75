#include "physics/loads.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/topology.hpp"

namespace breccia {

bool comes_before(const LoadedFace& a, const LoadedFace& b) {
  return std::tuple(a.slot, a.face) < std::tuple(b.slot, b.face);
}

std::array<Index, 3> face_nodes(const LocalMesh& mesh, const LoadedFace& loaded) {
  std::array<Index, 3> nodes{};
  for (std::size_t i = 0; i < 3; ++i) {
    nodes[i] = mesh.corner_node(loaded.slot, kFaceCorners[static_cast<std::size_t>(loaded.face)][i]);
  }
  return nodes;
}

Vec3 doubled_area(const Field<double>& place, const std::array<Index, 3>& nodes) {
  const Vec3 x0 = load_node(place.data(), nodes[0]);
  const Vec3 a = load_node(place.data(), nodes[1]) - x0;
  const Vec3 b = load_node(place.data(), nodes[2]) - x0;
  return a.cross(b);
}

namespace {

void sort_unique_faces(std::vector<LoadedFace>& faces) {
  std::sort(faces.begin(), faces.end(), comes_before);
  const auto end = std::unique(faces.begin(), faces.end(), [](const LoadedFace& a, const LoadedFace& b) {
    return !comes_before(a, b);  // of two in order
  });
  faces.erase(end, faces.end());
}

}  // namespace

SurfaceLoad::SurfaceLoad(std::vector<LoadedFace> faces, TimeFunction pressure)
    : faces_(std::move(faces)), follows_(true), pressure_(std::move(pressure)) {
  sort_unique_faces(faces_);
  corner_force_.assign(faces_.size(), Vec3::Zero());
}

SurfaceLoad::SurfaceLoad(std::vector<LoadedFace> faces, std::array<TimeFunction, 3> traction)
    : faces_(std::move(faces)), follows_(false), traction_(std::move(traction)) {
  sort_unique_faces(faces_);
  corner_force_.assign(faces_.size(), Vec3::Zero());
}

template <class Account>
void SurfaceLoad::for_each_power(const LocalMesh& mesh, const Field<double>& velocity, Account&& account) const {
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (!mesh.is_original(faces_[k].slot)) continue;
    Vec3 v = Vec3::Zero();
    for (const Index node : face_nodes(mesh, faces_[k])) v += load_node(velocity.data(), node);
    account(corner_force_[k].dot(v));
  }
}

void SurfaceLoad::apply(const LocalMesh& mesh, const NodalState& state, double time, double dt_before,
                        NodalForces& forces) {
  // Of twice the area a sixth to each corner.
  const double factor = -pressure_(time) / 6.0;
  const Vec3 fixed = Vec3(traction_[0](time), traction_[1](time), traction_[2](time)) / 6.0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto nodes = face_nodes(mesh, faces_[k]);
    corner_force_[k] = follows_ ? Vec3(factor * doubled_area(state.position, nodes))
                                : Vec3(doubled_area(mesh.reference, nodes).norm() * fixed);
    for (const Index node : nodes) forces.add(node, corner_force_[k]);
  }
  for_each_power(mesh, state.velocity, [&](double power) { work_.add_before(power, dt_before); });
}

void SurfaceLoad::account_after(const LocalMesh& mesh, const NodalState& state, double dt_after) {
  for_each_power(mesh, state.velocity, [&](double power) { work_.add_after(power, dt_after); });
}

Vec3 SurfaceLoad::resultant() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : corner_force_) sum += 3.0 * f;
  return sum;
}

namespace {

/// Sum of m g . (x - y) over this rank's elements and the shared nodes it counts. @param minus  nullptr: y = 0
ExactSum potential(const LocalMesh& mesh, const Vec3& g, const double* plus, const double* minus) {
  const auto term = [&](Index node) {
    const Vec3 x = minus != nullptr ? Vec3(load_node(plus, node) - load_node(minus, node)) : load_node(plus, node);
    return mesh.node_mass[static_cast<std::size_t>(node)] * g.dot(x);
  };
  ExactSum sum;
  for (Index s = 0; s < mesh.num_own_originals; ++s) {
    if (!mesh.is_original(s)) continue;
    sum.add((term(own_corner_node(s, 0)) + term(own_corner_node(s, 1))) +
            (term(own_corner_node(s, 2)) + term(own_corner_node(s, 3))));
  }
  for (Index n = mesh.num_own_nodes(); n < mesh.num_nodes; ++n) {
    if (mesh.counted[static_cast<std::size_t>(n)] != 0) sum.add(term(n));
  }
  return sum;
}

ExactSum negative(const ExactSum& sum) {
  auto words = sum.words();
  for (std::int64_t& word : words) word = -word;
  return ExactSum::from_words(words);
}

}  // namespace

void GravityWork::set_anchor(const LocalMesh& mesh, const Field<double>& position) {
  if (started && !changing) anchor = potential(mesh, gravity, position.data(), mesh.reference.data());
}

void GravityWork::advance(const LocalMesh& mesh, const NodalState& state, const Vec3& now, double dt_before) {
  const auto here = [&](const Vec3& g) { return potential(mesh, g, state.position.data(), mesh.reference.data()); };
  const auto last_step = [&](const Vec3& g) {
    return potential(mesh, Vec3(dt_before * g), state.velocity.data(), nullptr);
  };
  const bool changes = started && now != gravity;
  if (!started) {
    anchor = here(now);
  } else if (changes && !changing) {
    // The old value from the anchor up to t_(n-1), its mean with the new one over the last step.
    past.add(here(gravity));
    past.add(negative(anchor));
    past.add(last_step(0.5 * (now - gravity)));
  } else if (changing) {
    past.add(last_step(0.5 * (gravity + now)));
    if (!changes) anchor = here(now);
  }
  started = true;
  changing = changes;
  gravity = now;
}

ExactSum GravityWork::work(const LocalMesh& mesh, const Field<double>& position) const {
  ExactSum sum = past;
  if (!started || changing) return sum;
  sum.add(potential(mesh, gravity, position.data(), mesh.reference.data()));
  sum.add(negative(anchor));
  return sum;
}

}  // namespace breccia
