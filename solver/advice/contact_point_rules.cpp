#include "advice/rule_functions.hpp"

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
#include "physics/contact/geometry/point.hpp"

namespace breccia {
namespace {

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

Sentences late_contact(const Model& model) {
  constexpr double kReportedShare = 0.01;  // of the edges there
  Sentences advice;
  if (!model.has_contact || !model.contact_everywhere) return advice;
  std::vector<double> late(model.mesh.volume_groups.size(), 0.0);
  for (const Corner& corner : corners_of_surface(model)) {
    if (corner.group < 0 || !corner.smooth || corner.late < kReportedShare * corner.edge) continue;
    late[at(corner.group)] = std::max(late[at(corner.group)], corner.late);
  }
  for (std::size_t g = 0; g < late.size(); ++g) {
    if (!(late[g] > 0) || !has_points(model, static_cast<Index>(g))) continue;
    advice.push_back(
        fmt::format("The surface of {} is curved or has blunt edges, and its contact points lie up to {} behind the "
                    "corners of its faces: contact starts only at this distance. contact_points.per_face = 4 has "
                    "points on corners.",
                    model.mesh.volume_groups[g], quantity_text(late[g], "m")));
  }
  return advice;
}

Sentences coarse_contact_points(const Model& model) {
  // Times as large faces. A cube that fell on its corner kept 36 of 42 J on faces as large as its own, 13 J on faces
  // 1.5 times, 10 J on faces 2.1 times as large.
  constexpr double kCoarse = 1.25;
  constexpr int kAtCorners = 4;
  Sentences advice;
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
