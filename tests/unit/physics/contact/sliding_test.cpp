#include <gtest/gtest.h>

#include <cmath>

#include "physics/contact/evaluate.hpp"
#include "scene.hpp"

/// A lone tetrahedron dragged along under the flat face of a body of many elements.
namespace breccia::sliding_test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kPenalty = 1e6, kRoundOff = 1e-11;
constexpr double kSize = 0.4;  // m, edge of the slider; cubes of the body have edge 1
constexpr double kTop = 4;     // m, of the body

/// The slider's base hangs at z = 4 - depth, its apex above: only the base's centroid lies in the body.
struct Drag {
  test::Scene scene;

  explicit Drag(const ContactLaw& law, double depth)
      : scene(test::joined(test::box({6, 3, 4}, 1.0), slider(depth)), law) {
    scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return scene.body(s) == 0; });
  }

  static Mesh slider(double depth) {
    // Base in z = 0 facing down, apex at the height above.
    return test::moved(test::lone(test::regular_tetra(kSize)),
                       [=](const Vec3& x) { return Vec3(x[2] + 1.037, x[1] + 1.241, 4 - depth - x[0]); });
  }

  Vec3 move(const Vec3& by) {
    scene.shift(1, by);
    scene.set_velocity(1, by);  // dt = 1
    scene.evaluate(1.0);
    return scene.force_on(1);
  }
};

double area() { return std::sqrt(3.0) / 4 * kSize * kSize; }

TEST(Sliding, AtConstantDepthHasAConstantNormalForceAndNoTangentialForce) {
  constexpr double ripple = 0.01, depth = 0.1;
  Drag drag({kPenalty, kInfinite, 1, 0, 1}, depth);
  const double expected = area() * kPenalty * depth / drag.scene.contact.body_length[0];
  drag.move({0, 0, 0});  // set down at that depth
  for (int i = 0; i < 800; ++i) {
    const Vec3 force = drag.move({0.005, 0.0011, 0});
    ASSERT_NEAR(force[2] / expected, 1, ripple) << "step " << i;
    ASSERT_NEAR(std::hypot(force[0], force[1]) / expected, 0, ripple) << "step " << i;
    ASSERT_EQ(drag.scene.contact.touching.size(), 1u);
  }
}

/// Friction 0.5, late by up to 10 s for each metre of the smaller body, that of the slider.
Drag settled_drag(double depth) {
  Drag drag({kPenalty, kInfinite, 1, 0.5, 1, 0, 10}, depth);
  drag.move({0, 0, 0});
  for (int i = 0; i < 100; ++i) drag.move({0.02, 0, 0});
  return drag;
}
double longest_delay(const Drag& drag) { return 10 * drag.scene.contact.body_extent[1]; }
double depth_of(const Drag& drag) {
  return drag.scene.contact.touching.front().history.d * drag.scene.contact.body_length[0];
}

TEST(Sliding, FrictionFollowsTheNormalForceLateByCrossingsOfTheSmallerBody) {
  Drag drag = settled_drag(0.02);
  const Vec3 before = drag.move({0.02, 0, 0});
  EXPECT_NEAR(-before[0] / before[2], 0.5, 0.01);
  const Vec3 deeper = drag.move({0.02, 0, -0.02});
  const double step = 1 / (0.5 * longest_delay(drag));  // of each of the two stages
  ASSERT_LT(step, 0.4);
  EXPECT_NEAR(-deeper[0], 0.5 * (before[2] + step * step * (deeper[2] - before[2])), 0.01 * before[2]);
}

