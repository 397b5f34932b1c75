#include "commands/contact_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "mesh/tetrahedron.hpp"
#include "model/parameters.hpp"
#include "physics/contact/contact_point.hpp"

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

/// s, by which friction on a group is late at most, 0: there is none. @param extent  m, (groups) of the largest body
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

/// The surface around a node.
struct Corner {
  Vec3 normal = Vec3::Zero();                                  ///< m2, sum of area vectors
  double late = std::numeric_limits<double>::max(), edge = 0;  ///< m
  bool smooth = true;
  Index group = -1;
};

/// Calls f(element, its face's nodes, area vector of that face) for every free face.
template <class F>
void for_each_free_face(const Model& model, F&& f) {
  const Mesh& mesh = model.mesh;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int face = 0; face < 4; ++face) {
      if (!model.topology.links[at(e)][at(face)].free()) continue;
      if (model.plane && on_side(mesh, e, face, model.plane->axis)) continue;
      std::array<Index, 3> node{};
      for (std::size_t i = 0; i < 3; ++i) node[i] = mesh.elements[at(e)][at(kFaceCorners[at(face)][i])];
      const Vec3& x = mesh.nodes[at(node[0])];
      f(e, node, Vec3(0.5 * (mesh.nodes[at(node[1])] - x).cross(mesh.nodes[at(node[2])] - x)));
    }
  }
}

/// How far behind each corner the nearest contact points around it lie, along the normal there.
std::vector<Corner> corners_of_surface(const Model& model) {
  constexpr double kSmooth = 0.8;  // cosine of the angle between a face and the mean of those around the corner
  const FaceRule& rule = face_rule(model.contact.points_per_face);
  std::vector<Corner> corners(model.mesh.nodes.size());
  for_each_free_face(model, [&](Index e, const std::array<Index, 3>& nodes, const Vec3& area) {
    for (const Index n : nodes) {
      corners[at(n)].normal += area;
      corners[at(n)].group = model.mesh.element_group[at(e)];
    }
  });
  for_each_free_face(model, [&](Index, const std::array<Index, 3>& nodes, const Vec3& area) {
    for (const Index n : nodes) {
      Corner& corner = corners[at(n)];
      const Vec3 up = corner.normal.normalized();
      corner.smooth = corner.smooth && area.dot(up) > kSmooth * area.norm();
      for (int p = 0; p < rule.num_points; ++p) {
        Vec3 place = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i) place += rule.shape[at(p)][i] * model.mesh.nodes[at(nodes[i])];
        corner.late = std::min(corner.late, (model.mesh.nodes[at(n)] - place).dot(up));
      }
      for (const Index other : nodes)
        corner.edge = std::max(corner.edge, (model.mesh.nodes[at(n)] - model.mesh.nodes[at(other)]).norm());
    }
  });
  return corners;
}

bool has_points(const Model& model, Index group) {
  for (std::size_t other = 0; other < model.mesh.volume_groups.size(); ++other) {
    if (model.contact.law(group, static_cast<Index>(other)).active()) return true;
  }
  return false;
}

/// m, (groups) square root of the mean area of the free faces; 0: none.
std::vector<double> face_sizes(const Model& model) {
  std::vector<double> area(model.mesh.volume_groups.size(), 0.0), count = area;
  for_each_free_face(model, [&](Index e, const std::array<Index, 3>&, const Vec3& of_face) {
    const std::size_t group = at(model.mesh.element_group[at(e)]);
    area[group] += of_face.norm();
    ++count[group];
  });
  for (std::size_t g = 0; g < area.size(); ++g) area[g] = count[g] > 0 ? std::sqrt(area[g] / count[g]) : 0.0;
  return area;
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
        "contact of {}: stiffness penalty/H = {} Pa/m with H = {}; recommended penalty {}, E, or that "
        "of what it meets if softer\n",
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

Advice late_contact_advice(const Model& model) {
  constexpr double kWorthTelling = 0.01;  // of the edges there
  Advice advice;
  if (!model.has_contact || !model.contact_everywhere) return advice;
  std::vector<double> late(model.mesh.volume_groups.size(), 0.0);
  for (const Corner& corner : corners_of_surface(model)) {
    if (corner.group < 0 || !corner.smooth || corner.late < kWorthTelling * corner.edge) continue;
    late[at(corner.group)] = std::max(late[at(corner.group)], corner.late);
  }
  for (std::size_t g = 0; g < late.size(); ++g) {
    if (!(late[g] > 0) || !has_points(model, static_cast<Index>(g))) continue;
    advice.push_back(
        fmt::format("The surface of {} is curved or has blunt edges, and its contact points lie up to {} behind the "
                    "corners of its faces: other bodies come so much nearer before they feel it. "
                    "contact_points.per_face = 4 has points on corners.",
                    model.mesh.volume_groups[g], quantity_text(late[g], "m")));
  }
  return advice;
}

Advice coarse_points_advice(const Model& model) {
  // Times as large faces. A cube that fell on its corner kept 36 of 42 J on faces as large as its own, 13 J on faces
  // 1.5 times, 10 J on faces 2.1 times as large.
  constexpr double kCoarse = 1.25;
  constexpr int kAtCorners = 4;
  Advice advice;
  if (!model.has_contact || model.contact.points_per_face == kAtCorners) return advice;
  const auto& names = model.mesh.volume_groups;
  const std::vector<double> size = face_sizes(model);
  for (std::size_t fine = 0; fine < size.size(); ++fine) {
    for (std::size_t coarse = 0; coarse < size.size(); ++coarse) {
      const auto i = static_cast<Index>(fine), k = static_cast<Index>(coarse);
      if (!(size[fine] > 0) || size[coarse] < kCoarse * size[fine]) continue;
      if (!model.contact.law(i, k).active() || !model.contact.law(k, i).active()) continue;
      advice.push_back(fmt::format(
          "The faces of {0} are {1:.2g} times as large as those of {2}, so its contact points are few and heavy: one "
          "that gets into a corner of {2} drives it aside (a cube that fell on its corner kept a quarter of its "
          "energy, the rest went into spin and friction). contact_points.per_face = 4 prevents that, or points_on = "
          "\"first\" with {2} named first.",
          names[coarse], size[coarse] / size[fine], names[fine]));
    }
  }
  return advice;
}

}  // namespace breccia
