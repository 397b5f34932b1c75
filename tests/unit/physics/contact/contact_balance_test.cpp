#include "physics/contact/contact_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "press.hpp"

/// A mass on a contact that begins and ends anywhere within a step.
namespace breccia {
namespace {

using test::Press;

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kPenalty = 1e6;  // Pa

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
  const auto steps = static_cast<int>(20 + 10 / omega);
  for (int i = 0; i < steps; ++i) {
    const double force = press.move(v), before = v;
    v += force / mass;
    const ContactWork& work = press.scene.work;
    found.at_the_end = (0.5 * mass * v * before + work.stored.value() + work.dissipated.value()) / first - 1;
    found.largest_loss = std::max(found.largest_loss, -found.at_the_end);
  }
  EXPECT_TRUE(press.scene.contact.touching.empty()) << "the contact has ended";
  return found;
}

TEST(contact_balance, an_impact_returns_its_energy_wherever_in_a_step_it_begins_and_ends) {
  // A force that begins with k d loses up to omega^2 / 4 of the energy at once; its own end may give that back, or not.
  constexpr double kAtOnce = 0.14;  // of omega^2: half of that
  constexpr double kGain = 1e-4, kLoss = 1e-6;
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

/// Energies at the tops of the ways of a mass that falls back on the contact, over that with which it begins.
std::vector<double> tops_of_bounces(double omega, int count) {
  constexpr double speed = 1e-3, weight = 5e-5;  // m/s, m/s2: in the air for forty steps
  Press press(-0.3 * speed, {kPenalty, kInfinite, 1, 0, 1});
  const double mass = Press::area() * kPenalty / press.scene.contact.body_length[0] / (omega * omega);
  std::vector<double> tops;
  double v = -speed, height = 0;
  while (tops.size() < static_cast<std::size_t>(count)) {
    const double force = press.move(v), before = v;
    height += v;
    v += force / mass - weight;
    if (before > 0 && v <= 0) tops.push_back((v * before + 2 * weight * height) / (speed * speed));
  }
  return tops;
}

TEST(contact_balance, a_mass_that_bounces_under_its_weight_goes_on_bouncing_as_high) {
  constexpr double kKept = 1e-3;  // the weight changes the motion between the two halves of a closing force
  for (const double omega : {0.5, 0.8, 1.1, 1.4}) {
    const std::vector<double> tops = tops_of_bounces(omega, 100);
    for (const double top : tops) EXPECT_NEAR(top / tops.front(), 1, kKept) << omega;
  }
}

TEST(contact_balance, adds_nothing_to_a_contact_at_rest_or_beyond_what_a_step_can_leave_over) {
  constexpr double k = 100, out = 0.1, work = 2, most = kLargestWorkError * k * out * out;
  EXPECT_EQ(balancing_share(0, work, k, out), 0);
  EXPECT_EQ(balancing_share(0.1, work, k, 0), 0);
  EXPECT_EQ(balancing_share(1.01 * most, 10 * work, k, out), 0);
  EXPECT_NEAR(balancing_share(0.5 * most, work, k, out), -0.5 * most / work, 1e-15);
  EXPECT_EQ(balancing_share(0.99 * most, 0.1 * most, k, out), 0) << "no more than half of the force";
}

TEST(contact_balance, a_closing_force_takes_back_what_was_gained_and_is_no_larger_than_the_force_before) {
  const Vec3 pushed(0, 0, 4), up(0, 0, 0.1);
  constexpr double k = 1e3;
  EXPECT_NEAR(closing_force(0.1, pushed, up, 0, k)[2], -1, 1e-15) << "over two halves of a step";
  EXPECT_NEAR(closing_force(1, pushed, up, 0, k)[2], -4, 1e-15) << "never larger than the force before";
  EXPECT_NEAR(closing_force(0.1, Vec3(0, 0, -2), up, 0, k)[2], -1, 1e-15) << "one that pulls goes on";
  EXPECT_NEAR(closing_force(0.1, pushed, -up, 0, k)[2], 1, 1e-15) << "on the way in it pushes";
  EXPECT_EQ(closing_force(1e-5, pushed, up, 0, k), Vec3(Vec3::Zero())) << "next to nothing is left over";
  EXPECT_EQ(closing_force(0.1, pushed, Vec3(0.1, 0, 0), 0, k), Vec3(Vec3::Zero())) << "no motion along it";
}

TEST(contact_balance, a_closing_force_gives_back_what_was_lost_by_small_parts_and_nearby) {
  const Vec3 pushed(0, 0, 400), up(0, 0, 0.1);
  constexpr double k = 1e3, most = kLargestWorkError * k * 0.1 * 0.1;  // J, of this motion
  EXPECT_NEAR(closing_force(-0.1 * most, pushed, up, 0, k)[2], 0.1 * most / 0.1, 1e-12) << "pushes on";
  EXPECT_NEAR(closing_force(-5 * most, pushed, up, 0, k)[2], most / 0.1, 1e-12) << "no more than a step leaves over";
  EXPECT_NEAR(closing_force(-0.1 * most, pushed, -up, 0, k)[2], -0.1 * most / 0.1, 1e-12) << "on the way in it pulls";
  const double lost_within = std::sqrt(0.1 * most / (kLargestWorkError * k));  // m
  EXPECT_NE(closing_force(-0.1 * most, pushed, up, 0.99 * kGivingReach * lost_within, k), Vec3(Vec3::Zero()));
  EXPECT_EQ(closing_force(-0.1 * most, pushed, up, 1.01 * kGivingReach * lost_within, k), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace breccia
