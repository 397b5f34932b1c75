#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/physics/contact/scene.hpp"

/// Sides of sharp bodies look past those that they come down on, nearly.
namespace breccia::sharp_test {
namespace {

constexpr double kLength = 0.5;  // m
constexpr double kDegree = 3.14159265358979323846 / 180;

/// An upright prism with its sharp edge down, along x; at its middle (0.5, 0.5, `height`). @param opening  rad
Mesh wedge(double opening, double height) {
  const double half = kLength * std::tan(0.5 * opening);
  Mesh mesh = test::box({1, 1, 1}, 1.0);
  for (Vec3& x : mesh.nodes)
    x = Vec3(0.5 + 0.4 * (x[0] - 0.5), 0.5 + (x[1] - 0.5) * 2 * half * (0.001 + x[2]), height + kLength * x[2]);
  return mesh;
}

/// N, upwards, on a wedge that has gone down into a box of 1 m.
double force_on_wedge(double opening, double depth) {
  constexpr double kAbove = 0.001, kStep = 0.002;  // m
  test::Scene scene(test::joined(test::box({3, 3, 3}, 1.0 / 3), wedge(opening, 1 + kAbove)),
                    {1e6, std::numeric_limits<double>::infinity(), 1, 0, 1}, 4);
  const Vec3 down(0, 0, -kStep);
  scene.set_velocity(1, down);  // in steps of 1 s
  for (double way = 0; way < kAbove + depth; way += kStep) {
    scene.shift(1, down);
    scene.evaluate(1);
  }
  return scene.force_on(1)[2];
}

TEST(Sharp, WedgesAreHeldByTheFlatFaceThatTheyComeDownOn) {
  for (const double opening : {60.0, 30.0, 11.0, 8.0, 4.0, 2.0})
    EXPECT_GT(force_on_wedge(opening * kDegree, 0.02), 0) << opening << " degrees";
}

}  // namespace
}  // namespace breccia::sharp_test
