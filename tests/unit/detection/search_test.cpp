#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "base/error.hpp"
#include "detection/point_body/couple_test.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::search_test {

void PrintTo(const Couple& couple, std::ostream* out) {
  *out << '(' << couple.point << ", " << couple.contactor << ')';
}

namespace {

using scenes::Random;
using scenes::Scene;

/// The definition itself, pair by pair, in the order promised.
std::vector<Couple> by_definition(const Scene& scene, double buffer) {
  std::vector<CoupleTest> tests;
  for (const Corners& corners : scene.contactors) tests.emplace_back(corners, buffer);
  std::vector<Couple> couples;
  for (std::size_t p = 0; p < scene.points.size(); ++p) {
    for (std::size_t c = 0; c < tests.size(); ++c) {
      if (tests[c].skipped() || !tests[c].holds(scene.points[p])) continue;
      couples.push_back({static_cast<Index>(p), static_cast<Index>(c)});
    }
  }
  return couples;
}

/// Conformance of every algorithm, with the cell size it chooses and with sizes far from it.
class Search : public testing::TestWithParam<std::tuple<Algorithm, double>> {
 protected:
  /// The complete list equals the definition's; `least` couples at least, so that no scene is empty by mistake.
  void expect_definition(const Scene& scene, double buffer, std::size_t least) {
    const std::vector<Couple> expected = by_definition(scene, buffer);
    EXPECT_GE(expected.size(), least) << "the scene tests less than it should";
    search_->search(scene.points, scene.contactors, buffer, couples_);
    EXPECT_EQ(couples_.size(), expected.size());
    EXPECT_TRUE(couples_ == expected) << first_difference(expected);
  }

  std::string first_difference(const std::vector<Couple>& expected) const {
    const auto [found, wanted] = std::mismatch(couples_.begin(), couples_.end(), expected.begin(), expected.end());
    const auto text = [](auto it, auto end) {
      return it == end ? std::string("the end") : testing::PrintToString(*it);
    };
    return "found " + text(found, couples_.end()) + " instead of " + text(wanted, expected.end());
  }

  std::unique_ptr<PointBodySearch> search_ = make_search(std::get<0>(GetParam()), std::get<1>(GetParam()));
  std::vector<Couple> couples_;
};

TEST_P(Search, FindsTheDefinitionsCouplesAmongTetrahedraOfVeryDifferentSizes) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    expect_definition(scenes::cloud(seed, 300, 2, 3), 0.01, 1500);
    expect_definition(scenes::cloud(seed + 100, 300, 0.3, 3), 1e-4, 1500);
  }
}

TEST_P(Search, FindsTheDefinitionsCouplesOnRasters) {
  for (const double spacing : {0.4, 0.7071067811865476, 1.0, 2.5}) {
    expect_definition(scenes::raster(6, spacing), 0.05, 4 * 6 * 6 * 6);
  }
}

TEST_P(Search, FindsPointsOnCellBordersAndBoxFaces) {
  Scene scene;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      for (int z = -3; z <= 3; ++z) scene.points.push_back(0.5 * Vec3(x, y, z));
    }
  }
  for (const double size : {0.5, 1.0, 2.0}) {
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(-1, -1, -1), Vec3(-0.5, 0.5, 0), Vec3(0.25, -0.75, 0.25)}) {
      scene.contactors.push_back({at, at + Vec3(size, 0, 0), at + Vec3(0, size, 0), at + Vec3(0, 0, size)});
      scene.contactors.push_back({at, at - Vec3(size, 0, 0), at - Vec3(0, size, 0), at + Vec3(0, 0, size)});
    }
  }
  // Multiples of the cell size 0.05 that are no dyadic numbers, so that borders and points round differently.
  for (int k = -30; k <= 30; ++k) scene.points.push_back(0.05 * k * Vec3(1, 1, 1) - Vec3(0.05, 0, 0.1));
  for (const double buffer : {0.0, 0.05, 0.25, 0.5}) expect_definition(scene, buffer, 100);
}

