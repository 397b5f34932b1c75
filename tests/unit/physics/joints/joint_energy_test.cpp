#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "physics/joint_law.hpp"
#include "unit/physics/joints/point_driver.hpp"

namespace breccia::joint_energy_test {
namespace {

using test::axes;
using test::example_law;
using test::kEnergy;
using test::opening_of;
using test::PointDriver;
using test::prepared;

constexpr double kArea = 173.205081e-6;    // m2, face of a regular tetrahedron of edge 20 mm
constexpr double kEnergyTolerance = 1e-3;  // asked of the law
constexpr double kClosure = 1e-12;         // round-off of some 10^4 terms
constexpr double kLastStep = 1e-6;         // of the energy: the last step ends beyond the critical opening
constexpr std::array<double, 5> kAngles{0, 30, 45, 60, 90};

Vec3 at_angle(double degrees, double length) {
  const double a = degrees * std::numbers::pi / 180;
  return opening_of(axes(), length * std::cos(a), length * std::sin(a));
}

PointDriver opened(const JointLawParams& law, double degrees, int steps) {
  PointDriver point{law};
  const double far = 1.6 * (std::max(law.onset_normal, law.onset_shear) + std::max(law.width_normal, law.width_shear));
  point.move_to(at_angle(degrees, far), steps);
  EXPECT_EQ(point.history.damage, 1.0);
  EXPECT_EQ(point.traction, Vec3(0, 0, 0));
  return point;
}

TEST(JointEnergy, WholeCurveOfTheDefaultLawTakesTheFractureEnergyAtEveryAngleAndPenalty) {
  for (const double factor : {1.0, 10.0, 50.0, 100.0}) {
    JointLawParams law = example_law();
    law.stiffness *= factor;
    law = prepared(law);
    for (const double angle : kAngles) {
      const PointDriver point = opened(law, angle, 40000);
      EXPECT_NEAR(point.work / kEnergy, 1.0, kEnergyTolerance) << factor << ", " << angle;
      EXPECT_NEAR(point.dissipated() / point.work, 1.0, kLastStep);
    }
  }
}

TEST(JointEnergy, SharesOfBothModesAddUpToOneForStrengthsAndEnergiesApart) {
  for (const double factor : {1.0, 10.0, 50.0, 100.0}) {
    for (const SofteningShape shape : {SofteningShape::z_curve, SofteningShape::linear, SofteningShape::exponential}) {
      JointLawParams law = example_law();
      law.stiffness *= factor;
      law.cohesion = 3 * law.tensile_strength;
      law.energy_mode_2 = 10 * law.energy_mode_1;
      law.softening.shape = shape;
      law = prepared(law);
      for (const double angle : kAngles) {
        const PointDriver point = opened(law, angle, 40000);
        EXPECT_NEAR(point.mode_1 / law.energy_mode_1 + point.mode_2 / law.energy_mode_2, 1.0, kEnergyTolerance)
            << factor << ", " << angle;
      }
      EXPECT_NEAR(opened(law, 0, 1000).mode_2, 0.0, kClosure);
      EXPECT_NEAR(opened(law, 90, 1000).mode_1, 0.0, kClosure);
    }
  }
}

TEST(JointEnergy, DefaultLawPeaksAtTheStrengthInOneModeAndOnTheEllipseInBoth) {
  const JointLawParams law = prepared(example_law());
  constexpr double kPeak = 5e-4, kForce = 866.025, kBoth = 612.37;  // N
  EXPECT_NEAR(opened(law, 0, 40000).peak_normal * kArea / kForce, 1.0, kPeak);
  EXPECT_NEAR(opened(law, 90, 40000).peak_shear * kArea / kForce, 1.0, kPeak);
  const PointDriver both = opened(law, 45, 40000);
  EXPECT_NEAR(both.peak_normal * kArea / kBoth, 1.0, kPeak);
  EXPECT_NEAR(both.peak_shear * kArea / kBoth, 1.0, kPeak);
}

TEST(JointEnergy, PublishedLawPeaksAtTheStrengthInBothModesAtOnce) {
  constexpr double kPeak = 5e-4, kForce = 866.025;  // N
  for (const JointRise rise : {JointRise::linear, JointRise::parabolic}) {
    const JointLawParams law = test::reference_law(rise);
    EXPECT_NEAR(opened(law, 0, 40000).peak_normal * kArea / kForce, 1.0, kPeak);
    EXPECT_NEAR(opened(law, 90, 40000).peak_shear * kArea / kForce, 1.0, kPeak);
    const PointDriver both = opened(law, 45, 40000);
    EXPECT_NEAR(both.peak_normal * kArea / kForce, 1.0, kPeak);
    EXPECT_NEAR(both.peak_shear * kArea / kForce, 1.0, kPeak);
  }
}

TEST(JointEnergy, SofteningBranchOfThePublishedLawIs155467UmWideAndTakesTheFractureEnergy) {
  for (const JointRise rise : {JointRise::linear, JointRise::parabolic}) {
    const JointLawParams law = test::reference_law(rise);
    for (const double angle : {0.0, 90.0}) {
      PointDriver point{law};
      point.move_to(at_angle(angle, law.onset_normal), 4000);
      const double before = point.work;
      constexpr double step = 1e-9;
      double length = law.onset_normal;
      while (point.traction.norm() > 0 && length < 1e-4) point.step(at_angle(angle, length += step));
      EXPECT_NEAR((length - law.onset_normal) / 15.5467e-6, 1.0, 5e-4);
      EXPECT_NEAR((point.work - before) / kEnergy, 1.0, kEnergyTolerance);
    }
  }
}

TEST(JointEnergy, PublishedLawTakesWhatItsClosedFormSaysInAll) {
  // Rise: f^2/(2k) linear, 4 f^2/(3k) parabolic, on top of the softening branch.
  const double unit = test::kStrength * test::kStrength / example_law().stiffness;
  EXPECT_NEAR(opened(test::reference_law(JointRise::linear), 0, 40000).dissipated(), kEnergy + unit / 2,
              kEnergyTolerance * kEnergy);
  EXPECT_NEAR(opened(test::reference_law(JointRise::parabolic), 0, 40000).dissipated(), kEnergy + 4 * unit / 3,
              kEnergyTolerance * kEnergy);
}

TEST(JointEnergy, DissipationIsNeverNegativeAlongAPathThatDamages) {
  for (const JointLawParams& law :
       {prepared(example_law()), test::reference_law(JointRise::linear), test::reference_law(JointRise::parabolic)}) {
    for (const double angle : kAngles) {
      PointDriver point{law};
      double before = 0;
      for (int i = 1; i <= 2000; ++i) {
        point.step(at_angle(angle, i * 1e-8));
        ASSERT_GE(point.dissipated() - before, 0.0) << angle << ", step " << i;
        before = point.dissipated();
      }
    }
  }
}

/// A smooth wild path through opening, sliding and closing; t from 0 to 1.
Vec3 wild(const JointLawParams& law, double t) {
  const double size = 0.8 * (law.onset_normal + law.width_normal);
  return size * std::sqrt(t) * Vec3(std::sin(29 * t), std::cos(23 * t) * std::sin(11 * t), 0.3 + std::cos(17 * t));
}

TEST(JointEnergy, WhatTheLawDissipatesTendsToTheWorkLessWhatIsStoredAsStepsShrink) {
  JointLawParams mohr = example_law();
  mohr.friction = 0.7;
  JointLawParams mohr_peaks = mohr;
  mohr_peaks.law = JointLaw::independent_peaks;
  for (const JointLawParams& law : {prepared(mohr), prepared(mohr_peaks), test::reference_law(JointRise::parabolic)}) {
    const auto unaccounted = [&](int steps) {
      PointDriver point{law};
      for (int i = 1; i <= steps; ++i) point.step(wild(law, static_cast<double>(i) / steps));
      EXPECT_GT(point.history.damage, 0.5);
      return std::abs(point.work - point.dissipated() - point.history.stored) / kEnergy;
    };
    const double coarse = unaccounted(2000), fine = unaccounted(32000);
    EXPECT_LT(fine, 0.2 * coarse + 1e-6);
    EXPECT_LT(fine, 2e-3);
  }
}

TEST(JointEnergy, WhatAPathThatTurnsDissipatesIsTheWorkToSecondOrderInTheStepForStrengthsApart) {
  for (const double friction : {0.0, 0.7}) {
    JointLawParams law = example_law();
    law.stiffness *= 30;
    law.cohesion = 3 * law.tensile_strength;
    law.energy_mode_2 = 6 * law.energy_mode_1;
    law.friction = friction;
    law.softening.shape = SofteningShape::linear;
    law = prepared(law);
    const auto unaccounted = [&](int steps) {
      PointDriver point{law};
      for (int i = 1; i <= steps; ++i) point.step(wild(law, static_cast<double>(i) / steps));
      EXPECT_GT(point.history.damage, 0.5);
      return std::abs(point.work - point.dissipated() - point.history.stored) / kEnergy;
    };
    const double coarse = unaccounted(4000), fine = unaccounted(32000);  // 8 by first order, 64 by second
    EXPECT_LT(fine, coarse / 32) << friction;
  }
}

/// One step of a random history: small ones, jumps, closing, back to rest.
Vec3 random_step(const JointLawParams& law, const Vec3& from, std::mt19937& random) {
  std::normal_distribution<double> part;
  const Vec3 by(part(random), part(random), part(random));
  switch (random() % 16) {
    case 0:
      return 0.3 * (law.onset_normal + law.width_normal) * by;
    case 1:
      return Vec3::Zero();
    case 2:
      return Vec3(from[0], from[1], -from[2]);
    case 3:
      return 0.5 * from;
    default:
      return from + 0.2 * law.onset_normal * by;
  }
}

TEST(JointEnergy, NoDissipatedTermEverDecreasesWhateverTheHistory) {
  std::mt19937 random(23);
  for (int i = 0; i < 240; ++i) {
    JointLawParams law = example_law();
    law.viscosity = i % 2 == 0 ? 0.0 : kJointViscosity;
    law.stiffness *= std::array<double, 3>{1, 10, 50}[static_cast<std::size_t>(i % 3)];
    law.cohesion = (1 + i % 2) * law.tensile_strength;
    law.energy_mode_2 = 5 * law.energy_mode_1;
    law.law = i % 4 < 2 ? JointLaw::mixed_mode : JointLaw::independent_peaks;
    law.softening.shape = std::array{SofteningShape::z_curve, SofteningShape::linear,
                                     SofteningShape::exponential}[static_cast<std::size_t>(i / 4 % 3)];
    if (i % 8 == 2)
      law.rise = JointRise::parabolic;
    else
      law.friction = i % 5 == 0 ? 0.0 : 0.7;
    law = prepared(law);
    PointDriver point{law};
    for (int step = 0; step < 3000; ++step) {
      const std::array before{point.mode_1, point.mode_2, point.friction, point.viscous};
      point.step(random_step(law, point.opening, random));
      const std::array after{point.mode_1, point.mode_2, point.friction, point.viscous};
      for (std::size_t term = 0; term < 4; ++term) ASSERT_GE(after[term], before[term]) << i << ", " << step;
      ASSERT_GE(point.history.stored, 0.0);
    }
    EXPECT_GT(point.mode_1, 0.0);
    EXPECT_GT(point.mode_2, 0.0);
  }
}

TEST(JointEnergy, ViscosityTakesNothingThatMattersOfASlowOpeningAndActsOnDamagedPointsAlone) {
  JointLawParams law = example_law();
  law.viscosity = kJointViscosity;
  law = prepared(law);
  PointDriver point{law};
  point.move_to(at_angle(0, 0.99 * law.onset_normal), 3);
  point.move_to(at_angle(0, -law.onset_normal), 7);
  EXPECT_EQ(point.viscous, 0.0);
  point.move_to(at_angle(0, 2 * (law.onset_normal + law.width_normal)), 4000);
  EXPECT_NEAR(point.mode_1 / kEnergy, 1.0, kEnergyTolerance);
  EXPECT_GT(point.viscous, 0.0);
  EXPECT_LT(point.viscous, 1e-3 * kEnergy);
}

TEST(JointEnergy, OpeningWithinAStepGivesNoMoreThanWasStoredHoweverLongTheStep) {
  constexpr double kViscous = 1e-6;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 100; ++i) {
    JointLawParams law = example_law();
    law.viscosity = 1e-9;  // there, and of no weight beside what is taken back
    law.law = i % 2 == 0 ? JointLaw::mixed_mode : JointLaw::independent_peaks;
    law = prepared(law);
    PointDriver point{law};
    point.move_to(at_angle(0, law.onset_normal + part(random) * law.width_normal), 200);
    const double farthest = point.opening.norm();
    point.step(at_angle(0, -part(random) * farthest));
    const double closed = point.history.stored - point.work - point.history.gained;
    point.step(at_angle(0, part(random) * farthest));
    EXPECT_LE(point.history.stored - point.work - point.history.gained, closed + kViscous * kEnergy) << i;
    for (int turn = 0; turn < 400; ++turn) point.step(at_angle(0, (0.2 + 0.05 * std::abs(turn % 20 - 10)) * farthest));
    EXPECT_LE(point.history.gained, kViscous * kEnergy) << "what is counted is taken; " << i;
  }
}

TEST(JointEnergy, OpeningFromPressureWithinAStepTakesWhatTheDamageTakesAlsoWhereItIsTheFirst) {
  constexpr double kRoundOff = 1e-9;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 100; ++i) {
    JointLawParams law = example_law();
    law.viscosity = 1e-15;
    law.law = i % 2 == 0 ? JointLaw::mixed_mode : JointLaw::independent_peaks;
    law = prepared(law);
    PointDriver point{law};
    if (i % 4 >= 2) point.move_to(at_angle(0, law.onset_normal + 0.2 * part(random) * law.width_normal), 200);
    const double wide = law.onset_normal + law.width_normal;
    point.step(at_angle(0, -wide * part(random)));
    const auto taken = [&] { return point.work + point.history.gained - point.history.stored; };
    const double closed = taken(), mode_1 = point.mode_1;
    point.step(at_angle(0, law.onset_normal + law.width_normal * (0.3 + 0.6 * part(random))));
    EXPECT_GT(point.mode_1, mode_1) << i;
    EXPECT_NEAR(taken() - closed, point.mode_1 - mode_1, kRoundOff * kEnergy) << i;
    EXPECT_LT(point.viscous, kRoundOff * kEnergy) << i;
  }
}