TEST(Sliding, FrictionGoesOnFromTheNormalForceBeforeAShortLift) {
  Drag drag = settled_drag(0.02);
  const double depth = depth_of(drag);
  DelayedForce before;
  double lifted = 0;
  for (; drag.scene.contact.touching.front().history.d > 0; lifted += 0.002) {
    before = drag.scene.contact.touching.front().history.delayed;
    drag.move({0, 0, 0.002});
  }
  for (int i = 0; i < 4; ++i) drag.move({0, 0, 5e-4});
  ASSERT_EQ(drag.scene.contact.touching.size(), 1U);
  ASSERT_LT(drag.scene.contact.touching.front().history.force.norm(), 1e-9 * before.force);
  drag.scene.contact.touching.front().history.force = Vec3::Zero();  // nothing is left but its history
  ASSERT_EQ(drag.scene.contact.touching.front().history.d, 0);
  EXPECT_EQ(drag.scene.contact.touching.front().history.delayed.force, before.force);
  EXPECT_NEAR(drag.scene.contact.touching.front().history.delayed.age, before.age - 5, kRoundOff * before.age);
  const double force = drag.move({0, 0, -lifted - 0.002 - depth})[2];
  ASSERT_GT(force, 1.9 * before.force);
  EXPECT_LT(drag.scene.contact.touching.front().history.delayed.force, 0.5 * (before.force + force));
}

TEST(Sliding, FrictionForgetsTheNormalForceOfACoupleThatLiesWithoutForce) {
  Drag drag = settled_drag(0.02);
  const double age = drag.scene.contact.touching.front().history.delayed.age;
  drag.scene.contact.touching.front().history.offset = 1;  // m
  drag.move({0, 0, 0});
  ASSERT_EQ(drag.scene.contact.touching.size(), 1U);
  ASSERT_EQ(drag.scene.contact.touching.front().history.d, 0);
  EXPECT_NEAR(drag.scene.contact.touching.front().history.delayed.age, age - 1, kRoundOff * age);
}

TEST(Sliding, APointThatIsDeepInsideAtOnceStartsWithoutForce) {
  // As through a gap that has opened between elements: it has not moved as far as it is deep.
  Drag drag({kPenalty, kInfinite, 1, 0, 1}, 0.1);
  EXPECT_LT(drag.move({0.005, 0, 0}).norm(), 0.11 * area() * kPenalty * 0.1 / drag.scene.contact.body_length[0]);
}

TEST(Sliding, OverAnEdgeIsNotPushedBackByTheSideThatThePointComesInThrough) {
  // The point looks down and comes in through the side x = 0, nearer to it at first than to the face on top.
  constexpr double depth = 0.05, step = 0.005;
  Drag drag({kPenalty, kInfinite, 1, 0, 1}, depth);
  drag.scene.shift(1, {-1.2, 0, 0});
  drag.move({0, 0, 0});
  ASSERT_TRUE(drag.scene.contact.touching.empty()) << "outside";
  const double full = area() * kPenalty * depth / drag.scene.contact.body_length[0];
  constexpr double kSmall =
      1.001 * kSameSlope * step / depth;  // of the force at that depth: a first overlap's round-off
  for (double way = 0; way < 0.5; way += step)
    ASSERT_NEAR(drag.move({step, 0, 0}).norm() / full, 0, kSmall) << "after " << way << " m";
  ASSERT_FALSE(drag.scene.contact.touching.empty()) << "inside";
  const Vec3 pressed = drag.move({0, 0, -0.2 * depth});
  EXPECT_NEAR(pressed[2] / full, 0.2, kSmall) << "the face on top holds it";
  EXPECT_NEAR(std::hypot(pressed[0], pressed[1]) / full, 0, kSmall);
}

