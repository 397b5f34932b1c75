#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "scene.hpp"

/// Overlap field that follows fracture, and couples made by it.
namespace breccia::contact_field_test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kPenalty = 1e6, kRoundOff = 1e-12;

TEST(OverlapField, OfALoneTetrahedronIsMadeOfItsHeightsAndFaces) {
  const test::Scene scene(test::lone(test::regular_tetra(1.0)), {kPenalty, kInfinite, 1, 0, 1});
  const FieldValues& values = scene.contact.field.at(0);
  for (const double depth : values.depth) EXPECT_NEAR(depth, std::sqrt(2.0 / 3.0), kRoundOff);
  EXPECT_EQ(values.sides, kOwnFaces);
}

TEST(OverlapField, HasTheSameLeastFunctionHoweverItIsFound) {
  ContactParams params;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> length(0.2, 1.0);
  for (int set = 0; set < 4000; ++set) {
    FieldValues values;
    std::array<double, 4> height{}, lambda{};
    for (std::size_t a = 0; a < 4; ++a) {
      values.depth[a] = length(random);
      height[a] = length(random);
      lambda[a] = length(random) - 0.1;  // outside as well
    }
    // Nothing in some: the depths alone; in others fracture alone, or faces and further sides at rest as well.
    if (set % 16 != 0) values.sides = largest_sets(static_cast<CornerSets>(random()) & kAllSets);
    if (set % 5 == 0) values.sides &= kFaceSets;
    if (set % 2 != 0) values.sides |= static_cast<SurfaceSides>(random()) & kOwnFaces;
    if (set % 3 != 0) {
      values.sides |= with_planes(random() % (kMostSides + 1));
      for (std::size_t k = 0; k < num_planes(values.sides); ++k) {
        for (std::size_t a = 0; a < 4; ++a) values.planes[k][a] = a == k % 4 ? 0.0 : length(random);
      }
    }
    const OverlapShape shape = overlap_shape(params, height, values, 1.0);
    const std::size_t least = least_row(shape, lambda);
    const OverlapFunction found = least_function(height, values, lambda);
    ASSERT_EQ(found.g, row_value(shape, least, lambda)) << values.sides;
    ASSERT_EQ(found.row, shape.row[least]) << values.sides;
  }
}

/// The first element of a cube, whose last corner, the centre of the cube, is freed with two others.
TEST(OverlapField, HasAFreedFaceAtOnceAndKnowsWhatItWasOneStepAgo) {
  test::Scene scene(test::box({1, 1, 1}, 2.0), {kPenalty, kInfinite, 1, 0, 1});
  const auto x = load_corners(scene.local, scene.local.reference.data(), scene.contact.contactors[0]);
  unsigned face = 0, set = 0;  // the corners on the surface; those of the new face
  for (unsigned a = 0; a < 4; ++a) {
    const bool is_centre = (x[a] - Vec3(1, 1, 1)).norm() < kRoundOff;
    if (!is_centre) face |= 1U << a;
    if (is_centre || std::popcount(set) < 2) set |= 1U << a;
  }
  if (std::popcount(set) == 2) set |= face & ~set & (~(face & ~set) + 1);
  const auto g = [&](Instant instant) {
    std::array<double, 4> lambda{};  // the middle of the new face
    for (unsigned a = 0; a < 4; ++a) lambda[a] = (set >> a & 1U) != 0 ? 1.0 / 3.0 : 0.0;
    return overlap_value(overlap_shape(scene.params, scene.local, scene.contact, 0, instant), lambda);
  };
  ASSERT_NEAR(g(Instant::now), 1.0 / 3.0, kRoundOff) << "the centre of the cube lies 1 deep";
  EXPECT_TRUE(has_sides(scene.params, scene.contact, 0));
  for (const unsigned freed : {set, set, set & ~face, face}) {  // other freed faces of the corners free them again
    free_corners(scene.params, 0, freed, scene.contact);
    EXPECT_EQ(scene.contact.changed.size(), 1U);
    EXPECT_EQ(g(Instant::now), 0);
    EXPECT_NEAR(g(Instant::step_before), 1.0 / 3.0, kRoundOff);
  }
  EXPECT_FALSE(has_sides(scene.params, scene.contact, 0)) << "they are not distinguished beside cracks";
  end_changes(scene.contact);
  EXPECT_EQ(g(Instant::step_before), 0);
  const SurfaceSides sides = scene.contact.field[0].sides;
  EXPECT_EQ(sides & kAllSets, 1 << set) << "what it covers is dropped";
  EXPECT_TRUE(on_one_face(sides, face));
}

