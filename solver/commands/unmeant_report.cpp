#include "commands/unmeant_report.hpp"

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
#include "commands/stage_report.hpp"
#include "commands/surface_report.hpp"
#include "commands/unjoined_report.hpp"
#include "mesh/bodies.hpp"
#include "mesh/geometry.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

std::string lost_elements(const Model& model) {
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
      "The sphere is around nothing: the whole model begins outside, and what begins outside is not pushed back in. "
      "Raise sphere.radius from {:.4g} to more than {:.4g} m, or move sphere.centre.",
      sphere.radius, furthest);
}

std::string no_contact_points(const case_::Case& input, const Model& model) {
  if (input.contacts.empty() || model.contact_everywhere || !model.contact_faces.empty()) return {};
  return "There is [[contact]], but contact_points.surfaces leaves no face with contact points: bodies go through each "
         "other. Name surfaces there, or leave the key out for all free faces.";
}

/// m, cube root of the volume of the largest body of each group.
std::vector<double> body_sizes(const Model& model) {
  const Mesh& mesh = model.mesh;
  std::vector<double> volume(at(mesh.num_bodies), 0.0), size(mesh.volume_groups.size(), 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& n = mesh.elements[e];
    volume[at(mesh.element_body[e])] += std::abs(
        geometry::tetra_volume(mesh.nodes[at(n[0])], mesh.nodes[at(n[1])], mesh.nodes[at(n[2])], mesh.nodes[at(n[3])]));
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double& largest = size[at(mesh.element_group[e])];
    largest = std::max(largest, std::cbrt(volume[at(mesh.element_body[e])]));
  }
  return size;
}

/// m, (groups) H of the finest body.
std::vector<double> contact_lengths(const Model& model) {
  std::vector<double> length(model.mesh.volume_groups.size(), 0.0);
  for (std::size_t e = 0; e < model.mesh.elements.size(); ++e) {
    double& least = length[at(model.mesh.element_group[e])];
    const double h = model.whole.body_length[at(model.mesh.element_body[e])];
    least = least > 0 ? std::min(least, h) : h;
  }
  return length;
}

/// A mass rho L on a spring penalty/H, both a unit of area, is stopped after v sqrt(rho L H / penalty).
Advice soft_penalties(const case_::Case& input, const Model& model) {
  constexpr double kEdge = 5;  // edges of an element over H, about
  constexpr double kShare = 0.1;
  Advice advice;
  if (!model.has_contact || input.initial_velocities.empty()) return advice;
  const auto& names = model.mesh.volume_groups;
  const std::vector<double> size = body_sizes(model), length = contact_lengths(model);
  for (const case_::InitialVelocity& initial : input.initial_velocities) {
    const auto found = std::find(names.begin(), names.end(), initial.group);
    if (found == names.end()) continue;
    const auto g = static_cast<Index>(found - names.begin());
    const double speed = initial.velocity.norm() + initial.random[1];
    for (std::size_t other = 0; other < names.size(); ++other) {
      const auto k = static_cast<Index>(other);
      const double penalty = std::max(model.contact.law(g, k).penalty, model.contact.law(k, g).penalty);
      const double h = std::max(length[at(g)], length[other]);
      if (!(penalty > 0) || !(h > 0)) continue;
      const double mass = std::min(model.density[at(g)] * size[at(g)], model.density[other] * size[other]);
      const double depth = speed * std::sqrt(mass * h / penalty);
      if (depth <= kEdge * h) continue;
      advice.push_back(fmt::format(
          "The contact penalty of {} between \"{}\" and \"{}\" is too soft for {}: they would enter each other by {}, "
          "more than an element (about {}), and go on through. A penalty of {} or more stops them within a tenth of "
          "one.",
          quantity_text(penalty, "Pa"), names[at(g)], names[other], quantity_text(speed, "m/s"),
          quantity_text(depth, "m"), quantity_text(kEdge * h, "m"),
          quantity_text(mass * h * std::pow(speed / (kShare * kEdge * h), 2), "Pa")));
    }
  }
  return advice;
}

Advice lowered_penalties(const case_::Case& input) {
  Advice advice;
  for (const case_::Contact& entry : input.contacts) {
    const double largest = largest_penalty(entry.plateau, entry.unloading_exponent);
    if (!(entry.plateau > 0) || !(entry.penalty > largest)) continue;
    advice.push_back(fmt::format(
        "The contact penalty between \"{}\" and \"{}\" (line {}) acts as {}, not {}: so its plateau of {} begins at an "
        "overlap of {:.2g} H. Within less the steps would not resolve it; bodies would chatter and sink.",
        entry.groups[0], entry.groups[1], entry.origin.line, quantity_text(largest, "Pa"),
        quantity_text(entry.penalty, "Pa"), quantity_text(entry.plateau, "Pa"), entry.plateau / largest));
  }
  return advice;
}

/// Something is driven while something else is held or driven as well.
bool is_pressed(const case_::Case& input) {
  return std::any_of(input.stages.begin(), input.stages.end(), [](const case_::Stage& stage) {
    return std::any_of(stage.constraints.begin(), stage.constraints.end(), [&](const case_::Constraint& driven) {
      return driven.kind != case_::ConstraintKind::fixed &&
             std::any_of(stage.constraints.begin(), stage.constraints.end(),
                         [&](const case_::Constraint& other) { return other.group != driven.group; });
    });
  });
}

