#include <gtest/gtest.h>

#include <algorithm>

#include "unit/detection/scenes.hpp"

namespace breccia::detection::search_guarantee_test {
namespace {

using scenes::Random;

Vec3 random_direction(Random& random) {
  std::normal_distribution<double> coordinate;
  const double x = coordinate(random), y = coordinate(random);
  return Vec3(x, y, coordinate(random)).normalized();
}

class SearchGuarantee : public testing::TestWithParam<Algorithm> {};

TEST_P(SearchGuarantee, HoldsForPointsInsideElementsAfterAnyMotionOfHalfTheBuffer) {
  // Points are placed inside the moved elements, at their corners, edges and faces too, and moved back: every one of
  // these pairs must have been found before the motion. The last 1e-9 of the half buffer is left to the round-off of
  // positions.
  constexpr double share = 0.5 * (1 - 1e-9);
  Random random(21);
  std::uniform_real_distribution<double> weight(0, 1);
  const auto search = make_search(GetParam(), 0);
  for (const double buffer : {1e-3, 0.05, 0.5, 3.0}) {
    std::vector<Corners> before;
    std::vector<Vec3> points;
    std::vector<Couple> needed;
    for (Index c = 0; c < 400; ++c) {
      const double size = c % 3 == 0 ? 0.05 : 1.0;
      before.push_back(scenes::random_tetrahedron(random, scenes::uniform_vector(random, -2, 2), size));
      Corners moved = before.back();
      for (Vec3& corner : moved) corner += share * buffer * random_direction(random);
      for (int j = 0; j < 10; ++j) {
        Vec3 inside = scenes::random_point_in(random, moved);
        if (j == 0) inside = moved[static_cast<std::size_t>(c) % 4];
        if (j == 1) inside = scenes::face_centre(moved, static_cast<std::size_t>(c) % 4);
        if (j == 2) inside = moved[0] + weight(random) * (moved[3] - moved[0]);
        const double length = j % 2 == 0 ? 1.0 : weight(random);
        needed.push_back({static_cast<Index>(points.size()), c});
        points.push_back(inside - share * buffer * length * random_direction(random));
      }
    }
    std::vector<Couple> couples;
    search->search(points, before, buffer, couples);
    EXPECT_TRUE(std::is_sorted(couples.begin(), couples.end()));
    EXPECT_TRUE(std::includes(couples.begin(), couples.end(), needed.begin(), needed.end())) << "buffer " << buffer;
  }
}

TEST_P(SearchGuarantee, IsNotMetByListingEverything) {
  // The planes must cut: face centres of a raster wider than the buffer are coupled to their own element alone.
  const scenes::Scene scene = scenes::raster(5, 1.2);
  std::vector<Couple> couples;
  make_search(GetParam(), 0)->search(scene.points, scene.contactors, 0.05, couples);
  std::vector<Couple> expected;
  for (Index p = 0; p < 500; ++p) expected.push_back({p, p / 4});
  EXPECT_EQ(couples, expected);
}

std::string name_of(const testing::TestParamInfo<Algorithm>& info) { return scenes::name_of(info.param); }

INSTANTIATE_TEST_SUITE_P(All, SearchGuarantee,
                         testing::Values(Algorithm::ms, Algorithm::ms_slices, Algorithm::sorted_grid,
                                         Algorithm::packed_tree, Algorithm::brute_force),
                         name_of);

}  // namespace
}  // namespace breccia::detection::search_guarantee_test
