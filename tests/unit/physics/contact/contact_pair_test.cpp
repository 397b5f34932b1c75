#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene.hpp"

/// Two tetrahedra face to face with imposed motion: the test of the non-elastic law. Source: [Schiava, 8.3.1 and
/// 8.3.2]
namespace breccia::contact_pair_test {
namespace {

constexpr double kEdge = 0.02;                    // m: face area 173.2 mm2
constexpr double kArea = 1.7320508075688772e-4;   // m2
constexpr double kHeight = 0.016329931618554522;  // m
constexpr double kPenalty = 90e6;                 // Pa
constexpr double kDeepest = 0.1 * kHeight;        // m: d = 4 x depth / height = 0.4
constexpr double kRoundOff = 1e-11;               // relative: d comes from differences of positions 1e-3 of their size

struct LawCase {
  const char* name;
  double plateau, exponent;
};
// C: the plateau is reached at half the greatest overlap, 0.2.
const LawCase kCases[] = {{"A", 60e6, 1}, {"B", 60e6, 2}, {"C", 0.2 * kPenalty, 2}};

/// Left tetrahedron fixed, right one mirrored; one centroid of each presses into the other.
struct Pair {
  test::Scene scene;
  double depth = 0;

  explicit Pair(const LawCase& c)
      : scene(test::joined(test::lone(test::regular_tetra(kEdge)),
                           test::moved(test::lone(turned()), [](const Vec3& x) { return x; })),
              {kPenalty, c.plateau, c.exponent, 0, 1}) {}

  /// The other side of the plane x = 0, positively oriented again.
  static std::array<Vec3, 4> turned() {
    std::array<Vec3, 4> x = test::regular_tetra(kEdge);
    for (Vec3& corner : x) corner[0] = -corner[0];
    std::swap(x[1], x[2]);
    return x;
  }

