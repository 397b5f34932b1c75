#include "advice/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/index.hpp"

namespace breccia {
namespace {

double wave_speed(const Model& model, std::size_t group) {
  const ElasticParams& p = model.elastic[group];
  return std::sqrt((p.lambda + 2 * p.mu) / model.density[group]);
}

}  // namespace

double impedance(const Model& model, std::size_t group) { return model.density[group] * wave_speed(model, group); }

Solids::Solids(const Model& model) : model_(model), all_(at(model.mesh.num_bodies)) {
  const Mesh& mesh = model.mesh;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    Solid& solid = of(e);
    for (const Index node : mesh.elements[at(e)]) {
      solid.low = solid.low.cwiseMin(mesh.nodes[at(node)]);
      solid.high = solid.high.cwiseMax(mesh.nodes[at(node)]);
    }
    solid.speed = std::min(solid.speed, wave_speed(model, at(mesh.element_group[at(e)])));
    solid.edge = model.whole.body_length[number(e)];
  }
}

void Solids::hold(const case_::Stage& stage) {
  for (Solid& solid : all_) solid.held = solid.whole = solid.pressed = false;
  for (const case_::Constraint& entry : stage.constraints) {
    const bool all_axes = entry.axes == std::array{true, true, true};
    for_each_element(entry.group, [&](Index e, bool volume) {
      of(e).held = true;
      of(e).whole = of(e).whole || (volume && all_axes);
    });
  }
  for (const case_::Pressure& pressure : stage.pressures)
    for_each_element(pressure.surface, [&](Index e, bool) { of(e).pressed = true; });
  for (const case_::Traction& traction : stage.tractions)
    for_each_element(traction.surface, [&](Index e, bool) { of(e).pressed = true; });
  for (const case_::Force& force : stage.forces)
    for_each_element(force.group, [&](Index e, bool) { of(e).pressed = true; });
}

double Solids::slowest_crossing() const {
  double time = 0;
  for (const Solid& solid : all_) time = std::max(time, solid.crossing());
  return time;
}

double Solids::slowest_at_rest() const {
  double time = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Solid& solid = all_[i];
    if (solid.whole || !solid.exists()) continue;
    if (solid.held || solid.pressed || lies_on_another(i)) time = std::max(time, solid.crossing());
  }
  return time;
}

bool Solids::touch(std::size_t one, std::size_t other) const {
  // Bodies that touch do so with their boxes as well; the gap of boxes that lie on each other is far below H.
  constexpr double kTouches = 0.01;
  const Solid &a = all_[one], &b = all_[other];
  if (!model_.has_contact || one == other || !a.exists() || !b.exists()) return false;
  const double gap = kTouches * a.edge;
  return ((a.low - b.high).array() <= gap).all() && ((b.low - a.high).array() <= gap).all();
}

bool Solids::lies_on_another(std::size_t i) const {
  for (std::size_t k = 0; k < all_.size(); ++k) {
    if (touch(i, k)) return true;
  }
  return false;
}

}  // namespace breccia