TEST(JointEnergy, OpeningFromPressureWithinAStepTakesWhatTheDamageTakesOnTheParabolicRiseToo) {
  constexpr double kRoundOff = 1e-9;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 100; ++i) {
    JointLawParams law = test::reference_law(JointRise::parabolic);
    law.viscosity = 1e-15;
    PointDriver point{law};
    // Damaged by sliding or by opening before, or not at all; then opened up to its peak or beyond.
    const double slid = law.onset_shear + 0.2 * law.width_shear;
    if (i % 3 == 0) point.move_to(at_angle(90, slid), 200);
    if (i % 3 == 1) point.move_to(at_angle(0, law.onset_normal + 0.2 * part(random) * law.width_normal), 200);
    const double shear = i % 3 == 0 ? slid : 0.0;
    point.step(opening_of(axes(), -law.onset_normal * part(random), shear));
    const auto taken = [&] { return point.work + point.history.gained - point.history.stored; };
    const double closed = taken(), dissipated = point.dissipated();
    const double far = i % 3 == 0 ? 0.9 * law.onset_normal * part(random)
                                  : law.onset_normal + law.width_normal * (0.3 + 0.6 * part(random));
    point.step(opening_of(axes(), far, shear));
    ASSERT_GT(point.history.damage, 0.0);
    EXPECT_NEAR(taken() - closed, point.dissipated() - dissipated, kRoundOff * kEnergy) << i;
  }
}

