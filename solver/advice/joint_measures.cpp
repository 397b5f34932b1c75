#include "advice/joint_measures.hpp"

#include <fmt/core.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {
namespace {

/// Indices of the groups of both sides.
std::pair<std::size_t, std::size_t> groups_beside(const Model& model, const ModelJoint& joint) {
  return {at(model.mesh.element_group[at(joint.face.a)]), at(model.mesh.element_group[at(joint.face.b)])};
}

/// Sum of A n n^T of the joints of a pair of groups over the volume of these, 1/m: under a stress along a unit vector d
/// joints of stiffness k in all directions add a strain of stress / k times d . this d.
Mat3 areas_per_volume(const Model& model, std::size_t groups) {
  Mat3 areas = Mat3::Zero();
  double volume = 0;
  std::vector<bool> counted(model.mesh.volume_groups.size(), false);
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) != groups) continue;
    const auto x = geometry::corners_of(model.mesh, joint.face.a);
    const auto& corners = kFaceCorners[static_cast<std::size_t>(joint.face.face_a)];
    const auto corner = [&](std::size_t i) { return x[static_cast<std::size_t>(corners[i])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    areas += joint.face.area * normal * normal.transpose();
    counted[at(model.mesh.element_group[at(joint.face.a)])] = true;
    counted[at(model.mesh.element_group[at(joint.face.b)])] = true;
  }
  for (Index s = 0; s < model.local.num_slots; ++s) {
    if (counted[at(model.local.block_group[at(s / kLanes)])]) volume += model.local.volume[at(s)];
  }
  return volume > 0 ? Mat3(areas / volume) : Mat3(Mat3::Zero());
}

/// @param young_over_stiffness  E/k, m
Softness softness_of(const Model& model, std::size_t groups, double young_over_stiffness) {
  Mat3 areas = areas_per_volume(model, groups);
  double directions = 3;
  if (model.plane) {
    areas.row(model.plane->axis).setZero();
    areas.col(model.plane->axis).setZero();
    directions = 2;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(areas);
  return {young_over_stiffness * areas.trace() / directions, young_over_stiffness * eigen.eigenvalues()[2],
          eigen.eigenvectors().col(2)};
}

Sides sides_of(const Model& model, std::size_t groups) {
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) != groups) continue;
    const auto [a, b] = groups_beside(model, joint);
    const double young_a = young(model.elastic[a]), young_b = young(model.elastic[b]);
    return {static_cast<Index>(young_b < young_a ? b : a), std::min(young_a, young_b), 2 / (1 / young_a + 1 / young_b)};
  }
  return {};
}

/// Mean length of the edges of a joint, m; of a plane model as seen along its axis, without those that stand upright: a
/// crack runs through any thickness at once.
double edge_of(const Model& model, const JointFace& face) {
  if (!model.plane) return face.size;
  constexpr double kUpright = 1e-6;  // of an edge: round-off of a mesh written with few digits
  const auto x = geometry::corners_of(model.mesh, face.a);
  const auto& corners = kFaceCorners[static_cast<std::size_t>(face.face_a)];
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 edge = x[static_cast<std::size_t>(corners[(i + 1) % 3])] - x[static_cast<std::size_t>(corners[i])];
    const double length = edge.norm();
    edge[model.plane->axis] = 0;
    if (edge.norm() <= kUpright * length) continue;
    sum += edge.norm();
    ++count;
  }
  return count > 0 ? sum / count : face.size;
}

Edges edges_of(const Model& model, std::size_t groups) {
  std::vector<double> edges;
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) == groups) edges.push_back(edge_of(model, joint.face));
  }
  if (edges.empty()) return {};
  const double mean = std::accumulate(edges.begin(), edges.end(), 0.0) / static_cast<double>(edges.size());
  const auto tenth = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 10);
  std::nth_element(edges.begin(), tenth, edges.end());
  return {mean, *tenth};
}

/// Least length of the fracture process zone, m: the lesser of two estimates.
double process_zone(const JointLawParams& law, const Sides& sides) {
  const double length = sides.interface_young * law.width_normal / law.tensile_strength;
  return std::min(length / 4, std::numbers::pi * length / 32);
}

JointMeasures measures_of(const Model& model, std::size_t groups) {
  const JointLawParams& law = model.joint_laws[groups];
  JointMeasures m;
  m.sides = sides_of(model, groups);
  m.edges = edges_of(model, groups);
  m.softness = softness_of(model, groups, m.sides.softer_young / law.stiffness);
  // Joints of one k lie the closer the finer the elements are.
  m.softest = (m.softness.is_even() ? m.softness.mean : m.softness.most) *
              (m.edges.graded() ? m.edges.mean / m.edges.fine : 1.0);
  if (law.breakable()) m.zone = process_zone(law, m.sides);
  return m;
}

}  // namespace

std::size_t groups_of(const Model& model, const ModelJoint& joint) {
  return at(model.groups_of_joint_law[at(joint.law)]);
}

std::string Softness::where() const {
  if (is_even()) return {};
  constexpr double kAlong = 0.98;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(softest[static_cast<Eigen::Index>(axis)]) > kAlong) return std::string(" along ") + "xyz"[axis];
  }
  return fmt::format(" along ({:.2g}, {:.2g}, {:.2g})", softest[0], softest[1], softest[2]);
}

AllJointMeasures joint_measures(const Model& model) {
  AllJointMeasures all;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) all.push_back(measures_of(model, l));
  return all;
}

bool breaks_inside(const Model& model, Index group) {
  for (std::size_t l = 0; l < model.whole.joint_groups.size(); ++l) {
    const WholeModel::JointGroups& groups = model.whole.joint_groups[l];
    if (groups.a == group && groups.b == group) return model.joint_laws[l].breakable();
  }
  return false;
}

}  // namespace breccia