  /// Force along x on the right tetrahedron.
  double force_at(double new_depth) {
    scene.shift(1, {depth - new_depth, 0, 0});
    depth = new_depth;
    scene.evaluate(1e-6);
    return scene.force_on(1)[0];
  }
};

/// The law as printed in the method, for both points.
double expected(const LawCase& c, double depth, double deepest) {
  const double d = 4 * depth / kHeight, d_max = 4 * deepest / kHeight;
  if (d <= 0) return 0;
  const double top = std::min(kPenalty * d_max, c.plateau);
  return 2 * kArea * (d >= d_max ? top : top * std::pow(d / d_max, c.exponent));
}

void follow(const LawCase& c, const std::vector<double>& turning_depths) {
  Pair pair(c);
  double depth = -1e-4, deepest = 0;
  constexpr int steps = 50;
  for (const double next : turning_depths) {
    for (int i = 1; i <= steps; ++i) {
      const double here = depth + (next - depth) * i / steps;
      deepest = here <= 0 ? 0 : std::max(deepest, here);
      EXPECT_NEAR(pair.force_at(here), expected(c, here, deepest), kRoundOff * 2 * kArea * kPenalty)
          << c.name << " at " << here;
    }
    depth = next;
  }
}

TEST(ContactPair, TestAFollowsTheClosedFormInOneApproachAndRetreat) {
  for (const LawCase& c : kCases) follow(c, {kDeepest, -1e-4});
}

TEST(ContactPair, TestBReloadsAlongTheUnloadingCurveWithoutAJump) {
  for (const LawCase& c : kCases)
    follow(c, {0.6 * kDeepest, 0.2 * kDeepest, kDeepest, 0.5 * kDeepest, 0.9 * kDeepest, -1e-4});
}

TEST(ContactPair, ASecondContactStartsAfresh) {
  for (const LawCase& c : kCases) follow(c, {kDeepest, -1e-4, 0.5 * kDeepest, -1e-4});
}

TEST(ContactPair, BooksWhatTheClosedFormsReturnAndKeep) {
  for (const LawCase& c : kCases) {
    Pair pair(c);
    for (int i = 0; i <= 40; ++i) pair.force_at(kDeepest * i / 40);
    const double d = 4 * kDeepest / kHeight, inradius = kHeight / 4;
    const double yield = std::min(d, c.plateau / kPenalty);
    const double put_in = 2 * kArea * inradius * kPenalty * (0.5 * yield * yield + yield * (d - yield));
    const double g = d / yield;
    const double share = 2 / (c.exponent + 1) * g / (2 * g - 1);
    EXPECT_NEAR(pair.scene.work.stored.value(), share * put_in, kRoundOff * put_in) << c.name;
    EXPECT_NEAR(pair.scene.work.dissipated.value(), (1 - share) * put_in, kRoundOff * put_in) << c.name;
    EXPECT_EQ(pair.scene.work.touching, 2);
    const double lost = pair.scene.work.dissipated.value();
    for (int i = 39; i >= -1; --i) pair.force_at(kDeepest * i / 40);
    EXPECT_EQ(pair.scene.work.stored.value(), 0) << c.name;
    EXPECT_EQ(pair.scene.work.dissipated.value(), lost) << c.name;
  }
}

TEST(ContactPair, GroupsSeeEqualAndOppositeForces) {
  Pair pair(kCases[0]);
  const double force = pair.force_at(kDeepest);
  const auto force_on = [&](Index group) {
    const LocalMesh& local = pair.scene.local;
    const auto holds = [&](Index slot) { return local.block_group[static_cast<std::size_t>(slot / kLanes)] == group; };
    return contact_force_on(pair.scene.contact, local, holds)[0].value();
  };
  EXPECT_NEAR(force_on(1), force, kRoundOff * force);
  EXPECT_NEAR(force_on(0), -force, kRoundOff * force);
}

TEST(ContactPair, LeavesTheWorkAtPointsOfAnotherRankToThatRank) {
  Pair pair(kCases[1]), shared(kCases[1]);
  for (Index s = 0; s < shared.scene.local.num_slots; ++s) {
    if (shared.scene.body(s) == 1) shared.scene.local.original[at(s)] = 0;
  }
  const double force = pair.force_at(kDeepest);
  EXPECT_EQ(shared.force_at(kDeepest), force) << "the forces are computed on both";
  EXPECT_EQ(shared.scene.work.touching, 1);
  for (const auto sum : {&ContactWork::stored, &ContactWork::dissipated}) {
    const double whole = (pair.scene.work.*sum).value();
    EXPECT_NEAR((shared.scene.work.*sum).value(), 0.5 * whole, kRoundOff * whole);
  }
}

TEST(ContactPair, ACrushedContactorBooksWhatItNoLongerReturns) {
  Pair pair(kCases[0]);
  pair.force_at(kDeepest);
  const double stored = pair.scene.work.stored.value();
  // Flattened to a thousandth along x about the contact plane: neither tetrahedron is a contactor any more.
  for (const Index body : {0, 1}) {
    for (const Index n : pair.scene.nodes_of(body)) {
      Vec3 x = load_node(pair.scene.state.position.data(), n);
      x[0] *= 1e-3;
      store_node(pair.scene.state.position.data(), n, x);
    }
  }
  pair.scene.evaluate(1e-6);
  EXPECT_EQ(pair.scene.work.stored.value(), 0);
  EXPECT_NEAR(pair.scene.work.dissipated.value(), stored, kRoundOff * stored);
}

/// No couples, but a sphere; where the pair is made the base's centroid is 2 mm beyond it.
void put_into_sphere(test::Scene& scene) {
  scene.contact.couples.clear();
  couples_replaced(scene.contact);
  scene.params.sphere = SphericalBoundary{{-0.03, 0, 0}, 0.028, 5e6};
}

TEST(ContactPair, ASpherePushesPointsBackWithTheForceOfItsEnergy) {
  Pair pair(kCases[0]);
  test::Scene& scene = pair.scene;
  put_into_sphere(scene);
  const double inradius = kHeight / 4;
  // Only the centroid of the right tetrahedron's back faces and both base centroids lie beyond: look at one base alone.
  for (const double x : {-0.01, -0.001, 0.002}) {
    scene.state.position = scene.local.reference;
    scene.shift(0, {x, 0, 0});
    scene.shift(1, {-0.03 - 0.004, 0, 0});  // well inside
    scene.evaluate(1e-6);
    const double beyond = std::max(0.0, x + 0.03 - 0.028);
    EXPECT_NEAR(scene.force_on(0)[0], -kArea * 5e6 * beyond / inradius, kRoundOff * kArea * 5e6);
    EXPECT_NEAR(scene.work.stored.value(), 0.5 * kArea * 5e6 * beyond * beyond / inradius, kRoundOff * kArea * 5e6);
    EXPECT_EQ(scene.contact.boundary.size(), beyond > 0 ? 1u : 0u);
  }
}

TEST(ContactPair, ASphereGivesBackWhatItTookHoweverFastAPointComesAndGoes) {
  constexpr double kStep = 1e-6;  // s
  for (const double out : {0.0003, 0.0007, 0.0011}) {
    for (const double back : {0.0001, 0.0005, 0.0013}) {
      Pair pair(kCases[0]);
      test::Scene& scene = pair.scene;
      put_into_sphere(scene);
      scene.shift(1, {-0.03 - 0.004, 0, 0});  // well inside
      scene.shift(0, {-0.004, 0, 0});         // the base's centroid 2 mm within
      scene.evaluate(kStep);
      double place = -0.002, force = 0, work = 0, most = 0;
      const auto move = [&](double by) {
        scene.set_velocity(0, {by / kStep, 0, 0});
        scene.shift(0, {by, 0, 0});
        scene.evaluate(kStep);
        const double now = scene.force_on(0)[0];
        work += 0.5 * (force + now) * by;
        most = std::max(most, scene.work.stored.value());
        force = now;
        place += by;
      };
      while (place < 0.002) move(out);
      EXPECT_NEAR(-work, most, 1e-9 * most) << out;
      while (place > -0.002) move(-back);
      EXPECT_EQ(scene.work.stored.value(), 0.0);
      EXPECT_NEAR(work, 0.0, 1e-9 * most) << out << ", " << back;
    }
  }
}

TEST(ContactPair, ASphereTakesAPointThatIsOutsideWhenFirstSeenAsFarAsItCameIn) {
  Pair pair(kCases[0]);
  test::Scene& scene = pair.scene;
  put_into_sphere(scene);
  scene.shift(1, {-0.03 - 0.004, 0, 0});  // well inside
  const auto force_beyond = [&](double beyond) {
    scene.shift(0, {beyond - 0.002 - pair.depth, 0, 0});  // the base's centroid starts 2 mm beyond
    pair.depth = beyond - 0.002;
    scene.evaluate(1e-6);
    return scene.force_on(0)[0];
  };
  EXPECT_EQ(force_beyond(0.002), 0);
  EXPECT_EQ(force_beyond(0.001), 0);
  const double expected = -kArea * 5e6 * 0.0005 / (kHeight / 4);
  EXPECT_NEAR(force_beyond(0.0015), expected, kRoundOff * kArea * 5e6);
  EXPECT_EQ(force_beyond(0.001), 0);
}

}  // namespace
}  // namespace breccia::contact_pair_test
