#include "physics/joint_law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "unit/physics/joints/point_driver.hpp"

namespace breccia::joint_law_test {
namespace {

using test::axes;
using test::example_law;
using test::opening_of;
using test::PointDriver;
using test::prepared;
using testing::HasSubstr;

constexpr double kDigits = 1e-5;  // the printed figures have six digits

TEST(JointLaw, SofteningWidthIsThatOfTheExampleWorkedByHand) {
  EXPECT_NEAR(test::reference_law(JointRise::linear).width_normal / 15.5467e-6, 1.0, kDigits);
  EXPECT_NEAR(test::reference_law(JointRise::parabolic).width_shear / 15.5467e-6, 1.0, kDigits);
  EXPECT_NEAR(prepared(example_law()).width_normal / 10.681e-6, 1.0, 5e-5);  // printed with five digits
}

TEST(JointLaw, PeaksStandWhereTheRisePutsThem) {
  EXPECT_NEAR(test::reference_law(JointRise::linear).onset_normal / 3.759e-6, 1.0, 2e-4);     // h f/p, four digits
  EXPECT_NEAR(test::reference_law(JointRise::parabolic).onset_normal / 7.519e-6, 1.0, 2e-4);  // 2 h f/p
}

TEST(JointLaw, RefusesAnEnergyThatTheElasticPartAloneHolds) {
  const double held = 25e12 / (2 * example_law().stiffness);  // f^2/(2k)
  for (const bool whole : {true, false}) {
    JointLawParams law = example_law();
    law.energy_of_whole_curve = whole;
    law.energy_mode_1 = held * (1 + 1e-9);
    EXPECT_EQ(prepare(law), "");
    law.energy_mode_1 = held * (1 - 1e-9);
    EXPECT_THAT(prepare(law), HasSubstr("penalty too soft for this strength and energy in mode I:"));
    law.energy_mode_1 = 30;
    law.energy_mode_2 = held / 4;
    EXPECT_THAT(prepare(law), HasSubstr("in mode II"));
    EXPECT_THAT(prepare(law), HasSubstr("by more than a factor of 4"));
  }
}

TEST(JointLaw, RefusesNumbersAndCombinationsWithoutMeaning) {
  const auto problem = [](auto change) {
    JointLawParams law = example_law();
    change(law);
    return prepare(law);
  };
  EXPECT_THAT(problem([](JointLawParams& l) { l.stiffness = 0; }), HasSubstr("stiffness"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.stiffness = std::numeric_limits<double>::infinity(); }),
              HasSubstr("stiffness"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.tensile_strength = -1; }), HasSubstr("tensile"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.cohesion = std::nan(""); }), HasSubstr("shear strength"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.energy_mode_2 = 0; }), HasSubstr("mode II"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.friction = -0.1; }), HasSubstr("friction"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.points_to_fail = 4; }), HasSubstr("points_to_fail"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.rise = JointRise::parabolic; }), HasSubstr("independent_peaks"));
  EXPECT_THAT(problem([](JointLawParams& l) { l.softening.c = 0; }), HasSubstr("softening curve"));
  EXPECT_THAT(problem([](JointLawParams& l) {
                l.law = JointLaw::independent_peaks;
                l.rise = JointRise::parabolic;
                l.friction = 0.5;
              }),
              HasSubstr("friction"));
}

TEST(JointLaw, TellsAllProblemsAtOnce) {
  JointLawParams law = example_law();
  law.tensile_strength = 0;
  law.points_to_fail = 0;
  law.softening.c = 0;
  EXPECT_THAT(prepare(law), testing::AllOf(HasSubstr("tensile"), HasSubstr("points_to_fail"), HasSubstr("softening")));
}

TEST(JointLaw, BelowTheScreenLimitIsElasticInEveryDirectionToTheLastBit) {
  JointLawParams law = example_law();
  law.cohesion = 3 * test::kStrength;
  law.energy_mode_2 = 10 * test::kEnergy;
  law.friction = 0.6;
  law = prepared(law);
  ASSERT_GT(law.screen_limit(), 0);
  std::mt19937 random(3);
  std::normal_distribution<double> part;
  for (int i = 0; i < 10000; ++i) {
    Vec3 opening(part(random), part(random), part(random));
    if (i == 0) opening = Vec3(0, 0, 1);  // the weakest of all
    opening *= std::sqrt(law.screen_limit()) * (1 - 1e-15) / opening.norm();
    JointPointHistory<double> history;
    const JointPointResponse r = evaluate_point(law, axes(), opening, history);
    ASSERT_TRUE(r.elastic);
    for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(r.traction[axis], law.stiffness * opening[axis]);
  }
}

