#include <gtest/gtest.h>

#include <limits>

#include "base/error.hpp"
#include "detection/point_body/brute_force.hpp"
#include "detection/point_body/contactor_grid.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::contactor_grid_test {
namespace {

void expect_as_brute_force(const scenes::Scene& scene, double buffer, const char* what) {
  ContactorGrid grid;
  grid.build(scene.contactors, buffer);
  std::vector<Couple> couples, found;
  BruteForce().search(scene.points, scene.contactors, buffer, couples);
  std::vector<Index> contactors;
  for (std::size_t p = 0; p < scene.points.size(); ++p) {
    grid.couples_of(scene.points[p], contactors);
    for (const Index c : contactors) found.push_back({static_cast<Index>(p), c});
  }
  EXPECT_EQ(found, couples) << what << ", buffer " << buffer;
  EXPECT_FALSE(couples.empty()) << what;
}

TEST(ContactorGrid, FindsForEveryPointWhatAFullSearchFinds) {
  for (const double buffer : {0.0, 0.05, 0.5}) {
    expect_as_brute_force(scenes::cloud(1, 200, 3, 0), buffer, "one size");
    expect_as_brute_force(scenes::cloud(2, 200, 3, 2.5), buffer, "sizes over 2.5 decades");
    expect_as_brute_force(scenes::cloud(3, 100, 3, 0, {-1e4, 1e5, -300}), buffer, "far from the origin");
    expect_as_brute_force(scenes::raster(4, 0.8), buffer, "raster");
  }
}

TEST(ContactorGrid, HoldsAFloorAThousandTimesWiderThanTheRest) {
  scenes::Scene scene = scenes::cloud(4, 200, 3, 0);
  scene.contactors.insert(scene.contactors.begin(), scenes::regular_tetrahedron(Vec3(0, 0, 0), 3000));
  expect_as_brute_force(scene, 0.1, "floor");
}

TEST(ContactorGrid, HasNothingForAPointThatIsNotFinite) {
  const scenes::Scene scene = scenes::raster(2, 1);
  ContactorGrid grid;
  grid.build(scene.contactors, 0.1);
  std::vector<Index> contactors{7};
  grid.couples_of({std::numeric_limits<double>::quiet_NaN(), 0, 0}, contactors);
  EXPECT_TRUE(contactors.empty());
}

TEST(ContactorGrid, PassesOverContactorsThatAreNotFinite) {
  scenes::Scene scene = scenes::raster(2, 1);
  scene.contactors[3][2][1] = std::numeric_limits<double>::infinity();
  expect_as_brute_force(scene, 0.1, "an infinite corner");
}

TEST(ContactorGrid, RefusesANegativeBuffer) {
  ContactorGrid grid;
  EXPECT_THROW(grid.build({}, -1), InternalError);
}

}  // namespace
}  // namespace breccia::detection::contactor_grid_test