bool begins_broken(const case_::Case& input, const std::string& surface) {
  const auto names = [&](const std::vector<std::string>& broken) {
    return std::find(broken.begin(), broken.end(), surface) != broken.end();
  };
  return names(input.broken_surfaces) ||
         std::any_of(input.stages.begin(), input.stages.end(),
                     [&](const case_::Stage& stage) { return names(stage.broken_surfaces); });
}

/// Bodies, parted along the surfaces that a stage breaks as well.
Index num_parts(const case_::Case& input, const Model& model) {
  std::vector<std::string> broken;
  for (const std::string& surface : model.mesh.surface_groups) {
    if (begins_broken(input, surface)) broken.push_back(surface);
  }
  return find_bodies(model.mesh, model.topology, faces_of_surfaces(model.mesh, model.topology, broken)).count;
}

/// What is pressed between flat bodies without friction is in neutral equilibrium sideways.
Advice pressed_without_friction(const case_::Case& input, const Model& model) {
  constexpr Index kBetweenTwo = 3;  // bodies
  Advice advice;
  if (!is_pressed(input) || num_parts(input, model) < kBetweenTwo) return advice;
  for (const case_::Contact& entry : input.contacts) {
    if (entry.friction > 0 || entry.interaction == case_::Interaction::none) continue;
    advice.push_back(fmt::format(
        "Contact between \"{}\" and \"{}\" (line {}) has no friction: nothing but the unevenness of the meshes holds a "
        "body sideways that is pressed between wider flat ones; it may slide, and be driven out where they end. A "
        "friction of 0.05 holds it.",
        entry.groups[0], entry.groups[1], entry.origin.line));
  }
  return advice;
}

/// Two entries of [[contact]] that fit a pair of groups and name as many of its groups: told once, with the first pair.
Advice tied_contacts(const case_::Case& input, const Model& model) {
  Advice advice;
  const std::vector<std::string>& groups = model.mesh.volume_groups;
  std::set<std::pair<const case_::Contact*, const case_::Contact*>> told;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a; b < groups.size(); ++b) {
      const auto [ruling, overruled] = tied_contact_entries(input, groups[a], groups[b]);
      if (overruled == nullptr || !told.emplace(ruling, overruled).second) continue;
      advice.push_back(fmt::format(
          "Contact between \"{}\" and \"{}\" follows {} (line {}), the later one; {} (line {}) fits as well. Name "
          "the pair in a [[contact]] of its own.",
          groups[a], groups[b], ruling->origin.key, ruling->origin.line, overruled->origin.key,
          overruled->origin.line));
    }
  }
  return advice;
}

/// Laws of interfaces that are nowhere.
Advice laws_of_no_joint(const case_::Case& input, const Model& model) {
  Advice advice;
  const std::vector<std::string>& used = model.joint_law_keys;
  for (const case_::Joint& entry : input.joints) {
    if (entry.inside() || std::find(used.begin(), used.end(), entry.origin.key) != used.end()) continue;
    advice.push_back(fmt::format(
        "{} (line {}) is the law of no joint: there is no glued interface of \"{}\" and \"{}\" that follows it.",
        entry.origin.key, entry.origin.line, entry.groups[0], entry.groups[1]));
  }
  return advice;
}

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

Advice lost_velocities(const case_::Case& input) {
  Advice advice;
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

/// Loads and absorbing boundaries on surfaces whose motion is prescribed.
Advice loads_on_what_is_held(const case_::Case& input, const Model& model) {
  Advice advice;
  for (const case_::Stage& stage : input.stages) {
    const auto judge = [&](const case_::Origin& origin, const std::string& group) {
      if (!wholly_held(stage, model, group)) return;
      advice.push_back(
          fmt::format("{} (line {}) moves nothing: the motion of all nodes of \"{}\" is prescribed along x, y and z.",
                      origin.key, origin.line, group));
    };
    for (const case_::Pressure& pressure : stage.pressures) judge(pressure.origin, pressure.surface);
    for (const case_::Traction& traction : stage.tractions) judge(traction.origin, traction.surface);
    for (const case_::Force& force : stage.forces) judge(force.origin, force.group);
    for (const std::string& surface : stage.absorbing) {
      if (!wholly_held(stage, model, surface)) continue;
      advice.push_back(fmt::format(
          "{}.absorbing (line {}) absorbs nothing: the motion of all nodes of \"{}\" is prescribed along x, y and z.",
          stage.origin.key, stage.origin.line, surface));
    }
  }
  return advice;
}

}  // namespace

Advice unmeant_advice(const case_::Case& input, const Model& model) {
  Advice advice;
  advise(advice, lost_elements(model));
  advise(advice, empty_sphere(model));
  advise(advice, no_contact_points(input, model));
  append(advice, unjoined_volumes(input, model.mesh, model.topology));
  append(advice, parts_in_motion(input, model));
  append(advice, lowered_penalties(input));
  append(advice, soft_penalties(input, model));
  append(advice, tied_contacts(input, model));
  append(advice, laws_of_no_joint(input, model));
  append(advice, pressed_without_friction(input, model));
  append(advice, lost_velocities(input));
  append(advice, loads_on_what_is_held(input, model));
  append(advice, surface_advice(input, model));
  append(advice, overruled_constraints(input, model));
  return advice;
}

}  // namespace breccia