TEST(Sliding, HandsTheHistoryFromElementToElement) {
  // Pressed in to 0.1, lifted to 0.05, then dragged: the force must stay on the unloading curve all the way.
  Drag drag({kPenalty, kInfinite, 2, 0, 1}, 0.1);
  const double h = drag.scene.contact.body_length[0];
  drag.move({0, 0, 0});
  drag.move({0, 0, 0.05});
  const double unloaded = drag.move({0, 0, 0})[2];  // a curved law, in one step, is balanced in that step
  EXPECT_NEAR(unloaded, area() * kPenalty * 0.1 / h * 0.25, kRoundOff * kPenalty);
  Index first = drag.scene.contact.touching[0].contactor;
  int hand_overs = 0;
  for (int i = 0; i < 600; ++i) {
    const double force = drag.move({0.005, 0.0013, 0})[2];
    ASSERT_NEAR(force, unloaded, 1e-9 * unloaded) << "step " << i;
    ASSERT_NEAR(drag.scene.contact.touching[0].history.d_max, 0.1 / h, kRoundOff / h);
    hand_overs += drag.scene.contact.touching[0].contactor != first;
    first = drag.scene.contact.touching[0].contactor;
  }
  EXPECT_GE(hand_overs, 5);
}

/// Dragged from elements with the body's field into others whose field is higher by `change`, as where fracture has
/// parted them. Returns the largest change of the force within a step.
double largest_change_of_force(Drag& drag, double change, double step) {
  ContactState& contact = drag.scene.contact;
  for (std::size_t c = 0; c < contact.contactors.size(); ++c) {
    const auto x = load_corners(drag.scene.local, drag.scene.state.position.data(), contact.contactors[c]);
    if (0.25 * (x[0] + x[1] + x[2] + x[3])[0] < 2.5) continue;
    for (std::size_t a = 0; a < 4; ++a) contact.field[c].depth[a] = kTop - x[a][2] + change;
    contact.field[c].sides = 0;
  }
  double before = drag.move({0, 0, 0})[2], largest = 0;
  for (int i = 0; i < 400; ++i) {
    const double force = drag.move({step, 0, 0})[2];
    largest = std::max(largest, std::abs(force - before));
    before = force;
  }
  return largest;
}

TEST(Sliding, IntoAnElementOfAnotherFieldIsAChangeOfFieldAndNotOfDepth) {
  constexpr double depth = 0.1, jump = 0.05, step = 0.005, few_percent = 0.05;
  const ContactLaw law{kPenalty, kInfinite, 1, 0, 1};
  Drag rising(law, depth), sinking(law, depth);
  const double a_metre = area() * kPenalty / rising.scene.contact.body_length[0];
  EXPECT_LT(largest_change_of_force(rising, jump, step), few_percent * step * a_metre) << "pushes nobody";
  EXPECT_NEAR(rising.scene.work.dissipated.value(), 0, 1e-9 * a_metre);
  (void)largest_change_of_force(sinking, -jump, step);
  // The point moves along the surface: all that the overlap shrinks by is let go of.
  const double lost = 0.5 * a_metre * (depth * depth - (depth - jump) * (depth - jump));
  EXPECT_NEAR(sinking.scene.work.dissipated.value() / lost, 1, few_percent);
}

/// The elements of a body overlap, as where the joints between them are pressed together.
void swell(test::Scene& scene, Index body, double factor) {
  for (const Index slot : scene.local.slot_of_element) {
    if (scene.body(slot) != body) continue;
    const std::array<Vec3, 4> x = load_corners(scene.local, scene.state.position.data(), slot);
    const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    for (std::size_t c = 0; c < 4; ++c)
      store_node(scene.state.position.data(), scene.local.corner_node(slot, static_cast<int>(c)),
                 centre + factor * (x[c] - centre));
  }
}

/// The base's centroid runs exactly along y = 1, a plane of element faces and edges.
void drag_along_a_border(double swollen) {
  Drag drag({kPenalty, kInfinite, 1, 0, 1}, 0.1);
  swell(drag.scene, 0, swollen);
  const ContactPoint* base = nullptr;
  for (const ContactPoint& p : drag.scene.contact.points) {
    const Vec3 x = at_point(face_rule(1), p, drag.scene.state.position.data());
    if (drag.scene.body(p.slot) == 1 && std::abs(x[2] - 3.9) < 1e-12) base = &p;
  }
  ASSERT_NE(base, nullptr);
  const Vec3 x = at_point(face_rule(1), *base, drag.scene.state.position.data());
  drag.scene.shift(1, {1.0 - x[0], 1.0 - x[1], 0});
  drag.move({0, 0, 0});  // set down there
  const double expected = area() * kPenalty * 0.1 / drag.scene.contact.body_length[0];
  for (int i = 0; i < 256; ++i) ASSERT_NEAR(drag.move({1.0 / 64, 0, 0})[2] / expected, 1, 0.01) << "step " << i;
}

