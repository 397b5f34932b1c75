#include "physics/contact/correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "press.hpp"

/// A mass on a contact that begins and ends anywhere within a step.
namespace breccia::contact_balance_test {
namespace {

using test::Press;

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kPenalty = 1e6;  // Pa

BalancingShares shares_of_a_line(double gained, double before, double work, double k, double out) {
  return balancing_shares(gained, before, work, balancing_limits(work, k, out));
}

/// Energies of an impact as shares of the kinetic energy that it begins with.
struct Impact {
  double largest_loss = 0;  ///< at any time
  double at_the_end = 0;    ///< gained
};

/// Central differences of a rigid mass with a step of 1 s, from a gap that is `phase` of the first way above the face.
/// @param omega  rad/s, of the mass on the contact's stiffness; 2 is the limit of stability
Impact impact(double omega, double phase, const ContactLaw& law) {
  constexpr double speed = 1e-3;  // m/s
  Press press(-phase * speed, law);
  const double mass = Press::area() * kPenalty / press.scene.contact.body_length[0] / (omega * omega);
  const double first = 0.5 * mass * speed * speed;
  Impact found;
  double v = -speed;
  const bool steep = law.exponent > 1;  // after such an overlap pulls go on for many steps
  const auto steps = static_cast<int>(20 + 10 / omega + (steep ? 40 : 0));
  for (int i = 0; i < steps; ++i) {
    const double force = press.move(v), before = v;
    v += force / mass;
    const ContactWork& work = press.scene.work;
    found.at_the_end = (0.5 * mass * v * before + work.stored.value() + work.dissipated.value()) / first - 1;
    found.largest_loss = std::max(found.largest_loss, -found.at_the_end);
  }
  EXPECT_EQ(press.scene.work.stored.value(), 0) << "the contact has ended";
  EXPECT_TRUE(steep || press.scene.contact.touching.empty());
  return found;
}

TEST(ContactBalance, AnImpactReturnsItsEnergyWhereverInAStepItBeginsAndEnds) {
  // A force that begins with k d loses up to omega^2 / 4 of the energy at once; its own end may give that back, or not.
  constexpr double kAtOnce = 0.14;  // of omega^2: half of that
  constexpr double kGain = 1e-4, kLoss = 0.06;
  const ContactLaw law{kPenalty, kInfinite, 1, 0, 1};
  for (const double omega : {0.2, 0.5, 0.8, 1.1, 1.4}) {
    for (double phase = 0.025; phase < 1; phase += 0.05) {
      const Impact found = impact(omega, phase, law);
      EXPECT_LT(found.largest_loss, kAtOnce * omega * omega) << omega << " " << phase;
      EXPECT_LT(found.at_the_end, kGain) << omega << " " << phase;
      EXPECT_GT(found.at_the_end, -kLoss) << omega << " " << phase;
    }
  }
}

TEST(ContactBalance, AnImpactOnASteepUnloadingCurveLosesWhatTheLawTakes) {
  constexpr double kChange = 1e-4;  // of the energy; the stable step of the unloading curve is omega = 2 / sqrt(b)
  for (const double exponent : {1.5, 2.0, 4.0, 6.0})
    for (const double omega : {0.2, 0.5, 0.8, 1.1})
      for (double phase = 0.025; phase < 1; phase += 0.05)
        EXPECT_NEAR(impact(omega, phase, {kPenalty, kInfinite, exponent, 0, 1}).at_the_end, 0, kChange)
            << exponent << " " << omega << " " << phase;
}

TEST(ContactBalance, AddsNothingToAContactAtRestOrBeyondWhatAStepCanLeaveOver) {
  constexpr double k = 100, out = 0.1, work = 2, most = kLargestWorkError * k * out * out;
  EXPECT_EQ(shares_of_a_line(0, 0, work, k, out).own, 0);
  EXPECT_EQ(shares_of_a_line(0.1, 0, work, k, 0).own, 0);
  EXPECT_EQ(shares_of_a_line(1.01 * most, 0, 10 * work, k, out).own, 0);
  EXPECT_NEAR(shares_of_a_line(0.5 * most, 0, work, k, out).own, -0.5 * most / work, 1e-15);
  EXPECT_EQ(shares_of_a_line(0.99 * most, 0, 0.1 * most, k, out).own, 0) << "no more than half of the force";
}

TEST(ContactBalance, OfASteepUnloadingCurveMayPull) {
  constexpr double k = 100, out = 0.1, kD2 = k * out * out, work = 0.01 * kD2, most = work + 0.25 * kD2;
  const BalancingLimits limits = steep_limits(work, k, 4, out);
  EXPECT_NEAR(balancing_shares(0.1 * kD2, 0, work, limits).own * work, -0.1 * kD2, 1e-12);
  EXPECT_NEAR(balancing_shares(9 * kD2, kD2, work, limits).own * work, -most, 1e-12) << "the rest later";
  EXPECT_NEAR(balancing_shares(9 * kD2, kD2, work, limits).before, 0, 1e-12) << "its own overlap comes first";
  EXPECT_NEAR(balancing_shares(0.2 * kD2, kD2, work, limits).before * work, 0.2 * kD2 - most, 1e-12);
  EXPECT_NEAR(balancing_shares(-0.4 * kD2, 0, work, limits).own, 0.5, 1e-12) << "gives no more than a line does";
  EXPECT_NEAR(steep_limits(100 * kD2, k, 4, out).take, 4.25 * kD2, 1e-12) << "hardly begins to leave";
}

TEST(ContactBalance, PutsRightWhatEarlierOverlapsLeftAsFarAsOneStepCan) {
  constexpr double k = 100, out = 0.1, work = 2, most = kLargestWorkError * k * out * out;
  for (const double left : {-0.4 * most, 0.4 * most})
    EXPECT_NEAR(shares_of_a_line(0, left, work, k, out).before, -left / work, 1e-15);
  EXPECT_NEAR(shares_of_a_line(0, -7 * most, work, k, out).before, most / work, 1e-15) << "the rest later";
  EXPECT_NEAR(shares_of_a_line(0, 7 * most, -work, k, out).before, most / work, 1e-15) << "on the way in as well";
  const BalancingShares both = shares_of_a_line(0.8 * most, 7 * most, work, k, out);
  EXPECT_NEAR(both.own + both.before, -most / work, 1e-15) << "its own overlap comes first";
  EXPECT_NEAR(shares_of_a_line(0, 7 * most, 0.1 * most, k, out).before, -0.5, 1e-15) << "half of the force at most";
}

/// Largest change of the energy of a mass that falls on a contact again and again with steps of 1 s, as a share of the
/// energy of its motion. @param omega  rad/s, of the mass on the contact;  @param flight  s, from bounce to bounce
double drift_of_bounces(double omega, double flight) {
  constexpr double speed = 1e-4;  // m/s, with which it meets the contact
  constexpr int kSteps = 3000;
  const double gravity = 2 * speed / flight, fall = 0.25 * speed * flight;
  Press press(-fall, {kPenalty, kInfinite, 1, 0, 1});
  const double mass = Press::area() * kPenalty / press.scene.contact.body_length[0] / (omega * omega);
  const double first = mass * gravity * fall;
  double v = -0.5 * gravity, height = fall, drift = 0;
  int touched = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double force = press.move(v), before = v;
    height += v;
    v += force / mass - gravity;
    touched += press.scene.work.touching > 0 ? 1 : 0;
    const double energy = 0.5 * mass * v * before + mass * gravity * height + press.scene.work.stored.value();
    drift = std::max(drift, std::abs(energy / first - 1));
  }
  EXPECT_GT(touched, kSteps / 20) << "bounces";
  EXPECT_LT(touched, kSteps - kSteps / 20) << "comes off";
  return drift;
}

TEST(ContactBalance, HoldsTheEnergyOfAMassThatBouncesHundredsOfTimesInContactsOfAFewSteps) {
  // What one contact leaves over where it begins and where it ends, each kLargestWorkError k D^2 or omega^2 / 4 of the
  // energy of the motion, and not the sum of all.
  for (const auto& [omega, flight] : {std::pair{0.3, 7.3}, {0.5, 7.3}, {0.5, 11.7}})
    EXPECT_LT(drift_of_bounces(omega, flight), 0.5 * omega * omega) << omega << " " << flight;
}

/// A mass that a constant force presses on a plateau from one moment on.
struct Pressed {
  double gained = 0;  ///< energy at any time beyond the work of the force, over twice what the way to the plateau takes
  double deepest = 0;  ///< largest overlap, over that at which the plateau begins
};

/// @param omega  rad/s, of the mass on the steepest slope of the law;  @param share  force over that of the plateau
Pressed press_on_a_plateau(double omega, double share, double exponent) {
  constexpr int kSteps = 1500;
  constexpr double kPlateau = 1e-6 * kPenalty;
  const ContactLaw law{largest_penalty(kPlateau, exponent), kPlateau, exponent, 0, 1};
  Press press(0, law);
  const double length = press.scene.contact.body_length[0];
  const double mass = Press::area() * exponent * law.penalty / length / (omega * omega);
  const double pressing = share * Press::area() * kPlateau;
  const double begins = kPlateau / law.penalty, scale = Press::area() * length * kPlateau * begins;
  Pressed found;
  double v = 0, work = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double force = press.move(v), before = v;
    work -= pressing * v;
    v += (force - pressing) / mass;
    const ContactWork& kept = press.scene.work;
    const double energy = 0.5 * mass * v * before + kept.stored.value() + kept.dissipated.value();
    found.gained = std::max(found.gained, (energy - work) / scale);
    for (const TouchingCouple& couple : press.scene.contact.touching)
      found.deepest = std::max(found.deepest, couple.history.d / begins);
  }
  return found;
}

