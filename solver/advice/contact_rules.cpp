#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "case/groups.hpp"
#include "mesh/bodies.hpp"
#include "mesh/geometry.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

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

/// A group is driven while another one is constrained or driven as well.
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

}  // namespace

std::string no_contact_points(const case_::Case& input, const Model& model) {
  if (input.contacts.empty() || model.contact_everywhere || !model.contact_faces.empty()) return {};
  return "There is [[contact]], but contact_points.surfaces leaves no face with contact points: bodies go through each "
         "other. Name surfaces there, or leave the key out for all free faces.";
}

/// A mass rho L on a spring penalty/H, both a unit of area, is stopped after v sqrt(rho L H / penalty).
Sentences soft_penalty(const case_::Case& input, const Model& model) {
  constexpr double kEdge = 5;  // edges of an element over H, about
  constexpr double kShare = 0.1;
  Sentences advice;
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
          "The contact penalty of {} between \"{}\" and \"{}\" is too low for {}: the overlap would reach {}, more "
          "than an element (about {}), and the bodies would pass through each other. A penalty of {} or more limits "
          "the overlap to a tenth of an element.",
          quantity_text(penalty, "Pa"), names[at(g)], names[other], quantity_text(speed, "m/s"),
          quantity_text(depth, "m"), quantity_text(kEdge * h, "m"),
          quantity_text(mass * h * std::pow(speed / (kShare * kEdge * h), 2), "Pa")));
    }
  }
  return advice;
}

namespace {

/// Of an entry, for the stiffest pair of groups that it fits; Pa.
double penalty_of(const case_::Case& input, const case_::Contact& entry) {
  if (entry.penalty_factor == 0) return entry.penalty;
  double young = 0;
  for (const case_::Material& a : input.materials)
    for (const case_::Material& b : input.materials)
      if (case_::fits(entry.groups, a.group, b.group)) young = std::max(young, std::min(a.young, b.young));
  return entry.penalty_factor * young;
}

}  // namespace

Sentences lowered_penalty(const case_::Case& input) {
  Sentences advice;
  for (const case_::Contact& entry : input.contacts) {
    const double largest = largest_penalty(entry.plateau, entry.unloading_exponent);
    const double penalty = penalty_of(input, entry);
    if (!(entry.plateau > 0) || !(penalty > largest)) continue;
    advice.push_back(fmt::format(
        "The contact penalty between \"{}\" and \"{}\" (line {}) acts as {}, not {}: so its plateau of {} begins at an "
        "overlap of {:.2g} H. Within less the steps would not resolve it; bodies would chatter and sink.",
        entry.groups[0], entry.groups[1], entry.origin.line, quantity_text(largest, "Pa"), quantity_text(penalty, "Pa"),
        quantity_text(entry.plateau, "Pa"), entry.plateau / largest));
  }
  return advice;
}

/// What is pressed between flat bodies without friction is in neutral equilibrium sideways.
Sentences pressed_without_friction(const case_::Case& input, const Model& model) {
  constexpr Index kBetweenTwo = 3;  // bodies
  Sentences advice;
  if (!is_pressed(input) || num_parts(input, model) < kBetweenTwo) return advice;
  for (const case_::Contact& entry : input.contacts) {
    if (entry.friction > 0 || entry.interaction == case_::Interaction::none) continue;
    advice.push_back(fmt::format(
        "Contact between \"{}\" and \"{}\" (line {}) has no friction: a body pressed between wider flat ones has no "
        "lateral support except the unevenness of the meshes and may slide out. A friction of 0.05 prevents it.",
        entry.groups[0], entry.groups[1], entry.origin.line));
  }
  return advice;
}

/// Two entries of [[contact]] that fit a pair of groups and name as many of its groups: reported once, with the first.
Sentences tied_contacts(const case_::Case& input, const Model& model) {
  Sentences advice;
  const std::vector<std::string>& groups = model.mesh.volume_groups;
  std::set<std::pair<const case_::Contact*, const case_::Contact*>> reported;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a; b < groups.size(); ++b) {
      const auto [ruling, overruled] = tied_contact_entries(input, groups[a], groups[b]);
      if (overruled == nullptr || !reported.emplace(ruling, overruled).second) continue;
      advice.push_back(fmt::format(
          "Contact between \"{}\" and \"{}\" follows {} (line {}), the later one; {} (line {}) fits as well. Name "
          "the pair in a [[contact]] of its own.",
          groups[a], groups[b], ruling->origin.key, ruling->origin.line, overruled->origin.key,
          overruled->origin.line));
    }
  }
  return advice;
}

}  // namespace breccia