TEST(OverlapField, OfAnElementThatHasComeOffIsThatOfATetrahedronAlone) {
  test::Scene scene(test::box({2, 2, 2}, 1.0), {kPenalty, kInfinite, 1, 0, 1});
  int came_off = 0;
  for (Index c = 0; c < static_cast<Index>(scene.contact.contactors.size()); ++c) {
    FieldValues& values = scene.contact.field[at(c)];
    came_off += num_planes(values.sides) > 0 ? 1 : 0;
    for (std::size_t a = 0; a < 4; ++a) free_corners(scene.params, c, face_set(a), scene.contact);
    EXPECT_EQ(num_planes(values.sides), 0U);
    EXPECT_EQ(overlap_shape(scene.params, scene.local, scene.contact, c).rows, 4U);
  }
  EXPECT_GT(came_off, 10);
}

/// A small tetrahedron whose base sits at a depth of 0.03 under the top of a body of 3 x 3 x 3 cubes, which lean over,
/// so that faces across the top look at the base as well.
struct Pressed {
  test::Scene scene;
  explicit Pressed(const ContactLaw& law)
      : scene(test::joined(test::moved(test::box({3, 3, 3}, 1.0),
                                       [](const Vec3& x) {
                                         return Vec3(x[0] - 0.5 * (x[2] - 3), x[1] - 0.5 * (x[2] - 3), x[2]);
                                       }),
                           test::moved(test::lone(test::regular_tetra(0.2)),
                                       [](const Vec3& x) { return Vec3(x[2] + 1.4, x[1] + 1.3, 2.97 - x[0]); })),
              law) {
    scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return scene.body(s) == 0; });
  }
  [[nodiscard]] double accounted() const { return scene.work.stored.value() + scene.work.dissipated.value(); }
};

TEST(OverlapField, CountsTheSameSidesAsLongAsACouplePressesWhicheverWayItsPointTurns) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.shift(1, {-1.2, 0, 0});  // beside an edge
  for (const Index node : scene.nodes_of(1)) store_node(scene.state.velocity.data(), node, Vec3::Zero());
  scene.evaluate(1e-3);
  ASSERT_EQ(scene.contact.touching.size(), 1U);
  const TouchingCouple before = scene.contact.touching[0];
  ASSERT_NE(sides_of(before.history), kAllRows) << "an element with several sides";
  const Vec3 place = at_point(face_rule(1), scene.contact.points[at(before.point)], scene.state.position.data());
  for (const Index node : scene.nodes_of(1)) {
    const Vec3 arm = load_node(scene.state.position.data(), node) - place;
    store_node(scene.state.position.data(), node, place + Eigen::AngleAxisd(1.7, Vec3::UnitY()) * arm);
    store_node(scene.state.velocity.data(), node, Vec3::Zero());
  }
  scene.evaluate(1e-3);
  const auto is_same = [&](const TouchingCouple& couple) { return couple.point == before.point; };
  const auto after = std::find_if(scene.contact.touching.begin(), scene.contact.touching.end(), is_same);
  ASSERT_NE(after, scene.contact.touching.end());
  EXPECT_EQ(after->history.sides, before.history.sides);
  EXPECT_NEAR(after->history.d, before.history.d, kRoundOff);
}

