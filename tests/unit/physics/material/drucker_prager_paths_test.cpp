#include <gtest/gtest.h>

#include <cmath>

#include "unit/physics/material/material_point.hpp"

/// Paths whose end is known in closed form, led through the law as histories of F.
namespace breccia::drucker_prager_paths_test {
namespace {

using test::same_plastic_state;

using test::kDegree;
using test::MaterialPoint;

constexpr double kPhi = 35 * kDegree, kPsi = 10 * kDegree, kCohesion = 8e6;
constexpr double kExact = 1e-10;  // of the strength: round-off of strains of 1e-3, a thousandth of which is elastic

DruckerPragerParams rock() {
  DruckerPragerParams p = make_drucker_prager(kPhi, kPsi, kCohesion);
  p.hardening = 0.5e9;
  return p;
}

/// Principal strains of Hooke's law, and those of so much flow of the cone in triaxial compression along x.
Vec3 triaxial_strain(const MaterialPoint& point, const Vec3& stress, double gamma) {
  const double mu = point.params.mu, mean = stress.sum() / 3.0, dilation = point.params.drucker_prager.dilation;
  const Vec3 elastic = (stress.array() - mean).matrix() / (2 * mu) + Vec3::Constant(mean / (3 * point.bulk()));
  const double side = 0.5 / std::sqrt(3.0);
  return elastic + gamma * (Vec3(-2 * side, side, side) + Vec3::Constant(dilation / 3));
}

/// [Mohr-Coulomb] strength under lateral pressure after a plastic shear gamma, Pa.
double strength(double lateral, double cohesion) {
  return lateral * (1 + std::sin(kPhi)) / (1 - std::sin(kPhi)) + 2 * cohesion * std::cos(kPhi) / (1 - std::sin(kPhi));
}

TEST(DruckerPragerPath, OfUniaxialAndTriaxialCompressionFollowsTheStrengthOfMohrAndCoulomb) {
  for (const double lateral : {0.0, 5e6, 40e6}) {
    for (const int steps : {1, 10, 1000}) {
      MaterialPoint point(rock());
      const double at_yield = strength(lateral, kCohesion);
      const Vec3 pressed = Vec3::Constant(-lateral), yield(-at_yield, -lateral, -lateral);
      const Vec3 start = triaxial_strain(point, pressed, 0), elastic = triaxial_strain(point, yield, 0);
      point.go_to_strains(Vec3::Zero(), start, 1);
      // Just below the strength nothing flows yet.
      point.go_to_strains(start, start + (elastic - start) * (1 - 1e-9), steps);
      EXPECT_EQ(point.memory.plastic_shear, 0) << lateral;
      EXPECT_NEAR(point.kirchhoff()(0, 0) / -at_yield, 1, 1e-8);
      const double gamma = 0.02;
      const double hardened = strength(lateral, kCohesion + point.params.drucker_prager.hardening * gamma);
      const Vec3 end = triaxial_strain(point, Vec3(-hardened, -lateral, -lateral), gamma);
      point.go_to_strains(elastic, end, steps);
      EXPECT_NEAR(point.kirchhoff()(0, 0), -hardened, kExact * hardened) << lateral;
      EXPECT_NEAR(point.kirchhoff()(1, 1), -lateral, kExact * hardened) << lateral;
      EXPECT_NEAR(point.memory.plastic_shear, gamma, kExact) << lateral;
      // Work of the flow, of which the cohesion grows linearly: by hand over the path.
      const double dilation = point.params.drucker_prager.dilation, side = 0.5 / std::sqrt(3.0);
      const double mean_axial = 0.5 * (at_yield + hardened);
      const double work = gamma * (mean_axial * (2 * side - dilation / 3) - 2 * lateral * (side + dilation / 3));
      EXPECT_NEAR(point.memory.plastic_work / work, 1, 1e-7) << lateral;  // what the elastic limit was missed by
    }
  }
}

TEST(DruckerPragerPath, OfUniaxialStrainFollowsItsTwoStraightLines) {
  for (const int steps : {1, 7, 500}) {
    MaterialPoint point(rock());
    const auto& p = point.params.drucker_prager;
    const double mu = point.params.mu, bulk = point.bulk();
    const double a = 2 * mu / std::sqrt(3.0), fall = a - p.friction * bulk;  // of s and of f, a unit of compression
    ASSERT_GT(fall, 0) << "the path must meet the cone";
    const double yield = p.cohesion_factor * p.cohesion / fall, more = 4 * yield;
    const double gamma = fall * more / (mu + p.friction * p.dilation * bulk + p.cohesion_factor * p.hardening);
    const double s = a * (yield + more) - mu * gamma, m = -bulk * (yield + more + p.dilation * gamma);
    point.go_to_strains(Vec3::Zero(), Vec3(-yield - more, 0, 0), steps);
    const Mat3 tau = point.kirchhoff();
    EXPECT_NEAR(tau.trace() / 3, m, kExact * s);
    EXPECT_NEAR((tau(1, 1) - tau(0, 0)) / std::sqrt(3.0), s, kExact * s);
    EXPECT_NEAR(point.memory.plastic_shear, gamma, kExact * gamma);
  }
}

TEST(DruckerPragerPath, OfHydrostaticCompressionFollowsTheCapAndUnloadsElastically) {
  for (const int steps : {1, 20, 400}) {
    MaterialPoint point(rock());
    auto& p = point.params.drucker_prager;
    p.cap_pressure = 60e6;
    p.cap_hardening = 2e9;
    const double bulk = point.bulk(), volume = -0.2;
    const double kappa = (-bulk * volume - p.cap_pressure) / (bulk + p.cap_hardening);
    const double pressure = p.cap_pressure + p.cap_hardening * kappa;
    const double at_yield = p.cap_pressure / bulk, below = 1 - 1e-9;  // exp and ln are not exact inverses
    point.go_to_strains(Vec3::Zero(), Vec3::Constant(-below * at_yield / 3), 1);
    EXPECT_EQ(point.memory.compaction, 0);
    point.go_to_strains(Vec3::Constant(-at_yield / 3), Vec3::Constant(volume / 3), steps);
    EXPECT_LT((point.kirchhoff() + pressure * Mat3::Identity()).norm(), kExact * pressure);
    EXPECT_NEAR(point.memory.compaction, kappa, kExact * kappa);
    EXPECT_NEAR(point.memory.plastic_work, 0.5 * (p.cap_pressure + pressure) * kappa, 1e-8 * pressure * kappa);
    // Free of stress at the volume that compaction has left, and elastic all the way.
    const material::DruckerPragerMemory loaded = point.memory;
    point.go_to_strains(Vec3::Constant(volume / 3), Vec3::Constant(-kappa / 3), 10);
    EXPECT_LT(point.kirchhoff().norm(), kExact * pressure);
    EXPECT_TRUE(same_plastic_state(point.memory, loaded));
  }
}

TEST(DruckerPragerPath, OfHydrostaticTensionStopsAtTheCutOff) {
  MaterialPoint point(rock());
  auto& p = point.params.drucker_prager;
  p.tension_cutoff = 2e6;
  const double volume = 1e-2;
  point.go_to_strains(Vec3::Zero(), Vec3::Constant(volume / 3), 50);
  EXPECT_LT((point.kirchhoff() - 2e6 * Mat3::Identity()).norm(), kExact * 2e6);
  EXPECT_EQ(point.memory.plastic_shear, 0);
  const double opened = volume - p.tension_cutoff / point.bulk();
  EXPECT_NEAR(point.memory.plastic_work, p.tension_cutoff * opened, 2e-2 * p.tension_cutoff * opened) << "first step";
}

/// Simple shear to large strain: with neither friction nor hardening the axes of stress turn and its size stays.
TEST(DruckerPragerPath, OfLargeSimpleShearKeepsTheStrengthOfAPerfectCone) {
  MaterialPoint point(make_drucker_prager(0, 0, kCohesion));
  const double strength_in_shear = point.params.drucker_prager.cohesion_factor * kCohesion;
  for (int i = 1; i <= 2000; ++i) {
    Mat3 f = Mat3::Identity();
    f(0, 1) = 1e-3 * i;
    point.go_to(f);
    if (i < 5) continue;
    const Mat3 tau = point.kirchhoff(), deviator = tau - tau.trace() / 3 * Mat3::Identity();
    EXPECT_NEAR(deviator.norm() / std::sqrt(2.0), strength_in_shear, kExact * strength_in_shear);
    EXPECT_NEAR(tau.trace(), 0, 1e-7 * strength_in_shear) << "flow keeps the volume";
  }
}

}  // namespace
}  // namespace breccia::drucker_prager_paths_test
