#include "advice/overlaps.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "advice/rule_functions.hpp"
#include "base/quantity_text.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// The group's name, with the body's number where the group has elements of other bodies.
std::string name_of_body(const Model& model, Index group, Index body) {
  const Mesh& mesh = model.mesh;
  bool several = false;
  for (Index e = 0; e < mesh.num_elements() && !several; ++e) {
    const auto i = static_cast<std::size_t>(e);
    several = mesh.element_group[i] == group && mesh.element_body[i] != body;
  }
  const std::string& name = mesh.volume_groups[static_cast<std::size_t>(group)];
  return several ? fmt::format("\"{}\" (body {})", name, body) : fmt::format("\"{}\"", name);
}

}  // namespace

std::vector<GroupOverlap> overlaps_by_groups(const Model& model) {
  std::vector<GroupOverlap> groups;
  if (!model.has_contact) return groups;
  for (const BodyOverlap& overlap : initial_overlaps(model)) {
    const auto same = [&](const GroupOverlap& g) {
      return std::minmax(g.deepest.group, g.deepest.other_group) == std::minmax(overlap.group, overlap.other_group);
    };
    auto known = std::find_if(groups.begin(), groups.end(), same);
    if (known == groups.end()) {
      groups.push_back({overlap});
      known = groups.end() - 1;
    }
    ++known->pairs;
    known->points += overlap.points;
    known->corners += overlap.corners;
  }
  return groups;
}

std::string overlap_description(const Model& model, const GroupOverlap& groups) {
  const BodyOverlap& o = groups.deepest;
  const double penalty =
      std::max(model.contact.law(o.group, o.other_group).penalty, model.contact.law(o.other_group, o.group).penalty);
  const double stress = penalty * o.depth / o.length;
  std::string text = fmt::format(
      "{} and {} overlap by up to {} before the first step, at ({:.4g}, {:.4g}, {:.4g}) m: {} contact points and {} "
      "corners are inside the other body",
      name_of_body(model, o.group, o.body), name_of_body(model, o.other_group, o.other), quantity_text(o.depth, "m"),
      o.place[0], o.place[1], o.place[2], groups.points, groups.corners);
  if (groups.pairs > 1) text += fmt::format(" in {} pairs of bodies", groups.pairs);
  return text + fmt::format("; contact would push with {}", quantity_text(stress, "Pa"));
}

const case_::Contact& overlap_entry(const case_::Case& input, const Model& model, const BodyOverlap& overlap) {
  const auto& names = model.mesh.volume_groups;
  return *contact_entry(input, names[static_cast<std::size_t>(overlap.group)],
                        names[static_cast<std::size_t>(overlap.other_group)]);
}

std::string overlap_remedy(const BodyOverlap& overlap) {
  return fmt::format(
      "bodies at least {} further apart, initial_overlap = \"relax\" (the overlap makes no force), or \"accept\"",
      quantity_text(overlap.depth, "m"));
}

Sentences overlapping_bodies(const case_::Case& input, const Model& model, const std::vector<GroupOverlap>& overlaps) {
  Sentences advice;
  for (const GroupOverlap& groups : overlaps) {
    const BodyOverlap& o = groups.deepest;
    if (overlap_entry(input, model, o).initial_overlap != case_::InitialOverlap::refuse) continue;
    advice.push_back(fmt::format("A run ends with an error, since {} and {} overlap. Remedy: {}.",
                                 name_of_body(model, o.group, o.body), name_of_body(model, o.other_group, o.other),
                                 overlap_remedy(o)));
  }
  return advice;
}

}  // namespace breccia