TEST(ContactBalance, WhatPressesOnAPlateauNeitherSinksNorGainsEnergy) {
  for (const double exponent : {1.0, 4.0, 6.0}) {
    for (const double omega : {0.5, 1.0, 1.6}) {
      for (const double share : {0.1, 0.4, 0.9}) {
        const Pressed found = press_on_a_plateau(omega, share, exponent);
        // A force that is there at once presses twice as far as a slow one, and beyond the plateau until its work is
        // dissipated; the step in which a force begins leaves over omega^2 / 4 of the energy at most.
        const double farthest = share <= 0.5 ? 2 * share : 0.5 / (1 - share), left_over = 0.25 * omega * omega;
        EXPECT_LT(found.deepest, (1 + left_over) * farthest) << exponent << " " << omega << " " << share;
        EXPECT_LT(found.gained, left_over) << exponent << " " << omega << " " << share;
      }
    }
  }
}

TEST(ContactBalance, AClosingForcePullsNoMoreThanWasPushedAndOnlyWhereEnergyWasGained) {
  const Vec3 pushed(0, 0, 4), up(0, 0, 0.1);
  constexpr double k = 1e3;
  EXPECT_EQ(closing_force(-0.1, pushed, up, true, k), Vec3(Vec3::Zero()));
  EXPECT_EQ(closing_force(0.1, pushed, Vec3(-up), true, k), Vec3(Vec3::Zero())) << "nothing is taken from a way in";
  EXPECT_NEAR(closing_force(0.1, pushed, up, true, k)[2], -1, 1e-15) << "over two halves of a step";
  EXPECT_NEAR(closing_force(1, pushed, up, true, k)[2], -4, 1e-15) << "never larger than the force before";
  EXPECT_NEAR(closing_force(0.1, Vec3(0, 0, -2), up, false, k)[2], -1, 1e-15) << "one that pulls goes on";
  EXPECT_EQ(closing_force(1e-5, pushed, up, true, k), Vec3(Vec3::Zero())) << "next to nothing is left over";
  constexpr double left_over = kLargestWorkError * k * 0.1 * 0.1;  // J, of this motion
  EXPECT_NEAR(closing_force(1e3, Vec3(1e3 * pushed), up, true, k)[2], -2 * left_over / 0.1, 1e-12)
      << "turns no motion round";
}

