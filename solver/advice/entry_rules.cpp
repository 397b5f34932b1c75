#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "mesh/bodies.hpp"
#include "mesh/geometry.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// Axes along which an entry takes the initial velocity away from all of its group.
std::string lost_axes(const case_::InitialVelocity& initial, const case_::Constraint& entry) {
  std::string axes;
  if (entry.group != initial.group || entry.kind == case_::ConstraintKind::displacement) return axes;
  const bool fixed = entry.kind == case_::ConstraintKind::fixed;
  for (std::size_t a = 0; a < 3; ++a) {
    const double given = initial.velocity[static_cast<Eigen::Index>(a)];
    if (entry.axes[a] && given != 0 && (fixed || entry.value[a](0) != given)) axes += "xyz"[a];
  }
  return axes;
}

/// Whether a stage prescribes the motion of a group along all axes, by entries that name it or, of a surface, a volume
/// behind it.
bool wholly_held(const case_::Stage& stage, const Model& model, const std::string& group) {
  const Mesh& mesh = model.mesh;
  const auto held = [&](const std::string& volume) {
    std::array<bool, 3> axes{};
    for (const case_::Constraint& entry : stage.constraints) {
      if (entry.group != group && entry.group != volume) continue;
      for (std::size_t a = 0; a < 3; ++a) axes[a] = axes[a] || entry.axes[a];
    }
    return axes == std::array{true, true, true};
  };
  if (held(group)) return true;
  for (std::size_t s = 0; s < mesh.surface_groups.size(); ++s) {
    if (mesh.surface_groups[s] != group) continue;
    const auto& faces = model.topology.surface_groups[s];
    return !faces.empty() && std::all_of(faces.begin(), faces.end(), [&](const Topology::Face& face) {
      return held(mesh.volume_groups[at(mesh.element_group[at(face.element)])]);
    });
  }
  return false;
}

}  // namespace

std::string elements_left_out(const Model& model) {
  const Index lost = model.mesh_report.ungrouped_elements;
  if (lost == 0) return {};
  return fmt::format(
      "Of {} tetrahedra of the mesh {} are in no physical volume and are left out. Give their volumes a Physical "
      "Volume "
      "of their own, or take them out of the geometry.",
      lost + model.mesh.num_elements(), lost);
}

std::string empty_sphere(const Model& model) {
  if (!model.contact.sphere) return {};
  const SphericalBoundary& sphere = *model.contact.sphere;
  double furthest = 0;
  for (const auto& nodes : model.mesh.elements) {
    Vec3 centre = Vec3::Zero();
    for (const Index node : nodes) {
      centre += model.mesh.nodes[at(node)] / 4;
      furthest = std::max(furthest, (model.mesh.nodes[at(node)] - sphere.centre).norm());
    }
    if ((centre - sphere.centre).norm() <= sphere.radius) return {};
  }
  return fmt::format(
      "The sphere encloses nothing: the whole model is outside at the start, and elements outside are not pushed back. "
      "Raise sphere.radius from {:.4g} to more than {:.4g} m, or move sphere.centre.",
      sphere.radius, furthest);
}

/// Laws of interfaces that are nowhere.
Sentences unused_joint_law(const case_::Case& input, const Model& model) {
  Sentences advice;
  const std::vector<std::string>& used = model.joint_law_keys;
  for (const case_::Joint& entry : input.joints) {
    if (entry.inside() || std::find(used.begin(), used.end(), entry.origin.key) != used.end()) continue;
    advice.push_back(fmt::format(
        "{} (line {}) is the law of no joint: there is no glued interface of \"{}\" and \"{}\" that follows it.",
        entry.origin.key, entry.origin.line, entry.groups[0], entry.groups[1]));
  }
  return advice;
}

Sentences lost_velocity(const case_::Case& input) {
  Sentences advice;
  if (input.stages.empty()) return advice;
  for (const case_::InitialVelocity& initial : input.initial_velocities) {
    for (const case_::Constraint& entry : input.stages.front().constraints) {
      const std::string axes = lost_axes(initial, entry);
      if (axes.empty()) continue;
      advice.push_back(fmt::format(
          "The initial velocity of \"{}\" (line {}) is lost along {}: {} (line {}) prescribes the motion of "
          "the whole group there from the first step on. Leave one of them out.",
          initial.group, initial.origin.line, axes, entry.origin.key, entry.origin.line));
    }
  }
  return advice;
}

/// Loads and absorbing boundaries on surfaces whose motion is prescribed.
Sentences load_on_held_nodes(const case_::Case& input, const Model& model) {
  Sentences advice;
  for (const case_::Stage& stage : input.stages) {
    const auto report_if_held = [&](const case_::Origin& origin, const std::string& group) {
      if (!wholly_held(stage, model, group)) return;
      advice.push_back(
          fmt::format("{} (line {}) moves nothing: the motion of all nodes of \"{}\" is prescribed along x, y and z.",
                      origin.key, origin.line, group));
    };
    for (const case_::Pressure& pressure : stage.pressures) report_if_held(pressure.origin, pressure.surface);
    for (const case_::Traction& traction : stage.tractions) report_if_held(traction.origin, traction.surface);
    for (const case_::Force& force : stage.forces) report_if_held(force.origin, force.group);
    for (const std::string& surface : stage.absorbing) {
      if (!wholly_held(stage, model, surface)) continue;
      advice.push_back(fmt::format(
          "{}.absorbing (line {}) absorbs nothing: the motion of all nodes of \"{}\" is prescribed along x, y and z.",
          stage.origin.key, stage.origin.line, surface));
    }
  }
  return advice;
}

}  // namespace breccia