TEST(JointEnergy, APointThatHasGainedAndStandsStillIsLeftAlone) {
  JointLawParams law = example_law();
  law.viscosity = kJointViscosity;
  law = prepared(law);
  PointDriver point{law};
  const double farthest = law.onset_normal + 0.5 * law.width_normal;
  point.move_to(at_angle(0, farthest), 200);
  point.history.gained = 10 * kEnergy;  // more than a step may take
  point.step(at_angle(0, 0.9 * farthest));
  ASSERT_NE(point.history.gained, 0.0);
  const double gained = point.history.gained;
  point.step(at_angle(0, 0.9 * farthest));
  EXPECT_EQ(point.history.balance, 0.0);
  EXPECT_EQ(point.history.gained, gained);
}

/// A mass held by a spring as stiff as the joint and by a damaged point, in central differences; J/m2 and kg/m2.
struct Chatter {
  PointDriver point;
  double mass, dt, place, velocity, force = 0;
  double energy = 0;  // less what the point counts as gained and not yet taken
  double largest_gained = 0;

  Chatter(const JointLawParams& law, double share_of_limit, double damaged_to)
      : point{law}, mass(1.0), dt(share_of_limit * 2 * std::sqrt(mass / (2 * law.stiffness))), place(0), velocity(0) {
    point.move_to(at_angle(0, damaged_to), 200);
    place = damaged_to;
    pull();
  }
  void pull() { force = -point.traction.dot(point.frame.normal) - point.law.stiffness * place; }
  void step() {
    const double before = velocity;
    velocity += dt * force / mass;
    energy = 0.5 * mass * before * velocity + 0.5 * point.law.stiffness * place * place + point.history.stored -
             point.history.gained;
    largest_gained = std::max(largest_gained, point.history.gained);
    place += dt * velocity;
    point.step(at_angle(0, place));
    pull();
  }
};