TEST(JointLaw, ScreenLimitIsNoSmallerThanTheWeakestDirectionNeeds) {
  const JointLawParams law = prepared(example_law());
  JointPointHistory<double> history;
  (void)evaluate_point(law, axes(), Vec3(0, 0, std::sqrt(law.screen_limit()) * (1 + 1e-6)), history);
  EXPECT_GT(history.damage, 0);
}

TEST(JointLaw, LeavesLawsToTheActiveListThatTheSweepDoesNotKnow) {
  JointLawParams mid_edge = example_law();
  mid_edge.points = JointPoints::mid_edge;
  EXPECT_EQ(prepared(mid_edge).screen_limit(), 0.0);
  EXPECT_EQ(test::reference_law(JointRise::linear).screen_limit(), 0.0);
  EXPECT_EQ(test::reference_law(JointRise::parabolic).screen_limit(), 0.0);
}

TEST(JointLaw, WithoutStrengthItNeverBreaks) {
  JointLawParams law = example_law();
  law.tensile_strength = law.cohesion = std::numeric_limits<double>::infinity();
  law = prepared(law);
  EXPECT_EQ(law.screen_limit(), std::numeric_limits<double>::infinity());
  PointDriver point{law};
  point.move_to(Vec3(0.1, 0.2, 0.3), 3);
  EXPECT_EQ(point.history.damage, 0.0);
  EXPECT_EQ(point.traction, Vec3(law.stiffness * Vec3(0.1, 0.2, 0.3)));
}

TEST(JointLaw, CompressionAloneNeverDamages) {
  for (const JointLawParams& law :
       {prepared(example_law()), test::reference_law(JointRise::linear), test::reference_law(JointRise::parabolic)}) {
    PointDriver point{law};
    point.move_to(Vec3(0, 0, -1e-3), 100);
    EXPECT_EQ(point.history.damage, 0.0);
    EXPECT_NEAR(point.traction[2] / (-1e-3 * law.stiffness), 1.0, 1e-14);
    EXPECT_NEAR(point.dissipated(), 0.0, 1e-14 * point.work);
  }
}

TEST(JointLaw, TensionPullsSideATowardsB) {
  const JointLawParams law = prepared(example_law());
  PointDriver point{law};
  point.step(Vec3(0, 0, 1e-6));
  EXPECT_GT(point.traction[2], 0);
}

TEST(JointLaw, UnloadsToTheOriginAndReloadsToWhereItLeft) {
  for (const JointLawParams& law :
       {prepared(example_law()), test::reference_law(JointRise::linear), test::reference_law(JointRise::parabolic)}) {
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 0, 1)}) {
      const Vec3 far = direction * (law.onset_normal + 0.3 * law.width_normal);
      PointDriver point{law};
      point.move_to(far, 1000);
      const Vec3 there = point.traction;
      const double damage = point.history.damage;
      ASSERT_GT(damage, 0.0);
      ASSERT_LT(damage, 1.0);
      point.step(0.5 * far);
      EXPECT_LT((point.traction - 0.5 * there).norm(), 1e-12 * there.norm());
      point.step(Vec3::Zero());
      EXPECT_LT(point.traction.norm(), 1e-12 * there.norm());
      point.step(far);
      EXPECT_LT((point.traction - there).norm(), 1e-12 * there.norm());
      EXPECT_NEAR(point.history.damage, damage, 1e-12);
    }
  }
}

TEST(JointLaw, DamageNeverHealsAndTractionsNeverPassTheStrengths) {
  std::mt19937 random(11);
  std::normal_distribution<double> part;
  JointLawParams mohr = example_law();
  mohr.friction = 0.7;
  for (const JointLawParams& law :
       {prepared(mohr), test::reference_law(JointRise::linear), test::reference_law(JointRise::parabolic)}) {
    PointDriver point{law};
    double damage = 0;
    for (int i = 0; i < 20000; ++i) {
      point.step(point.opening + 0.1 * law.onset_normal * Vec3(part(random), part(random), part(random)));
      ASSERT_GE(point.history.damage, damage);
      damage = point.history.damage;
      const double normal = point.traction[2], shear = std::hypot(point.traction[0], point.traction[1]);
      ASSERT_LE(normal, law.tensile_strength * (1 + 1e-12));
      ASSERT_LE(shear, (law.cohesion + law.friction * std::fmax(-normal, 0.0)) * (1 + 1e-12));
    }
    EXPECT_GT(damage, 0.0);
  }
}

}  // namespace
}  // namespace breccia::joint_law_test
