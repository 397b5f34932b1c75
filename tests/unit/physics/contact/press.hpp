#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

namespace breccia::test {

/// A lone tetrahedron over the flat face of a body. Its base hangs `depth` below the body's upper face;
/// one point of it is inside.
struct Press {
  test::Scene scene;

  static constexpr double kSize = 0.4;  // m

  explicit Press(double depth, const ContactLaw& law)
      : scene(test::joined(test::box({3, 3, 4}, 1.0), slider(depth)), law) {
    scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return scene.body(s) == 0; });
    scene.evaluate(0.0);  // set down
  }
  /// m2, of the base.
  static double area() { return std::sqrt(3.0) / 4 * kSize * kSize; }

  static Mesh slider(double depth) {
    return test::moved(test::lone(test::regular_tetra(kSize)),
                       [=](const Vec3& x) { return Vec3(x[2] + 1.537, x[1] + 1.341, 4 - depth - x[0]); });
  }
  /// Force on the tetrahedron, N, at the end of a step of 1 s in which it moves by so much.
  double move(double up) {
    scene.shift(1, {0, 0, up});
    scene.set_velocity(1, {0, 0, up});
    scene.evaluate(1.0);
    EXPECT_NEAR((scene.force_on(0) + scene.force_on(1)).norm(), 0, 1e-9) << "momentum";
    return scene.force_on(1)[2];
  }
  [[nodiscard]] double dissipated() const { return scene.work.dissipated.value(); }
};

}  // namespace breccia::test