TEST(ContactBalance, OfASteepUnloadingCurveIsNoLargerOnTheWayInThanOfALine) {
  // A larger share is a contact stiffer than the time step allows: the foot of a tower that stood on it gained energy.
  Press press(0, {kPenalty, kInfinite, 6, 0, 1});
  constexpr double motion = 0.004;  // m
  press.move(-motion);
  ASSERT_EQ(press.scene.contact.touching.size(), 1U);
  press.scene.contact.touching.front().history.gained_before = 10;  // J, more than a step can take back
  press.move(-motion);
  const TouchingCouple& couple = press.scene.contact.touching.front();
  const double depth = couple.history.d * press.scene.contact.body_length[0];
  EXPECT_GT(couple.history.balance, 0) << "takes back what is left";
  EXPECT_LT(couple.history.balance, (1 + 1e-9) * kLargestWorkError * motion / depth);
}

TEST(ContactBalance, APointThatComesBackWhileItsClosingForceLastsIsAsDeepAsItLies) {
  Press press(0, {kPenalty, kInfinite, 1, 0, 1});
  press.move(-0.003);
  press.move(0.005);
  ASSERT_EQ(press.scene.contact.touching.size(), 1U);
  ASSERT_EQ(press.scene.contact.touching.front().history.d, 0);
  ASSERT_NE(press.scene.contact.touching.front().history.force, Vec3(Vec3::Zero())) << "no closing force";
  press.move(-0.006);
  ASSERT_EQ(press.scene.contact.touching.size(), 1U);
  const TouchingCouple& couple = press.scene.contact.touching.front();
  EXPECT_NEAR(couple.history.d_max * press.scene.contact.body_length[0], 0.004, 1e-9) << "not by all it has moved";
  EXPECT_EQ(couple.history.d, couple.history.d_max);
  EXPECT_EQ(press.dissipated(), 0) << "by an elastic law";
}

