#include "model/gauge_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/geometry.hpp"
#include "model/model.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::gauge_points_test {
namespace {

using testing::HasSubstr;

std::string line(const std::string& from, const std::string& to, int points) {
  return "[[gauge]]\nname = \"g\"\nkind = \"line\"\nfrom = " + from + "\nto = " + to +
         "\npoints = " + std::to_string(points) + "\n";
}
std::string point(const std::string& at) { return "[[gauge]]\nname = \"g\"\nkind = \"point\"\nat = " + at + "\n"; }

/// A box of 2 x 1 x 1 cubes of 10 mm.
case_::Case box(const std::string& gauge) {
  return case_::read_text(test::raster_case({.cells = {2, 1, 1}, .sections = gauge}));
}

std::string message_of(const case_::Case& input) {
  try {
    (void)build_mesh(input);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(GaugePoints, ALineHasPointsFromEndToEnd) {
  const std::vector<GaugePoint> points = gauge_points(box(line("[0, 0, 0]", "[0.02, 0, 0]", 5)));
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[0].place, Vec3(0, 0, 0));
  EXPECT_NEAR(points[1].place[0], 0.005, 1e-17);
  EXPECT_EQ(points[4].place, Vec3(0.02, 0, 0));
}

TEST(GaugePoints, AnElementHoldsThePointAtItsWeights) {
  const case_::Case input = box(line("[0.001, 0.002, 0.003]", "[0.019, 0.009, 0.006]", 40));
  const Mesh mesh = build_mesh(input).mesh;
  const std::vector<GaugePoint> points = gauge_points(input);
  const std::vector<HoldingElement> found = holding_elements(mesh, places_of(points));
  for (std::size_t p = 0; p < points.size(); ++p) {
    ASSERT_GE(found[p].element, 0) << p;
    const auto x = geometry::corners_of(mesh, found[p].element);
    Vec3 place = Vec3::Zero();
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_GE(found[p].weights[c], -kOutside);
      place += found[p].weights[c] * x[c];
    }
    EXPECT_LT((place - points[p].place).norm(), 1e-16) << p;
  }
}

TEST(GaugePoints, WhereElementsMeetTheLowestHoldsThePoint) {
  const case_::Case input = box(point("[0.01, 0, 0]"));  // a corner of two cubes
  const Mesh mesh = build_mesh(input).mesh;
  Index lowest = -1;
  for (Index e = mesh.num_elements() - 1; e >= 0; --e) {
    for (const Vec3& x : geometry::corners_of(mesh, e))
      if ((x - Vec3(0.01, 0, 0)).norm() < 1e-12) lowest = e;
  }
  EXPECT_EQ(holding_elements(mesh, places_of(gauge_points(input)))[0].element, lowest);
}

TEST(GaugePoints, APointOutsideIsRefusedWithTheNearestPlace) {
  EXPECT_EQ(message_of(box(point("[0.02, 0.01, 0.01]"))), "");
  EXPECT_EQ(message_of(box(point("[0.0200000000001, 0.004, 0]"))), "") << "round-off is within";
  const std::string beyond = message_of(box(point("[0.021, 0.004, 0.012]")));
  EXPECT_THAT(beyond, HasSubstr("gauge[0].at: the point lies outside of the model at rest"));
  EXPECT_THAT(beyond, HasSubstr("the nearest place of the model is [\"20 mm\", \"4 mm\", \"10 mm\"]"));
  EXPECT_THAT(beyond, HasSubstr("given: [\"21 mm\", \"4 mm\", \"12 mm\"]"));
  EXPECT_THAT(message_of(box(line("[0, 0, 0]", "[0.03, 0, 0]", 4))), HasSubstr("gauge[0].to: the point"));
}

TEST(GaugePoints, TheNearestPlaceIsOnAFaceAnEdgeOrACorner) {
  const Mesh mesh = build_mesh(box(point("[0, 0, 0]"))).mesh;
  const auto expect_near = [&](const Vec3& from, const Vec3& place) {
    EXPECT_LT((nearest_place(mesh, from) - place).norm(), 1e-16) << from.transpose();
  };
  expect_near({0.013, 0.004, 0.02}, {0.013, 0.004, 0.01});
  expect_near({0.03, 0.004, 0.02}, {0.02, 0.004, 0.01});
  expect_near({-1, -1, -1}, {0, 0, 0});
}

}  // namespace
}  // namespace breccia::gauge_points_test