TEST(Sliding, AlongTheBordersOfElementsCountsEachPointOnce) {
  drag_along_a_border(1.0);
  drag_along_a_border(1.0001);
}

TEST(Sliding, ForgetsTheHistoryAsSoonAsThePointHasLeft) {
  Drag drag({kPenalty, kInfinite, 3, 0, 1}, 0.1);
  const double pushed = drag.move({0, 0, 0})[2];
  // Half of the last force over 0.11 m is more than the quarter of it over 0.1 m that was held.
  EXPECT_NEAR(drag.move({0, 0, 0.11})[2], -(0.5 * 0.11 - 0.25 * 0.1) / 0.11 * pushed, kRoundOff * kPenalty);
  EXPECT_EQ(drag.move({0, 0, 0.11})[2], 0) << "the second half of its work is done";
  EXPECT_TRUE(drag.scene.contact.touching.empty());
  const double h = drag.scene.contact.body_length[0];
  drag.move({0, 0, -0.17});
  EXPECT_NEAR(drag.move({0, 0, 0})[2], area() * kPenalty * 0.05 / h, kRoundOff * kPenalty)
      << "loads along the penalty again";
}

TEST(Sliding, WithFrictionDragsWithMuTimesTheNormalForceAndBooksTheSlip) {
  constexpr double mu = 0.3, depth = 0.1;
  Drag drag({kPenalty, kInfinite, 1, mu, 1}, depth);
  const double h = drag.scene.contact.body_length[0];
  const double normal = area() * kPenalty * depth / h, stiffness = area() * kPenalty / h;
  drag.move({0, 0, 0});
  double path = 0;
  for (int i = 0; i < 700; ++i) {
    const Vec3 force = drag.move({0.005, 0, 0});
    path += 0.005;
    ASSERT_NEAR(force[0], -std::min(mu * normal, stiffness * path), 1e-9 * normal) << "step " << i;
  }
  const double spring = mu * normal / stiffness;
  EXPECT_NEAR(drag.scene.work.friction_stored.value(), 0.5 * stiffness * spring * spring, 1e-9 * normal);
  EXPECT_NEAR(drag.scene.work.friction_dissipated.value(), mu * normal * (path - spring), 1e-9 * normal * path);
}

TEST(Sliding, ThatEndsWhileItSticksBooksWhatTheSpringHeldAndWhatItDidOnTheLastWay) {
  constexpr double mu = 0.3, depth = 0.1, spring = 0.02, last = 0.004;
  Drag drag({kPenalty, kInfinite, 1, mu, 1}, depth);
  const double stiffness = area() * kPenalty / drag.scene.contact.body_length[0];
  drag.move({0, 0, 0});
  for (int i = 0; i < 4; ++i) drag.move({spring / 4, 0, 0});
  EXPECT_NEAR(drag.scene.work.friction_dissipated.value(), 0, 1e-12 * stiffness) << "it sticks";
  drag.move({last, 0, 0.11});
  EXPECT_EQ(drag.scene.work.touching, 0);
  // Half of the force over the last way, as the force that follows is zero; it opposes the motion.
  const double expected = 0.5 * stiffness * spring * spring + 0.5 * stiffness * spring * last;
  EXPECT_NEAR(drag.scene.work.friction_dissipated.value(), expected, 1e-9 * expected);
}

}  // namespace
}  // namespace breccia::sliding_test
