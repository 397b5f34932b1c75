#include "mesh/quality.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/topology.hpp"

namespace breccia {
namespace {

constexpr std::size_t kWorstKept = 20;

Distribution distribution_of(std::vector<double> values) {
  if (values.empty()) return {};
  double sum = 0;
  for (const double value : values) sum += value;
  const auto count = static_cast<double>(values.size());
  auto sorted_to = values.begin();  // requested ranks ascend, and all values before are smaller
  const auto quantile = [&](double q) {
    const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(q * count)));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size()) - 1);
    std::nth_element(sorted_to, place, values.end());
    sorted_to = place;
    return *place;
  };
  return {quantile(0.0),  quantile(0.01), quantile(0.05), quantile(0.5),
          quantile(0.95), quantile(0.99), quantile(1.0),  sum / count};
}

Distribution distribution_of(const std::vector<ElementQuality>& all, double ElementQuality::*figure) {
  std::vector<double> values(all.size());
  std::transform(all.begin(), all.end(), values.begin(), [&](const ElementQuality& q) { return q.*figure; });
  return distribution_of(std::move(values));
}

void add(ElementSizes& sizes, const ElementQuality& quality) {
  ++sizes.elements;
  sizes.volume += quality.volume;
  sizes.mean_edge += quality.mean_edge;
}

void divide(std::vector<ElementSizes>& all) {
  for (ElementSizes& sizes : all) {
    if (sizes.elements > 0) sizes.mean_edge /= sizes.elements;
  }
}

std::vector<QualityReport::Worst> worst_of(const std::vector<ElementQuality>& all) {
  std::vector<Index> order(all.size());
  for (std::size_t e = 0; e < all.size(); ++e) order[e] = static_cast<Index>(e);
  const auto kept = std::min(kWorstKept, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    [&](Index a, Index b) {
                      const double qa = all[at(a)].radius_ratio, qb = all[at(b)].radius_ratio;
                      return qa < qb || (qa == qb && a < b);
                    });
  std::vector<QualityReport::Worst> worst;
  for (std::size_t i = 0; i < kept; ++i) worst.push_back({order[i], all[at(order[i])]});
  return worst;
}

}  // namespace

ElementQuality element_quality(const std::array<Vec3, 4>& x) {
  ElementQuality q;
  q.volume = geometry::tetra_volume(x[0], x[1], x[2], x[3]);

  std::array<Vec3, 4> normals;  // outward, length twice the face's area
  double surface = 0, smallest = 0, largest = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& c = kFaceCorners[f];
    normals[f] = (x[at(c[1])] - x[at(c[0])]).cross(x[at(c[2])] - x[at(c[0])]);
    const double area = 0.5 * normals[f].norm();
    surface += area;
    smallest = f == 0 ? area : std::min(smallest, area);
    largest = std::max(largest, area);
  }
  q.min_height = 3.0 * q.volume / largest;
  q.max_height = 3.0 * q.volume / smallest;
  q.inradius = 3.0 * q.volume / surface;

  for (const auto& [i, j] : geometry::kEdges) q.mean_edge += (x[at(j)] - x[at(i)]).norm() / 6.0;

  // The faces opposite to corners i and j meet along the edge of the two other corners.
  q.min_dihedral = 10;
  for (const auto& [i, j] : geometry::kEdges) {
    const Vec3 &n = normals[at(i)], &m = normals[at(j)];
    const double angle = std::atan2(n.cross(m).norm(), -n.dot(m));  // keeps its digits near 0 and pi, unlike acos
    q.min_dihedral = std::min(q.min_dihedral, angle);
    q.max_dihedral = std::max(q.max_dihedral, angle);
  }

  // Centre of the circumscribed sphere from corner 0: |c - a|^2 equal for the four corners, solved by Cramer's rule.
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const Vec3 centre_times_12v =
      a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
  const double circumradius_times_12v = centre_times_12v.norm();
  q.radius_ratio = 3.0 * q.inradius * 12.0 * q.volume / circumradius_times_12v;
  return q;
}

QualityReport assess_quality(const Mesh& mesh) {
  QualityReport report;
  report.groups.resize(mesh.volume_groups.size());
  report.bodies.resize(at(mesh.num_bodies));
  for (std::size_t g = 0; g < report.groups.size(); ++g) report.groups[g].name = mesh.volume_groups[g];

  std::vector<ElementQuality> all(mesh.elements.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    all[at(e)] = element_quality(geometry::corners_of(mesh, e));
    add(report.groups[at(mesh.element_group[at(e)])], all[at(e)]);
    add(report.bodies[at(mesh.element_body[at(e)])], all[at(e)]);
    constexpr int bins = static_cast<int>(std::tuple_size_v<decltype(report.ratio_bins)>);
    ++report.ratio_bins[at(std::clamp(static_cast<Index>(bins * all[at(e)].radius_ratio), 0, bins - 1))];
  }
  divide(report.groups);
  divide(report.bodies);

  report.volume = distribution_of(all, &ElementQuality::volume);
  report.min_height = distribution_of(all, &ElementQuality::min_height);
  report.max_height = distribution_of(all, &ElementQuality::max_height);
  report.inradius = distribution_of(all, &ElementQuality::inradius);
  report.mean_edge = distribution_of(all, &ElementQuality::mean_edge);
  report.min_dihedral = distribution_of(all, &ElementQuality::min_dihedral);
  report.max_dihedral = distribution_of(all, &ElementQuality::max_dihedral);
  report.radius_ratio = distribution_of(all, &ElementQuality::radius_ratio);
  report.worst = worst_of(all);
  return report;
}

std::vector<double> mean_inradii(const Mesh& mesh) {
  std::vector<double> sum(static_cast<std::size_t>(mesh.num_bodies), 0.0), count(sum.size(), 0.0);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto body = static_cast<std::size_t>(mesh.element_body[static_cast<std::size_t>(e)]);
    sum[body] += geometry::inradius(geometry::corners_of(mesh, e));
    count[body] += 1;
  }
  for (std::size_t b = 0; b < sum.size(); ++b) sum[b] /= std::max(count[b], 1.0);
  return sum;
}

std::vector<double> body_extents(const Mesh& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(mesh.num_bodies));
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto body = static_cast<std::size_t>(mesh.element_body[static_cast<std::size_t>(e)]);
    for (const Vec3& corner : geometry::corners_of(mesh, e)) boxes[body].extend(corner);
  }
  std::vector<double> extents;
  extents.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) extents.push_back(box.isEmpty() ? 0.0 : box.diagonal().norm());
  return extents;
}

}  // namespace breccia