/// The corner of a contactor, of some, opposite to which lies the face that looks up the most.
std::size_t opposite_to_top(const test::Scene& scene, Index contactor, unsigned corners) {
  const Index slot = scene.contact.contactors[at(contactor)];
  const PreparedTetra tetra =
      prepare(load_corners(scene.local, scene.state.position.data(), slot), scene.local.volume[at(slot)]);
  std::size_t found = 0;
  double least = 1;
  for (std::size_t a = 0; a < 4; ++a) {
    OverlapShape lambda;  // the function lambda_a
    lambda.add({});
    lambda.row[0][a] = 1;
    const double up = row_gradient(lambda, 0, tetra).normalized()[2];
    if ((corners >> a & 1U) != 0 && up < least) {
      least = up;
      found = a;
    }
  }
  return found;
}

/// Frees the corner inside every contactor touched, and two others: its field sinks to next to nothing.
void sink_field(test::Scene& scene) {
  constexpr double kLeft = 1e-3;  // m, of the depth
  for (const TouchingCouple& touching : scene.contact.touching) {
    FieldValues& field = scene.contact.field[at(touching.contactor)];
    unsigned surface = 0;
    for (std::size_t a = 0; a < 4; ++a) surface |= has_face(field.sides, a) ? face_set(a) : 0;
    // A corner on the surface: its depth counts for nothing yet.
    const std::size_t kept = opposite_to_top(scene, touching.contactor, surface);
    field.depth[kept] = kLeft;
    free_corners(scene.params, touching.contactor, 15U ^ 1U << kept, scene.contact);
  }
}

TEST(OverlapField, ThatSinksUnderARestingPointAccountsWhatItTakesFromTheStoredEnergy) {
  for (const double b : {1.0, 2.0}) {
    Pressed pressed({kPenalty, kInfinite, b, 0, 1});
    test::Scene& scene = pressed.scene;
    scene.evaluate(1e-3);
    const double accounted = pressed.accounted();
    ASSERT_GT(scene.work.stored.value(), 0);
    sink_field(scene);
    for (int step = 0; step < 3; ++step) {
      scene.evaluate(1e-3);
      EXPECT_NEAR(pressed.accounted(), accounted, kRoundOff * accounted) << "no motion, no work";
    }
    EXPECT_LT(scene.work.stored.value(), 0.9 * accounted);
  }
}