TEST(JointEnergy, ChatterBetweenOpenAndClosedGainsNoneIn100000StepsAtTheDefaultShareOfTheStableStep) {
  JointLawParams law = example_law();
  constexpr double kOnTheWay = 0.5;  // 2 k D^2 / 8 of D at most, of k D^2 / 2.56, for a step or two
  law.viscosity = kJointViscosity;
  law = prepared(law);
  for (int i = 1; i <= 20; ++i) {
    const double damaged_to = law.onset_normal + 0.045 * i * law.width_normal;
    Chatter chatter(law, 0.8, damaged_to);
    chatter.step();
    const double first = chatter.energy;
    double largest = 0;
    for (int step = 0; step < 100000; ++step) {
      chatter.step();
      largest = std::max(largest, chatter.energy);
    }
    EXPECT_LE(largest, 1.001 * first) << i;
    EXPECT_LE(chatter.largest_gained, kOnTheWay * first) << i;
  }
}

/// Closed polygon from the origin through random corners.
struct Loop {
  std::array<Vec3, 5> corners;
  void run(PointDriver& point) const {
    for (const Vec3& corner : corners) point.move_by_kink(corner, 400);
    point.move_by_kink(Vec3::Zero(), 400);
  }
};

Loop random_loop(const JointLawParams& law, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1), size(0.2, 1);
  Loop loop;
  const double reach = size(random) * (law.onset_normal + 0.6 * law.width_normal);
  for (Vec3& corner : loop.corners) corner = reach * Vec3(part(random), part(random), part(random));
  return loop;
}

