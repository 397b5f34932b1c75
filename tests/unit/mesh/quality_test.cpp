#include "mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/geometry.hpp"
#include "sample_meshes.hpp"

namespace breccia::quality_test {
namespace {

constexpr double kRoundOff = 1e-14;

TEST(ElementQuality, OfTheRegularTetrahedronIsTheTextbooks) {
  const double a = 0.7;
  const double s = a / (2 * std::sqrt(2.0));
  const ElementQuality q =
      element_quality({s * Vec3(1, 1, 1), s * Vec3(-1, 1, -1), s * Vec3(1, -1, -1), s * Vec3(-1, -1, 1)});
  EXPECT_NEAR(q.volume, a * a * a / (6 * std::sqrt(2.0)), kRoundOff);
  EXPECT_NEAR(q.min_height, a * std::sqrt(2.0 / 3), kRoundOff);
  EXPECT_NEAR(q.max_height, a * std::sqrt(2.0 / 3), kRoundOff);
  EXPECT_NEAR(q.inradius, a / (2 * std::sqrt(6.0)), kRoundOff);
  EXPECT_NEAR(q.mean_edge, a, kRoundOff);
  EXPECT_NEAR(q.min_dihedral, std::acos(1.0 / 3), kRoundOff);
  EXPECT_NEAR(q.max_dihedral, std::acos(1.0 / 3), kRoundOff);
  EXPECT_NEAR(q.radius_ratio, 1.0, 1e-13);
}

TEST(ElementQuality, OfACubesCornerIsComputedByHand) {
  // Legs 1, 2, 2 along the axes: V = 2/3, faces 1, 1, 2 and |(4, 2, 2)| / 2 = sqrt(6).
  const ElementQuality q = element_quality({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 2)});
  EXPECT_NEAR(q.volume, 2.0 / 3, kRoundOff);
  EXPECT_NEAR(q.min_height, 2 / std::sqrt(6.0), kRoundOff);
  EXPECT_NEAR(q.max_height, 2.0, kRoundOff);
  EXPECT_NEAR(q.inradius, 2 / (4 + std::sqrt(6.0)), kRoundOff);
  EXPECT_NEAR(q.mean_edge, (1 + 2 + 2 + 2 * std::sqrt(5.0) + std::sqrt(8.0)) / 6, kRoundOff);
  EXPECT_NEAR(q.max_dihedral, std::numbers::pi / 2, kRoundOff);
  EXPECT_NEAR(q.min_dihedral, std::acos(4 / std::sqrt(24.0)), kRoundOff);  // between the oblique face and x = 0
  EXPECT_NEAR(q.radius_ratio, 3 * q.inradius / 1.5, kRoundOff);            // circumscribed: half the diagonal 3
}

TEST(ElementQuality, OfASliverTendsToZeroWithDihedralsOfZeroAndPi) {
  const double h = 1e-6;
  const ElementQuality q = element_quality({Vec3(0, 0, 0), Vec3(1, 0, h), Vec3(1, 1, 0), Vec3(0, 1, h)});
  EXPECT_GT(std::abs(q.volume), 0);
  const auto positive = element_quality({Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, h), Vec3(0, 1, h)});
  const ElementQuality& sliver = q.volume > 0 ? q : positive;
  EXPECT_LT(sliver.radius_ratio, 1e-5);
  EXPECT_GT(sliver.radius_ratio, 0);
  EXPECT_LT(sliver.min_dihedral, 1e-5);
  EXPECT_GT(sliver.max_dihedral, std::numbers::pi - 1e-5);
}

TEST(QualityReport, OfARasterIsThatOfItsOneElementShape) {
  // A cube of 1 m: every element has corners (0 0 0) (1 0 0) (.5 .5 0) (.5 .5 .5) up to symmetry.
  const Mesh mesh = make_raster({.cells = {3, 3, 3}, .boxes = {2, 1, 1}}).mesh;
  const QualityReport report = assess_quality(mesh);
  const double edges = (1 + 2 * std::sqrt(0.5) + 2 * std::sqrt(0.75) + 0.5) / 6;
  for (const double value : {report.mean_edge.min, report.mean_edge.p05, report.mean_edge.median, report.mean_edge.p99,
                             report.mean_edge.max, report.mean_edge.mean}) {
    EXPECT_NEAR(value, edges, 1e-12);
  }
  EXPECT_NEAR(report.volume.median, 1.0 / 24, 1e-14);
  ASSERT_EQ(report.bodies.size(), 2u);
  ASSERT_EQ(report.groups.size(), 1u);
  EXPECT_EQ(report.groups[0].name, "raster");
  EXPECT_EQ(report.groups[0].elements, 2 * 27 * 24);
  EXPECT_NEAR(report.groups[0].volume, 54, 1e-11);
  EXPECT_NEAR(report.bodies[1].volume, 27, 1e-11);
  EXPECT_NEAR(report.bodies[1].mean_edge, edges, 1e-12);
  EXPECT_EQ(report.worst.size(), 20u);
}

TEST(QualityReport, RanksTheWorstElementsAndTheQuantilesAsASortDoes) {
  const Mesh mesh = test::two_boxes("quality", 0.2, true).mesh;
  const QualityReport report = assess_quality(mesh);
  std::vector<std::pair<double, Index>> ranked;
  std::vector<double> volumes;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto q = element_quality(geometry::corners_of(mesh, e));
    ranked.emplace_back(q.radius_ratio, e);
    volumes.push_back(q.volume);
  }
  std::sort(ranked.begin(), ranked.end());
  ASSERT_EQ(report.worst.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(report.worst[i].element, ranked[i].second);

  // A q-quantile: at least q of the elements do not exceed it, and less than q are below it.
  const auto count = static_cast<double>(volumes.size());
  for (const auto& [q, value] : {std::pair{0.01, report.volume.p01},
                                 {0.05, report.volume.p05},
                                 {0.5, report.volume.median},
                                 {0.95, report.volume.p95},
                                 {0.99, report.volume.p99}}) {
    const double v = value;
    const auto below = std::count_if(volumes.begin(), volumes.end(), [v](double x) { return x < v; });
    const auto up_to = std::count_if(volumes.begin(), volumes.end(), [v](double x) { return x <= v; });
    EXPECT_LT(static_cast<double>(below), q * count);
    EXPECT_GE(static_cast<double>(up_to), q * count);
  }
  EXPECT_EQ(report.volume.min, *std::min_element(volumes.begin(), volumes.end()));
  EXPECT_EQ(report.volume.max, *std::max_element(volumes.begin(), volumes.end()));
}

TEST(BodyExtents, AreTheDiagonalsOfTheirBoxes) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 2}, {5, 0, 0}, {8, 0, 0}, {5, 4, 0}, {5, 0, 12}};
  mesh.elements = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  mesh.element_body = {1, 0};
  mesh.num_bodies = 3;
  EXPECT_EQ(body_extents(mesh), (std::vector<double>{13, 3, 0})) << "no element: nothing";
}

}  // namespace
}  // namespace breccia::quality_test