TEST(OverlapField, KeepsTheBudgetClosedWhenItSinksUnderAMovingPoint) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.evaluate(1e-3);
  const double start = pressed.accounted();
  double done = 0, before = scene.force_on(1)[2];
  constexpr double step = 1e-5;  // m; what the trapezoid rule leaves goes with it
  for (int i = 0; i < 500; ++i) {
    if (i == 100) sink_field(scene);
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
TEST(CouplesOfFracture, StartWithoutForceAndDoNotPullByTheirLaw) {
  test::Scene scene(test::box({1, 1, 1}, 1.0), {kPenalty, kInfinite, 1, 0, 1}, 1, OverlapField::tet_potential);
  const Index target = scene.contact.contactors[0], other = scene.contact.contactors[13];
  scene.couple([&](Index s) { return s == target; }, [&](Index s) { return s == other; });
  const auto centroid = [&](Index s) {
    const auto x = load_corners(scene.local, scene.local.reference.data(), s);
    return Vec3(0.25 * (x[0] + x[1] + x[2] + x[3]));
  };
  const auto put = [&](double share) {  // the target's point goes this share of the way to the other's centroid
    const Field<double> before = scene.state.position;
    scene.state.position = scene.local.reference;
    const Vec3 x =
        at_point(face_rule(1), scene.contact.points[at(scene.contact.couples[0].point)], scene.local.reference.data());
    for (int c = 0; c < 4; ++c) {
      const Index n = scene.local.corner_node(target, c);
      store_node(scene.state.position.data(), n,
                 load_node(scene.local.reference.data(), n) + share * (centroid(other) - x));
    }
    for (std::size_t i = 0; i < before.size(); ++i)
      scene.state.velocity[i] = (scene.state.position[i] - before[i]) / 1e-3;
    scene.evaluate(1e-3);
    return scene.forces.get(scene.local.corner_node(target, 0)).norm();
  };
  EXPECT_EQ(put(0.9), 0) << "seen for the first time deep inside";
  ASSERT_EQ(scene.contact.touching.size(), 1u);
  const double offset = scene.contact.touching[0].history.offset;
  EXPECT_GT(offset, 0);
  const double pressed = put(1.0);
  EXPECT_GT(pressed, 0);
  (void)put(0.85);  // in one step a pull takes back what the contact has gained
  EXPECT_EQ(put(0.85), 0) << "drawn out: no pull by the law";
  EXPECT_LT(scene.contact.touching.at(0).history.offset, offset) << "the offset follows the retreat";
  EXPECT_GT(put(1.0), pressed) << "and the force grows from there";
}

TEST(CouplesOfFracture, OutlastAJointThatOpensBesideTheirElementAndAreCutOffFartherOut) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.evaluate(1e-3);
  ASSERT_EQ(scene.contact.touching.size(), 1u);
  // The neighbours are out of reach, as if they had moved away.
  const Index contactor = scene.contact.touching[0].contactor, slot = scene.contact.contactors[at(contactor)];
  scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return s == slot; });
  const auto corners = load_corners(scene.local, scene.state.position.data(), slot);
  const auto lambda = barycentric(
      prepare(corners, scene.local.volume[at(slot)]),
      at_point(face_rule(1), scene.contact.points[at(scene.contact.touching[0].point)], scene.state.position.data()));
  // From one corner on the surface to another one: at the same depth through the face opposite to the first.
  std::array<std::size_t, 2> on_surface{};
  for (std::size_t a = 0, found = 0; a < 4; ++a) {
    const bool is_on_surface = corners[a][2] > 3 - kRoundOff;
    if (is_on_surface && found < 2) on_surface[found++] = a;
    // A crack has come to the corner inside, far from the point.
    if (!is_on_surface) scene.contact.field[at(contactor)].sides |= 1 << (1U << a);
  }
  const Vec3 way = corners[on_surface[1]] - corners[on_surface[0]];
  const double force = scene.force_on(1)[2], stored = scene.work.stored.value();
  ASSERT_GT(force, 0);
  scene.shift(1, (lambda[on_surface[0]] + 0.005) * way);
  scene.evaluate(1e-3);
  EXPECT_NEAR(scene.force_on(1)[2], force, 1e-9 * force);
  EXPECT_EQ(scene.work.dissipated.value(), 0);
  scene.shift(1, 0.015 * way);
  scene.evaluate(1e-3);
  EXPECT_EQ(scene.force_on(1), Vec3(0, 0, 0));
  EXPECT_EQ(scene.work.stored.value(), 0);
  EXPECT_NEAR(scene.work.dissipated.value(), stored, 1e-9 * stored);
}

TEST(CouplesOfFracture, AreFreshForOneEvaluationOnly) {
  Pressed pressed({kPenalty, kInfinite, 1, 0, 1});
  test::Scene& scene = pressed.scene;
  scene.contact.fresh = scene.contact.couples;
  scene.evaluate(1e-3);
  ASSERT_EQ(scene.contact.touching.size(), 1u);
  EXPECT_NEAR(scene.contact.touching[0].history.offset, 0.03, 1e-12);
  EXPECT_EQ(scene.work.stored.value(), 0);
  EXPECT_TRUE(scene.contact.fresh.empty());
  scene.shift(1, {0, 0, 0.2});
  scene.evaluate(1e-3);
  scene.shift(1, {0, 0, -0.2});
  scene.evaluate(1e-3);
  EXPECT_EQ(scene.contact.touching.at(0).history.offset, 0) << "a later touch is a touch like any other";
}

}  // namespace
}  // namespace breccia::contact_field_test