TEST(OpeningForce, ReturnsNoMoreThanIsMissingToAnyMassThatAStableStepAllows) {
  constexpr double k = 3, motion = 0.1;                     // N/m; m in a step of 1 s
  for (const double mass : {k / 4, k / 2, k, 10 * k}) {     // k dt^2 / m = 4, 2, 1, 0.1
    for (const double missing : {1e-4, 1e-3, 0.01, 0.1}) {  // J; k motion^2 = 0.03
      const Vec3 force = opening_force(missing, Vec3(Vec3::UnitX()), Vec3(motion, 0.03, 0), k);
      EXPECT_GT(force[0], 0);
      EXPECT_EQ(force[1], 0);
      const double next = motion + force[0] / mass;
      const double returned = 0.5 * force[0] * (motion + next);
      EXPECT_LE(returned, missing * (1 + 1e-12)) << mass << " " << missing;
      if (missing < 1e-2 * k * motion * motion) EXPECT_GT(returned, 0.9 * missing) << "in one step";
    }
  }
  EXPECT_EQ(opening_force(1.0, Vec3(Vec3::UnitX()), Vec3(-motion, 0, 0), k), Vec3(Vec3::Zero())) << "it comes back";
  EXPECT_EQ(opening_force(0.0, Vec3(Vec3::UnitX()), Vec3(motion, 0, 0), k), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace breccia::contact_balance_test
