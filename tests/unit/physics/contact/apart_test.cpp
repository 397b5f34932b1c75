#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "unit/physics/contact/scene.hpp"

/// Couples that are sure to be apart are passed over: that must not change a bit.
namespace breccia::apart_test {
namespace {

constexpr double kWay = 2e-6;  // m

/// A box of 1 m and a small tetrahedron with its base down; one contact point a face.
test::Scene box_and_tetra() {
  constexpr double a = 0.1;
  const Mesh tetra = test::lone({Vec3(0, 0, 0), Vec3(a, 0, 0), Vec3(0, a, 0), Vec3(0, 0, a)});
  return {test::joined(test::box({1, 1, 1}, 1.0), tetra), {1e6, std::numeric_limits<double>::infinity(), 1, 0, 1}};
}

/// Turns the tetrahedron about its base's middle, which comes to lie at `base`, by an angle about the x axis.
void place_tetra(test::Scene& scene, const Vec3& base, double angle) {
  const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
  const Vec3 middle = Vec3(1, 1, 0) * (0.1 / 3);
  for (const Index n : scene.nodes_of(1)) {
    const Vec3 x = load_node(scene.local.reference.data(), n), before = load_node(scene.state.position.data(), n);
    const Vec3 now = base + rotation * (x - middle);
    store_node(scene.state.position.data(), n, now);
    store_node(scene.state.velocity.data(), n, (now - before) / 1e-3);
  }
}

/// Contactors that are touched after the tetrahedron has moved by no more than kWay.
std::vector<Index> touched(test::Scene scene, const Vec3& base, double angle, const Vec3& by, bool passing_over) {
  place_tetra(scene, base, angle);
  scene.state.velocity.assign(scene.state.velocity.size(), 0.0);
  if (passing_over) scene.contact.travel = 0;
  scene.evaluate(1e-3);
  place_tetra(scene, base + by, angle);
  if (passing_over) scene.contact.travel = by.norm();
  scene.evaluate(1e-3);
  std::vector<Index> contactors;
  for (const TouchingCouple& couple : scene.contact.touching) contactors.push_back(couple.contactor);
  return contactors;
}

TEST(Apart, IsNoCoupleWhosePointComesInThroughAFaceOrAnEdgeOrPassesToANeighbour) {
  const test::Scene scene = box_and_tetra();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> anywhere(-1, 1), inside(0.05, 0.95);
  int came_in = 0;
  for (int i = 0; i < 3000; ++i) {
    Vec3 base(inside(random), inside(random), inside(random));
    const int axis = i % 3, other = (axis + 1) % 3;
    base[axis] = 1 + kWay * anywhere(random);
    if (i % 2 == 0) base[other] = 1 + kWay * anywhere(random);
    const Vec3 by = kWay * Vec3(anywhere(random), anywhere(random), anywhere(random)) / 2;
    const std::vector<Index> expected = touched(scene, base, i, by, false);
    ASSERT_EQ(touched(scene, base, i, by, true), expected) << base.transpose();
    if (touched(scene, base, i, Vec3::Zero(), false) != expected) ++came_in;
  }
  EXPECT_GT(came_in, 100);
}

}  // namespace
}  // namespace breccia::apart_test