JointLawParams random_law(int i) {
  JointLawParams law = example_law();
  law.stiffness *= std::array<double, 3>{1, 10, 50}[static_cast<std::size_t>(i % 3)];
  law.cohesion = (1 + i % 2) * law.tensile_strength;
  law.energy_mode_2 = 5 * law.energy_mode_1;
  if (i % 4 >= 2) law.law = JointLaw::independent_peaks;
  if (i % 8 == 2)
    law.rise = JointRise::parabolic;
  else if (i % 2 == 1)
    law.friction = 0.6;
  return prepared(law);
}

TEST(JointEnergy, NoClosedLoopCreatesEnergy) {
  std::mt19937 random(7);
  int damaged = 0, rubbed = 0;
  for (int i = 0; i < 200; ++i) {
    const JointLawParams law = random_law(i);
    const Loop loop = random_loop(law, random);
    PointDriver point{law};
    loop.run(point);
    damaged += point.history.damage > 0 ? 1 : 0;
    rubbed += point.friction > 1e-6 * kEnergy ? 1 : 0;
    // A parabola's trapezoids are off by the square of the step, 1/400 of a side; straight lines by round-off.
    ASSERT_GE(point.work, (law.rise == JointRise::parabolic ? -1e-5 : -1e-10) * kEnergy) << "loop " << i;
    ASSERT_GE(std::min({point.mode_1, point.mode_2, point.friction}), 0.0) << "loop " << i;
    // Once more: without friction nothing is left to take.
    if (law.friction > 0 || law.rise == JointRise::parabolic) continue;
    const double once = point.work;
    loop.run(point);
    ASSERT_NEAR(point.work, once, 1e-10 * kEnergy) << "loop " << i;
  }
  EXPECT_GT(damaged, 100);
  EXPECT_GT(rubbed, 50);
}

}  // namespace
}  // namespace breccia::joint_energy_test