TEST_P(Search, FindsTheSameCouplesAtNegativeCoordinates) {
  const Scene scene = scenes::cloud(7, 300, 4, 1, Vec3(-40, -30, -7));
  expect_definition(scene, 0.02, 1500);
}

TEST_P(Search, FindsAllCouplesWhenAllPointsShareACell) {
  Random random(8);
  Scene scene;
  for (int k = 0; k < 400; ++k)
    scene.points.push_back(Vec3(0.3, 0.3, 0.3) + scenes::uniform_vector(random, -1e-6, 1e-6));
  for (int k = 0; k < 40; ++k) {
    const Vec3 centre = scenes::uniform_vector(random, 0, 0.6);
    scene.contactors.push_back(scenes::random_tetrahedron(random, centre, 1));
  }
  scene.points.insert(scene.points.end(), 50, Vec3(0.3, 0.3, 0.3));  // coinciding points
  expect_definition(scene, 0.01, 400);
}

TEST_P(Search, DropsTheOldListWhenThereIsNothingToFind) {
  const Scene scene = scenes::raster(2, 1);
  expect_definition(scene, 0.1, 32);
  expect_definition({{}, scene.contactors}, 0.1, 0);
  EXPECT_TRUE(couples_.empty());
  expect_definition(scene, 0.1, 32);
  expect_definition({scene.points, {}}, 0.1, 0);
  EXPECT_TRUE(couples_.empty());
  expect_definition({{}, {}}, 0.1, 0);
  EXPECT_TRUE(couples_.empty());
}

TEST_P(Search, FindsTheFourFaceCentresOfASingleTetrahedron) {
  const Scene scene = scenes::raster(1, 1);
  search_->search(scene.points, scene.contactors, 1e-9, couples_);
  EXPECT_EQ(couples_, (std::vector<Couple>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
}

TEST_P(Search, TreatsFlatInvertedAndCollapsedElementsByTheirBox) {
  Scene scene = scenes::cloud(9, 200, 1.5, 1);
  Random random(10);
  for (std::size_t k = 0; k < scene.contactors.size(); ++k) {
    Corners& c = scene.contactors[k];
    if (k % 5 == 0) std::swap(c[0], c[1]);
    if (k % 5 == 1) c[3] = 0.5 * (c[0] + c[1]);
    if (k % 5 == 2) c.fill(c[0]);
    if (k % 5 == 3) c[3] = (c[0] + c[1] + c[2]) / 3 + 1e-15 * scenes::uniform_vector(random, -1, 1);
  }
  for (const double buffer : {0.0, 0.03}) expect_definition(scene, buffer, 300);
}

TEST_P(Search, FindsFragmentsThatHaveFlownFarAway) {
  Scene scene = scenes::raster(4, 1.2);
  for (const double distance : {1e3, 1e6, 1e9, 1e15, 1e200, 1e308}) {
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(-1, 1, -1)}) {
      scene.contactors.push_back(scenes::regular_tetrahedron(distance * direction, 1));
      const Corners& c = scene.contactors.back();
      for (std::size_t a = 0; a < 4; ++a) scene.points.push_back(c[a]);
      scene.points.push_back(distance * direction);
    }
  }
  expect_definition(scene, 0.01, 4 * 64 + 5 * 5 * 3);
}

TEST_P(Search, FindsCouplesInALongBarWhoseEndsHaveFlownOffAlongIt) {
  // One row of cells holds most points and two far ones: the row cannot have a table of its cells.
  Scene scene;
  for (int k = 0; k < 300; ++k) scene.contactors.push_back(scenes::regular_tetrahedron(Vec3(0.8 * k, 0.1, 0.1), 1));
  scene.contactors.push_back(scenes::regular_tetrahedron(Vec3(3e8, 0.1, 0.1), 1));
  scene.contactors.push_back(scenes::regular_tetrahedron(Vec3(-5e8, 0.1, 0.1), 1));
  for (const Corners& c : scene.contactors) {
    for (std::size_t a = 0; a < 4; ++a) scene.points.push_back(scenes::face_centre(c, a));
  }
  expect_definition(scene, 0.05, 1200);
}

