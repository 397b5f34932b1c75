#include "physics/contact/geometry/point.hpp"

#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "base/error.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {

namespace {

/// Three points (1 - 2a, a, a) and permutations, from point `first` on.
void add_orbit(FaceRule& rule, double a, double share) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(rule.num_points++);
    rule.shape[k] = {a, a, a};
    rule.shape[k][i] = 1 - 2 * a;
    rule.share[k] = share;
  }
}

FaceRule one_point() {
  FaceRule rule;
  rule.num_points = 1;
  rule.shape[0] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  rule.share[0] = 1;
  return rule;
}

FaceRule three_points() {
  FaceRule rule;
  add_orbit(rule, 1.0 / 6, 1.0 / 3);
  return rule;
}

FaceRule corners_and_centroid() {
  FaceRule rule;
  add_orbit(rule, 0.0, 1.0 / 12);
  rule.num_points = 4;
  rule.shape[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  rule.share[3] = 0.75;
  return rule;
}

FaceRule six_points() {
  const double root = std::sqrt(10.0);
  const double inner = std::sqrt(38 - 44 * std::sqrt(0.4));
  const double spread = std::sqrt(213125 - 53320 * root);
  FaceRule rule;
  add_orbit(rule, (8 - root + inner) / 18, (620 + spread) / 3720);
  add_orbit(rule, (8 - root - inner) / 18, (620 - spread) / 3720);
  return rule;
}

}  // namespace

const FaceRule& face_rule(int points_per_face) {
  static const FaceRule one = one_point(), three = three_points(), four = corners_and_centroid(), six = six_points();
  switch (points_per_face) {
    case 1:
      return one;
    case 3:
      return three;
    case 4:
      return four;
    default:
      DEMAND(points_per_face == 6, std::to_string(points_per_face));
      return six;
  }
}

void append_points(const FaceRule& rule, const LocalMesh& local, Index slot, int face,
                   std::vector<ContactPoint>& points) {
  ContactPoint point;
  point.slot = slot;
  point.face = static_cast<std::int8_t>(face);
  std::array<Vec3, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    point.nodes[i] = local.corner_node(slot, kFaceCorners[static_cast<std::size_t>(face)][i]);
    x[i] = load_node(local.reference.data(), point.nodes[i]);
  }
  const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
  const GlobalId first = kPointsAnElement * local.element_of_slot[static_cast<std::size_t>(slot)] + kPointsAFace * face;
  for (int k = 0; k < rule.num_points; ++k) {
    point.k = static_cast<std::uint8_t>(k);
    point.id = first + k;
    point.weight = rule.share[static_cast<std::size_t>(k)] * area;
    points.push_back(point);
  }
}

}  // namespace breccia
