#include "commands/contact_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <limits>
#include <vector>

#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// m, (groups) of its bodies: H of the finest one, and the extent of the largest one; 0: no element.
struct GroupSizes {
  std::vector<double> length, extent;
};

GroupSizes sizes_of(const Model& model) {
  const std::vector<double> none(model.mesh.volume_groups.size(), 0.0);
  GroupSizes sizes{none, none};
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const std::size_t body = at(model.mesh.element_body[at(e)]), group = at(model.mesh.element_group[at(e)]);
    const double h = model.whole.body_length[body];
    double& least = sizes.length[group];
    least = least > 0 ? std::min(least, h) : h;
    sizes.extent[group] = std::max(sizes.extent[group], model.whole.body_extent[body]);
  }
  return sizes;
}

/// s, largest delay of friction on a group, 0: none. @param extent  m, (groups) of the largest body
double longest_delay(const Model& model, std::size_t group, const std::vector<double>& extent) {
  double longest = 0;
  for (std::size_t other = 0; other < extent.size(); ++other) {
    for (const ContactLaw& law : {model.contact.law(static_cast<Index>(group), static_cast<Index>(other)),
                                  model.contact.law(static_cast<Index>(other), static_cast<Index>(group))}) {
      if (law.active() && law.friction > 0)
        longest = std::max(longest, law.friction_delay * std::min(extent[group], extent[other]));
    }
  }
  return longest;
}

}  // namespace

std::string stiffness_report(const Model& model) {
  const auto& names = model.mesh.volume_groups;
  const auto& [length, extent] = sizes_of(model);
  std::string text;
  for (std::size_t g = 0; g < names.size(); ++g) {
    double least = std::numeric_limits<double>::max(), most = 0;
    for (std::size_t other = 0; other < names.size(); ++other) {
      const auto i = static_cast<Index>(g), k = static_cast<Index>(other);
      const double penalty = std::max(model.contact.law(i, k).penalty, model.contact.law(k, i).penalty);
      if (!(penalty > 0) || !(length[other] > 0)) continue;
      least = std::min(least, penalty), most = std::max(most, penalty);
    }
    if (!(most > 0) || !(length[g] > 0)) continue;
    const ElasticParams& p = model.elastic[g];
    const double young = p.mu * (3 * p.lambda + 2 * p.mu) / (p.lambda + p.mu);
    const std::string range = most > least ? fmt::format("{:.3g} to {:.3g}", least / length[g], most / length[g])
                                           : fmt::format("{:.3g}", most / length[g]);
    text += fmt::format(
        "contact of {}: stiffness penalty/H = {} Pa/m with H = {}; recommended penalty {}, E, or that of a softer "
        "partner\n",
        names[g], range, quantity_text(length[g], "m"), quantity_text(young, "Pa"));
    if (const double delay = longest_delay(model, g, extent); delay > 0)
      text += fmt::format("  friction follows the normal force with a delay of up to {}\n", quantity_text(delay, "s"));
  }
  return text;
}

std::string separation_report(const case_::Case& input, const std::vector<std::string>& groups) {
  constexpr std::size_t kNamed = 8;
  std::string text;
  for (const case_::Contact& entry : input.contacts) {
    if (entry.interaction != case_::Interaction::none) continue;
    std::size_t pairs = 0;
    std::string names;
    for (std::size_t a = 0; a < groups.size(); ++a) {
      for (std::size_t b = a; b < groups.size(); ++b) {
        if (contact_entry(input, groups[a], groups[b]) != &entry || ++pairs > kNamed) continue;
        names += (names.empty() ? "" : ", ") +
                 (a == b ? groups[a] + " with itself" : fmt::format("{} with {}", groups[a], groups[b]));
      }
    }
    if (pairs > kNamed) names += fmt::format(" and {} more pairs", pairs - kNamed);
    text += fmt::format("no interaction ({}, line {}): {}\n", entry.origin.key, entry.origin.line,
                        names.empty() ? "no pair follows this entry" : names);
  }
  return text;
}

}  // namespace breccia
