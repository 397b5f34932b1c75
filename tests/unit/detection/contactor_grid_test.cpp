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

TEST(contactor_grid, finds_for_every_point_what_a_full_search_finds) {
  for (const double buffer : {0.0, 0.05, 0.5}) {
    expect_as_brute_force(scenes::cloud(1, 200, 3, 0), buffer, "one size");
    expect_as_brute_force(scenes::cloud(2, 200, 3, 2.5), buffer, "sizes over 2.5 decades");
    expect_as_brute_force(scenes::cloud(3, 100, 3, 0, {-1e4, 1e5, -300}), buffer, "far from the origin");
    expect_as_brute_force(scenes::raster(4, 0.8), buffer, "raster");
  }
}

TEST(contactor_grid, holds_a_floor_a_thousand_times_wider_than_the_rest) {
  scenes::Scene scene = scenes::cloud(4, 200, 3, 0);
  scene.contactors.insert(scene.contactors.begin(), scenes::regular_tetrahedron(Vec3(0, 0, 0), 3000));
  expect_as_brute_force(scene, 0.1, "floor");
}

TEST(contactor_grid, has_nothing_for_a_point_that_is_not_finite) {
  const scenes::Scene scene = scenes::raster(2, 1);
  ContactorGrid grid;
  grid.build(scene.contactors, 0.1);
  std::vector<Index> contactors{7};
  grid.couples_of({std::numeric_limits<double>::quiet_NaN(), 0, 0}, contactors);
  EXPECT_TRUE(contactors.empty());
}

TEST(contactor_grid, passes_over_contactors_that_are_not_finite) {
  scenes::Scene scene = scenes::raster(2, 1);
  scene.contactors[3][2][1] = std::numeric_limits<double>::infinity();
  expect_as_brute_force(scene, 0.1, "an infinite corner");
}

TEST(contactor_grid, refuses_a_negative_buffer) {
  ContactorGrid grid;
  EXPECT_THROW(grid.build({}, -1), InternalError);
}

}  // namespace
}  // namespace breccia::detection::contactor_grid_test
