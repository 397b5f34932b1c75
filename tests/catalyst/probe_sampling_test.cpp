// Points of probes and the tetrahedra in which they lie.

#include "catalyst/probe_sampling.hpp"

#include <gtest/gtest.h>

namespace breccia::insitu::probe_sampling_test {
namespace {

const std::vector<double> kUnit{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

std::vector<double> moved(double x, double size = 1) {
  std::vector<double> corners = kUnit;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = size * corners[i] + (i % 3 == 0 ? x : 0.0);
  return corners;
}

std::vector<std::int64_t> found(const std::vector<Point>& points, const std::vector<std::vector<double>>& tetrahedra,
                                const std::vector<std::int64_t>& ids) {
  std::vector<double> corners;
  for (const auto& own : tetrahedra) corners.insert(corners.end(), own.begin(), own.end());
  std::vector<std::int64_t> out;
  for (const Place& place : places_of(points, static_cast<std::int64_t>(ids.size()), corners.data(), ids.data()))
    out.push_back(place.id == Place::kNowhere ? -1 : place.id);
  return out;
}

TEST(ProbePoints, AreOneOrOnALineOrOnAPlaneWithBothEnds) {
  EXPECT_EQ(points_of({"p", {1, 2, 3}, {}, {}, 1, 1}), (std::vector<Point>{{1, 2, 3}}));
  EXPECT_EQ(points_of({"l", {1, 2, 3}, {2, 0, 0}, {}, 3, 1}), (std::vector<Point>{{1, 2, 3}, {2, 2, 3}, {3, 2, 3}}));
  EXPECT_EQ(points_of({"f", {0, 0, 0}, {2, 0, 0}, {0, 4, 0}, 2, 2}),
            (std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {2, 4, 0}}));
}

TEST(ProbePlaces, AreTheTetrahedronAroundAPointOrNone) {
  EXPECT_EQ(found({{0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}, {3.2, 0.2, 0.2}, {-0.1, 0.2, 0.2}}, {moved(0), moved(3)}, {7, 4}),
            (std::vector<std::int64_t>{7, -1, 4, -1}));
}

TEST(ProbePlaces, WhereSeveralAreAreThatOfTheSmallestIdInAnyOrder) {
  EXPECT_EQ(found({{0.2, 0.2, 0.2}}, {moved(0), moved(0.1), moved(-0.1)}, {7, 3, 5}), (std::vector<std::int64_t>{3}));
  EXPECT_EQ(found({{0.2, 0.2, 0.2}}, {moved(-0.1), moved(0), moved(0.1)}, {5, 7, 3}), (std::vector<std::int64_t>{3}));
}

TEST(ProbePlaces, AtCornersEdgesAndFacesAreInsideAndTurnedOverTetrahedraTooButNotThoseWithoutVolume) {
  EXPECT_EQ(found({{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.3, 0, 0.3}}, {kUnit}, {0}),
            (std::vector<std::int64_t>{0, 0, 0, 0, 0}));
  const std::vector<double> turned{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(found({{0.2, 0.2, 0.2}}, {turned}, {0}), (std::vector<std::int64_t>{0}));
  const std::vector<double> flat{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  EXPECT_EQ(found({{0.2, 0.2, 0}}, {flat}, {0}), (std::vector<std::int64_t>{-1}));
}

TEST(ProbePlaces, DoNotDependOnTheSizeOfAModelAndAreEmptyWithoutElements) {
  for (const double size : {1e-9, 1e-3, 1e6})
    EXPECT_EQ(
        found({{0.2 * size, 0.2 * size, 0.2 * size}, {0.4 * size, 0.4 * size, 0.4 * size}}, {moved(0, size)}, {0}),
        (std::vector<std::int64_t>{0, -1}));
  EXPECT_EQ(found({{0, 0, 0}}, {}, {}), (std::vector<std::int64_t>{-1}));
}

}  // namespace
}  // namespace breccia::insitu::probe_sampling_test
