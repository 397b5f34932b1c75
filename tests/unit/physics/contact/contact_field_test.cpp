#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

/// Overlap field that follows fracture, and couples made by it.
namespace breccia {
namespace {

using test::at;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kPenalty = 1e6, kRoundOff = 1e-12;

TEST(overlap_field, is_zero_on_the_surface_and_carries_a_bubble_only_where_no_corner_is_inside) {
  const test::Scene scene(test::joined(test::box({1, 1, 1}, 2.0), test::lone(test::regular_tetra(1.0))),
                          {kPenalty, kInfinite, 1, 0, 1});
  for (std::size_t c = 0; c < scene.contact.contactors.size(); ++c) {
    const Index slot = scene.contact.contactors[c];
    const FieldValues& values = scene.contact.field[c];
    int inner = 0;
    for (int a = 0; a < 4; ++a) {
      const Vec3 x = load_node(scene.local.reference.data(), scene.local.corner_node(slot, a));
      const bool centre = scene.body(slot) == 0 && (x - Vec3(1, 1, 1)).norm() < kRoundOff;
      EXPECT_NEAR(values[at(a)], centre ? 1.0 : 0.0, kRoundOff);
      inner += centre;
    }
    EXPECT_NEAR(values[4], inner == 0 ? 1 / std::sqrt(24.0) : 0.0, kRoundOff);
  }
}

TEST(overlap_field, goes_to_its_target_linearly_and_then_rests) {
  test::Scene scene(test::box({1, 1, 1}, 2.0), {kPenalty, kInfinite, 1, 0, 1});
  scene.params.ramp_steps = 4;
  int corner = 0;
  while (scene.contact.field[0][at(corner)] == 0) ++corner;
  free_corner(scene.params, scene.local, 0, corner, scene.contact);
  const auto edges = [&](int a, int b) {
    const auto x = load_corners(scene.local, scene.local.reference.data(), scene.contact.contactors[0]);
    return Vec3(x[at(a)] - x[at(b)]);
  };
  double area = 0;
  for (const auto& f : kFaceCorners) area += 0.5 * edges(f[1], f[0]).cross(edges(f[2], f[0])).norm();
  const double inradius = 3 * scene.local.volume[at(scene.contact.contactors[0])] / area;
  for (int step = 1; step <= 6; ++step) {
    advance_field(scene.contact);
    const double share = std::min(step, 4) / 4.0;
    EXPECT_NEAR(scene.contact.field[0][at(corner)], 1 - share, kRoundOff);
    EXPECT_NEAR(scene.contact.field[0][4], share * inradius, kRoundOff);
  }
  EXPECT_TRUE(scene.contact.ramps.empty());
  EXPECT_EQ(scene.contact.ramp_of_contactor[0], -1);
}

TEST(overlap_field, of_a_corner_that_is_freed_again_goes_on_as_it_was) {
  test::Scene scene(test::box({1, 1, 1}, 2.0), {kPenalty, kInfinite, 1, 0, 1});
  scene.params.ramp_steps = 4;
  int corner = 0;
  while (scene.contact.field[0][at(corner)] == 0) ++corner;
  // Every face of the corner that fracture frees says so anew.
  for (int step = 1; step <= 4; ++step) {
    free_corner(scene.params, scene.local, 0, corner, scene.contact);
    const double bubble = step == 1 ? 0 : scene.contact.field[0][4];
    advance_field(scene.contact);
    EXPECT_NEAR(scene.contact.field[0][at(corner)], 1 - step / 4.0, kRoundOff) << "step " << step;
    EXPECT_GT(scene.contact.field[0][4], bubble) << "step " << step;
  }
  EXPECT_EQ(scene.contact.field[0][at(corner)], 0);
  const double risen = scene.contact.field[0][4];
  free_corner(scene.params, scene.local, 0, corner, scene.contact);
  advance_field(scene.contact);
  EXPECT_EQ(scene.contact.field[0][4], risen);
  EXPECT_TRUE(scene.contact.ramps.empty());
}

/// A small tetrahedron whose base sits at a depth of 0.03 under the top of a body of 3 x 3 x 3 cubes.
struct Pressed {
  test::Scene scene;
  explicit Pressed(const ContactLaw& law)
      : scene(test::joined(test::box({3, 3, 3}, 1.0),
                           test::moved(test::lone(test::regular_tetra(0.2)),
                                       [](const Vec3& x) { return Vec3(x[2] + 1.4, x[1] + 1.3, 2.97 - x[0]); })),
              law) {
    scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return scene.body(s) == 0; });
  }
  [[nodiscard]] double accounted() const { return scene.work.stored.value() + scene.work.dissipated.value(); }
};

/// Lets the field of every contactor touched go to `share` of its values within some steps.
void scale_field(test::Scene& scene, double share, Index steps) {
  for (const TouchingCouple& touching : scene.contact.touching) {
    const auto c = at(touching.contactor);
    FieldRamp ramp{
        touching.contactor, {steps, steps, steps, steps, steps}, scene.contact.field[c], scene.contact.field[c]};
    for (double& value : ramp.target) value *= share;
    scene.contact.ramp_of_contactor[c] = static_cast<Index>(scene.contact.ramps.size());
    scene.contact.ramps.push_back(ramp);
  }
}

