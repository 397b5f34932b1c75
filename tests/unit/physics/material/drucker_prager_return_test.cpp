#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "physics/material/drucker_prager_return.hpp"

namespace breccia::material::drucker_prager_return_test {
namespace {

constexpr double kConsistency = 1e-12;  // of the strength, the goal of the return
constexpr double kMu = 12e9, kBulk = 17e9, kDegree = 3.14159265358979323846 / 180;

DruckerPragerParams concrete(double friction_angle = 37 * kDegree, double dilation_angle = 12 * kDegree) {
  DruckerPragerParams p = make_drucker_prager(friction_angle, dilation_angle, 12e6);
  p.hardening = 0.7e9;
  p.tension_cutoff = 4e6;
  p.cap_pressure = 150e6;
  p.cap_hardening = 3e9;
  return p;
}

struct Strengths {
  double cone, cap;
};
Strengths strengths(const DruckerPragerParams& p, double shear, double compaction) {
  return {p.cohesion_factor * (p.cohesion + p.hardening * shear), p.cap_pressure + p.cap_hardening * compaction};
}

/// The equations of the header, one by one.
void expect_solution(const DruckerPragerParams& p, const MeanAndShear& trial, double alpha, double kappa) {
  const ReturnedStress r = return_stress(p, kMu, kBulk, trial, alpha, kappa);
  const auto [cone, cap] = strengths(p, alpha + r.cone, kappa + r.cap);
  const auto [m, s] = r.stress;
  const double f_s = s + p.friction * m - cone, f_c = -m - cap, f_t = m - p.tension_cutoff;
  const double scale = cone + std::abs(trial.mean) + trial.shear;
  const auto where = [&] {
    return testing::Message() << "trial m " << trial.mean << " s " << trial.shear << " -> " << m << ", " << s;
  };
  for (const double f : {f_s, f_c, f_t}) EXPECT_LE(f, kConsistency * scale) << where();
  EXPECT_GE(s, 0) << where();
  for (const double gamma : {r.cone, r.cap, r.cut}) EXPECT_GE(gamma, 0) << where();
  if (r.cone > 0) {
    EXPECT_GE(f_s, -kConsistency * scale) << where();
  }
  if (r.cap > 0) {
    EXPECT_GE(f_c, -kConsistency * scale) << where();
  }
  if (r.cut > 0) {
    EXPECT_GE(f_t, -kConsistency * scale) << where();
  }
  EXPECT_NEAR(m, trial.mean - kBulk * (p.dilation * r.cone - r.cap + r.cut), kConsistency * scale) << where();
  EXPECT_NEAR(s, trial.shear - kMu * r.cone, kConsistency * scale) << where();
  const double dissipation = r.cone * (s + p.dilation * m) - r.cap * m + r.cut * m;
  EXPECT_GE(dissipation, 0) << where();
  if (r.flows() && p.tension_cutoff > 0) {
    EXPECT_GT(dissipation, 0) << where();
  }
}

TEST(Return, FulfilsEveryConditionWhereverTheTrialStressLies) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mean(-600e6, 300e6), shear(0, 500e6), unit(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double phi = 60 * kDegree * unit(random);
    DruckerPragerParams p = concrete(phi, phi * unit(random));
    if (p.friction > 0) p.tension_cutoff = p.cohesion_factor * p.cohesion / p.friction * unit(random);
    if (i % 3 == 0) p.hardening = 0;
    if (i % 5 == 0) p.cap_hardening = 0;
    if (i % 7 == 0) p.tension_cutoff = 0;
    expect_solution(p, {mean(random), shear(random)}, 0.01 * unit(random), 0.02 * unit(random));
  }
}

TEST(Return, LeavesWhatIsWithinTheSurfaceAsItIs) {
  const DruckerPragerParams p = concrete();
  for (const MeanAndShear trial : {MeanAndShear{0, 0}, {3.9e6, 1e6}, {-140e6, 50e6}, {-10e6, 10e6}}) {
    const ReturnedStress r = return_stress(p, kMu, kBulk, trial, 0, 0);
    EXPECT_FALSE(r.flows());
    EXPECT_EQ(r.stress.mean, trial.mean);
    EXPECT_EQ(r.stress.shear, trial.shear);
  }
}

TEST(Return, MeetsEveryMechanismAndBothCorners) {
  const DruckerPragerParams p = concrete();
  const auto mechanisms = [&](double mean, double shear) {
    const ReturnedStress r = return_stress(p, kMu, kBulk, {mean, shear}, 0, 0);
    return (r.cone > 0 ? 1 : 0) + (r.cap > 0 ? 2 : 0) + (r.cut > 0 ? 4 : 0);
  };
  EXPECT_EQ(mechanisms(-30e6, 100e6), 1);
  EXPECT_EQ(mechanisms(-300e6, 10e6), 2);
  EXPECT_EQ(mechanisms(50e6, 0), 4);
  EXPECT_EQ(mechanisms(50e6, 1e6), 4);
  EXPECT_EQ(mechanisms(100e6, 60e6), 5);
  EXPECT_EQ(mechanisms(-300e6, 300e6), 3);
  EXPECT_EQ(mechanisms(-140e6, 400e6), 3) << "its dilation takes the return of the cone beyond the cap";
}

/// [de Souza Neto 2008, section 8.3.3]: perfect plasticity, no cut-off but the apex, which a pure tension returns to.
TEST(Return, OfAnApexEndsInIt) {
  const DruckerPragerParams p = make_drucker_prager(30 * kDegree, 30 * kDegree, 10e6);
  const double apex = 10e6 / std::tan(30 * kDegree);
  EXPECT_NEAR(p.tension_cutoff, apex, kConsistency * apex);
  for (const double shear : {0.0, 1e6, 20e6}) {
    const ReturnedStress r = return_stress(p, kMu, kBulk, {200e6, shear}, 0, 0);
    EXPECT_NEAR(r.stress.mean, apex, kConsistency * apex);
    EXPECT_NEAR(r.stress.shear, 0, kConsistency * apex);
  }
}

TEST(Return, DoesNotJumpWhereOneCaseGivesWayToAnother) {
  const DruckerPragerParams p = concrete();
  constexpr double kStep =
      1e3;  // Pa of trial stress; a return is no longer than its trial path, times the cone's slope
  for (double shear = 0; shear < 400e6; shear += 7e6) {
    MeanAndShear last{};
    for (double mean = -600e6; mean < 300e6; mean += 1e6) {
      const auto stress = [&](double m) { return return_stress(p, kMu, kBulk, {m, shear}, 0, 0).stress; };
      const MeanAndShear here = stress(mean), next = stress(mean + kStep);
      EXPECT_LT(std::hypot(next.mean - here.mean, next.shear - here.shear), 3 * kStep) << mean << " " << shear;
      if (mean > -600e6) {
        EXPECT_LT(std::hypot(last.mean - here.mean, last.shear - here.shear), 3e6);
      }
      last = here;
    }
  }
}

}  // namespace
}  // namespace breccia::material::drucker_prager_return_test