TEST_P(Search, FindsEveryPairWhenTheBufferIsLargerThanTheScene) {
  const Scene scene = scenes::cloud(15, 60, 2, 2);
  expect_definition(scene, 100, scene.points.size() * scene.contactors.size());
}

TEST_P(Search, FindsTheDefinitionsCouplesWithoutABuffer) { expect_definition(scenes::cloud(16, 300, 1.5, 1), 0, 1000); }

TEST_P(Search, LeavesOutPointsAndContactorsThatAreNotFinite) {
  Scene scene = scenes::cloud(17, 100, 1, 1);
  const double bad[]{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < 30; ++k) {
    scene.points[16 * k][static_cast<Eigen::Index>(k % 3)] = bad[k / 3 % 3];
    scene.contactors[3 * k][k % 4][static_cast<Eigen::Index>(k / 4 % 3)] = bad[k % 3];
  }
  expect_definition(scene, 0.02, 300);
  for (const Couple& couple : couples_) {
    EXPECT_TRUE(scene.points[static_cast<std::size_t>(couple.point)].allFinite());
  }
}

TEST_P(Search, FindsCouplesOfOneLargeContactorAmongThousandsOfSmallOnes) {
  Scene scene = scenes::cloud(18, 400, 1, 0.5, Vec3(2, 2, 2));
  for (Corners& c : scene.contactors) {
    for (Vec3& x : c) x *= 0.05;
  }
  for (Vec3& p : scene.points) p *= 0.05;
  scene.contactors.push_back(scenes::regular_tetrahedron(Vec3(0, 0, 0), 1));
  expect_definition(scene, 1e-3, 2400);
}

TEST_P(Search, FindsCouplesWhereAFewElementsAreAThousandTimesAsLargeAsACrowdOfOthers) {
  // A crowd of small elements in one corner of a scene of large ones, numbered at random: sizes and distances of points
  // differ by three orders, and no two neighbours in space are neighbours in memory.
  Scene scene = scenes::cloud(19, 150, 6, 0.3);
  const Scene crowd = scenes::cloud(20, 600, 6, 0.3);
  const auto shrunk = [](const Vec3& x) { return Vec3(Vec3(1, -2, 1.5) + 1e-3 * x); };
  for (const Corners& c : crowd.contactors)
    scene.contactors.push_back({shrunk(c[0]), shrunk(c[1]), shrunk(c[2]), shrunk(c[3])});
  for (const Vec3& p : crowd.points) scene.points.push_back(shrunk(p));
  Random random(21);
  std::shuffle(scene.contactors.begin(), scene.contactors.end(), random);
  std::shuffle(scene.points.begin(), scene.points.end(), random);
  for (const double buffer : {0.0, 1e-5, 1e-2}) expect_definition(scene, buffer, 2500);
}

TEST_P(Search, RefusesABufferThatIsNoLength) {
  const Scene scene = scenes::raster(1, 1);
  for (const double buffer :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(search_->search(scene.points, scene.contactors, buffer, couples_), InternalError);
  }
}

std::string name_of(const testing::TestParamInfo<Search::ParamType>& info) {
  const double cell = std::get<1>(info.param);
  const std::string size = cell == 0 ? "chosen" : cell == 0.05 ? "small" : cell == 0.5 ? "dyadic" : "large";
  return scenes::name_of(std::get<0>(info.param)) + "_" + size + "_cell";
}

INSTANTIATE_TEST_SUITE_P(All, Search,
                         testing::Combine(testing::Values(Algorithm::ms, Algorithm::ms_slices, Algorithm::sorted_grid),
                                          testing::Values(0.0, 0.05, 0.5, 1000.0)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(WithoutCells, Search,
                         testing::Combine(testing::Values(Algorithm::packed_tree, Algorithm::brute_force),
                                          testing::Values(0.0)),
                         name_of);

TEST(MakeSearch, RefusesACellSizeThatIsNoLength) {
  for (const double cell : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)make_search(Algorithm::ms, cell), InternalError);
  }
}

}  // namespace
}  // namespace breccia::detection::search_test