TEST(overlap_field, that_sinks_under_a_resting_point_books_what_it_takes_from_the_stored_energy) {
  for (const double b : {1.0, 2.0}) {
    Pressed pressed({kPenalty, kInfinite, b, 0, 1});
    test::Scene& scene = pressed.scene;
    scene.evaluate(1e-3);
    const double stored = scene.work.stored.value(), accounted = pressed.accounted();
    ASSERT_GT(stored, 0);
    scale_field(scene, 0.5, 10);
    for (int step = 0; step < 12; ++step) {
      scene.evaluate(1e-3);
      EXPECT_NEAR(pressed.accounted(), accounted, kRoundOff * accounted) << "no motion, no work";
      // d falls by a twentieth of its first value in a step, the energy goes with d^(b+1).
      const double share = 1 - 0.05 * std::min(step + 1, 10);
      EXPECT_NEAR(scene.work.stored.value() / stored, std::pow(share, b + 1), kRoundOff);
    }
  }
}

TEST(overlap_field, that_rises_under_a_resting_point_pushes_nobody) {
  Pressed pressed({kPenalty, kInfinite, 2, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.evaluate(1e-3);
  const double force = scene.force_on(1)[2], stored = scene.work.stored.value(),
               dissipated = scene.work.dissipated.value();
  scale_field(scene, 2, 10);
  for (int step = 0; step < 12; ++step) scene.evaluate(1e-3);
  EXPECT_NEAR(scene.work.stored.value(), stored, kRoundOff * stored);
  EXPECT_NEAR(scene.work.dissipated.value(), dissipated, kRoundOff * stored);
  EXPECT_NEAR(scene.force_on(1)[2], 2 * force, kRoundOff * force) << "the same stress on a field twice as steep";
}

TEST(overlap_field, keeps_the_budget_closed_while_it_sinks_under_a_moving_point) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.evaluate(1e-3);
  scale_field(scene, 0.5, 400);
  const double start = pressed.accounted();
  double done = 0, before = scene.force_on(1)[2];
  constexpr double step = 1e-5;  // m; what the trapezoid rule leaves goes with it
  for (int i = 0; i < 500; ++i) {
    scene.shift(1, {0, 0, i < 250 ? -step : step});
    scene.evaluate(1e-3);
    const double force = scene.force_on(1)[2];
    done -= 0.5 * (before + force) * (i < 250 ? -step : step);
    before = force;
  }
  EXPECT_GT(scene.work.dissipated.value(), 0.05 * start);
  EXPECT_NEAR(pressed.accounted() - start, done, 2e-3 * start);
}

/// Two elements of one body that share a vertex but are no longer bonded, pushed into each other.
TEST(couples_of_fracture, start_without_force_and_never_pull) {
  test::Scene scene(test::box({1, 1, 1}, 1.0), {kPenalty, kInfinite, 1, 0, 1}, 1, OverlapField::tet_potential);
  const Index target = scene.contact.contactors[0], other = scene.contact.contactors[13];
  scene.couple([&](Index s) { return s == target; }, [&](Index s) { return s == other; });
  const auto centroid = [&](Index s) {
    const auto x = load_corners(scene.local, scene.local.reference.data(), s);
    return Vec3(0.25 * (x[0] + x[1] + x[2] + x[3]));
  };
  const auto put = [&](double share) {  // the target's point goes this share of the way to the other's centroid
    scene.state.position = scene.local.reference;
    const Vec3 x =
        at_point(face_rule(1), scene.contact.points[at(scene.contact.couples[0].point)], scene.local.reference.data());
    for (int c = 0; c < 4; ++c) {
      const Index n = scene.local.corner_node(target, c);
      store_node(scene.state.position.data(), n,
                 load_node(scene.local.reference.data(), n) + share * (centroid(other) - x));
    }
    scene.evaluate(1e-3);
    return scene.forces.get(scene.local.corner_node(target, 0)).norm();
  };
  EXPECT_EQ(put(0.9), 0) << "seen for the first time deep inside";
  ASSERT_EQ(scene.contact.touching.size(), 1u);
  const double offset = scene.contact.touching[0].offset;
  EXPECT_GT(offset, 0);
  const double pressed = put(1.0);
  EXPECT_GT(pressed, 0);
  EXPECT_EQ(put(0.85), 0) << "drawn out: no pull";
  EXPECT_LT(scene.contact.touching.at(0).offset, offset) << "the offset follows the retreat";
  EXPECT_GT(put(1.0), pressed) << "and the force grows from there";
}

TEST(couples_of_fracture, are_fresh_for_one_evaluation_only) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.contact.fresh = scene.contact.couples;
  scene.evaluate(1e-3);
  ASSERT_EQ(scene.contact.touching.size(), 1u);
  EXPECT_NEAR(scene.contact.touching[0].offset, 0.03, 1e-12);
  EXPECT_EQ(scene.work.stored.value(), 0);
  EXPECT_TRUE(scene.contact.fresh.empty());
  scene.shift(1, {0, 0, 0.2});
  scene.evaluate(1e-3);
  scene.shift(1, {0, 0, -0.2});
  scene.evaluate(1e-3);
  EXPECT_EQ(scene.contact.touching.at(0).offset, 0) << "a later touch is a touch like any other";
}

}  // namespace
}  // namespace breccia
