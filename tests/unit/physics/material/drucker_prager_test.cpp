#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "unit/physics/material/material_point.hpp"

/// What holds for every path.
namespace breccia::drucker_prager_test {
namespace {

using test::same_plastic_state;

using test::kDegree;
using test::MaterialPoint;
using test::matrix;
using test::tensor;

constexpr double kConsistency = 1e-12;

DruckerPragerParams rock() {
  DruckerPragerParams p = make_drucker_prager(35 * kDegree, 10 * kDegree, 8e6);
  p.hardening = 0.5e9;
  p.tension_cutoff = 3e6;
  p.cap_pressure = 100e6;
  p.cap_hardening = 2e9;
  return p;
}

/// Largest f of the three surfaces at the point's stress, over its strength.
double excess(const MaterialPoint& point) {
  const auto& p = point.params.drucker_prager;
  const Mat3 tau = point.kirchhoff();
  const double mean = tau.trace() / 3, shear = (tau - mean * Mat3::Identity()).norm() / std::sqrt(2.0);
  const double cone = p.cohesion_factor * (p.cohesion + p.hardening * point.memory.plastic_shear);
  const double cap = p.cap_pressure + p.cap_hardening * point.memory.compaction;
  const double scale = cone + std::abs(mean);
  return std::max({shear + p.friction * mean - cone, -mean - cap, mean - p.tension_cutoff}) / scale;
}

/// Random walk of F with steps of about a tenth of the strain at yield.
Mat3 walk(std::mt19937& random, const Mat3& f, double size) {
  return (Mat3::Identity() + test::random_matrix(random, size)) * f;
}

TEST(DruckerPrager, EndsEveryStepOnOrWithinTheYieldSurface) {
  std::mt19937 random(1);
  int flowed = 0;
  for (int path = 0; path < 40; ++path) {
    MaterialPoint point(rock());
    Mat3 f = Mat3::Identity();
    const Mat3 drift = test::random_matrix(random, 2e-4);
    for (int i = 0; i < 300; ++i) {
      const material::DruckerPragerMemory before = point.memory;
      f = walk(random, f, 2e-4) + drift;
      point.go_to(f);
      // Round-off of the strains is of the modulus, and two thousand times smaller than of the strength.
      EXPECT_LT(excess(point), kConsistency);
      EXPECT_GE(point.memory.plastic_work, before.plastic_work);
      EXPECT_GE(point.memory.plastic_shear, before.plastic_shear);
      EXPECT_GE(point.memory.compaction, before.compaction);
      flowed += same_plastic_state(point.memory, before) ? 0 : 1;
    }
  }
  EXPECT_GT(flowed, 1000);
}

TEST(DruckerPrager, ClosesElasticLoopsToTheBit) {
  std::mt19937 random(2);
  MaterialPoint point(rock());
  Mat3 shift = Mat3::Identity();
  shift(0, 0) -= 2e-3;
  shift(0, 1) += 6e-3;
  point.go_to(shift);  // flows
  point.go_to(Mat3::Identity() + 0.95 * (shift - Mat3::Identity()));
  const MaterialPoint start = point;
  ASSERT_GT(start.memory.plastic_shear, 0);
  for (int i = 0; i < 50; ++i) point.go_to(walk(random, start.gradient, 1e-6));
  point.go_to(start.gradient);
  EXPECT_EQ(std::memcmp(point.numbers(), start.numbers(), sizeof(material::DruckerPragerMemory)), 0);
  EXPECT_EQ(point.piola, start.piola);
}

TEST(DruckerPrager, TurnsItsStressWithTheElementAndRemembersTheSame) {
  std::mt19937 random(3);
  MaterialPoint still(rock()), turned(rock());
  Mat3 f = Mat3::Identity();
  for (int i = 0; i < 200; ++i) {
    f = walk(random, f, 1e-3);
    const Mat3 q = test::random_rotation(random);
    still.go_to(f);
    turned.go_to(q * f);
    EXPECT_LT((turned.piola - q * still.piola).norm(), 1e-6 * still.params.drucker_prager.cohesion);
  }
  EXPECT_NEAR(turned.memory.plastic_shear, still.memory.plastic_shear, 1e-12);
  EXPECT_NEAR(turned.memory.plastic_work, still.memory.plastic_work, 1e-6 * still.memory.plastic_work);
  EXPECT_GT(still.memory.plastic_shear, 0.01);
}

TEST(DruckerPrager, WithinTheSurfaceIsHookesLawAtSmallStrains) {
  std::mt19937 random(4);
  const MaterialPoint virgin(rock());
  for (const double size : {1e-5, 1e-6}) {
    MaterialPoint point = virgin;
    const Mat3 h = test::random_matrix(random, size), e = 0.5 * (h + h.transpose());
    point.go_to(Mat3::Identity() + h);
    const Mat3 hooke = point.params.lambda * e.trace() * Mat3::Identity() + 2 * point.params.mu * e;
    EXPECT_LT((point.piola - hooke).norm(), 12 * size * hooke.norm());
  }
  MaterialPoint turned = virgin;
  turned.go_to(test::random_rotation(random));
  EXPECT_LT(turned.piola.norm(), 1e-14 * 30e9);
}

/// The work that internal forces do under central differences is stored energy and plastic work, to second order.
TEST(DruckerPrager, AccountsForTheWorkOfItsStressToSecondOrderInTheStep) {
  const auto missing = [](int steps) {
    MaterialPoint point(rock());
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      Mat3 f;
      f << 1 - 0.01 * t, 0.02 * std::sin(3 * t), 0, 0.003 * t * t, 1 + 0.004 * std::sin(6 * t), 0, 0.001 * t, 0,
          1 - 0.002 * t;
      point.go_to(f);
    }
    EXPECT_GT(point.memory.plastic_work, 0.1 * point.stored());
    return (point.work - point.stored() - point.memory.plastic_work) / point.work;
  };
  const double coarse = std::abs(missing(1000)), fine = std::abs(missing(4000));
  EXPECT_LT(fine, 2e-5);
  EXPECT_LT(fine, coarse / 8) << "second order would be 1/16, first order 1/4";
}

TEST(DruckerPrager, IsTheDerivativeOfItsEnergyWhileItIsElasticOrCrushed) {
  std::mt19937 random(5);
  constexpr double kDifference = 1e-6, kTolerance = 1e-6;
  DruckerPragerParams strong = rock();  // elastic whatever comes
  strong.cohesion = 1e15;
  strong.tension_cutoff = strong.cap_pressure = 1e15;
  for (const double j : {1.3, 0.8, 0.2, 0.09, 0.0, -0.1, -1.0}) {
    MaterialPoint point(strong);
    for (double& number : point.memory.inverse_plastic) number = 0.1 * test::random_matrix(random, 1.0)(0, 0);
    Mat3 f = test::random_rotation(random) * (Mat3::Identity() + test::random_matrix(random, 0.2));
    f.col(1) *= 0.3 / f.determinant();
    point.go_to(f);
    f.col(1) *= j / f.determinant();
    point.go_to(f);
    const double scale = 30e9 + point.piola.norm();
    for (Eigen::Index k = 0; k < 9; ++k) {
      MaterialPoint low = point, high = point;
      low.gradient.data()[k] -= kDifference;
      high.gradient.data()[k] += kDifference;
      const double slope = (high.stored() - low.stored()) / (2 * kDifference);
      EXPECT_NEAR(point.piola.data()[k], slope, kTolerance * scale) << j;
    }
  }
}

TEST(DruckerPrager, StaysFiniteWhateverTheElementBecomesAndForgetsNothingOverIt) {
  MaterialPoint point(rock());
  point.go_to(Vec3(0.99, 1.0, 1.0).asDiagonal());
  const material::DruckerPragerMemory before = point.memory;
  ASSERT_GT(before.plastic_shear, 0);
  for (const Mat3& f : {Mat3(Mat3::Zero()), Mat3(-Mat3::Identity()), Mat3(Vec3(0, 1, 1).asDiagonal()),
                        Mat3(Vec3(1e-8, -3, 2).asDiagonal()), Mat3(Vec3(0.05, 1, 1).asDiagonal())}) {
    point.go_to(f);
    EXPECT_TRUE(point.piola.allFinite()) << f;
    EXPECT_TRUE(std::isfinite(point.stored())) << f;
    EXPECT_EQ(std::memcmp(&point.memory, &before, sizeof before), 0) << f;
  }
  point.go_to(Vec3(0.99, 1.0, 1.0).asDiagonal());
  EXPECT_TRUE(same_plastic_state(point.memory, before)) << "as if it had not been crushed";
}

TEST(DruckerPrager, PushesACollapsedElementBackOpen) {
  MaterialPoint point(rock());
  for (double s = 0.9; s > -2.0; s -= 0.01) {  // uniaxial compression through flat to inside out
    point.go_to(Vec3(s, 1, 1).asDiagonal());
    ASSERT_LT(point.piola(0, 0), 0.0) << s;
  }
}

TEST(DruckerPrager, IsContinuousWhereTheContinuationBegins) {
  MaterialPoint point(rock());
  constexpr double kGap = 1e-9;
  for (double s = 1; s > 0.101; s -= 1e-3) point.go_to(Vec3(s, 1, 1).asDiagonal());
  point.go_to(Vec3(0.1 + kGap, 1, 1).asDiagonal());
  const Mat3 above = point.piola;
  point.go_to(Vec3(0.1 - kGap, 1, 1).asDiagonal());
  // An elastic step of strain 2 kGap / 0.1 beyond the surface, and the pressure of so much below.
  EXPECT_LT((point.piola - above).norm(), 1e3 * kGap * 30e9);
}

/// Stiffness of one element about its present state, by differences of its forces.
double largest_stiffness(const MaterialPoint& point, const Mat3& inverse) {
  Eigen::Matrix<double, 12, 12> stiffness;
  Eigen::Matrix<double, 4, 3> gradient;
  gradient.bottomRows<3>() = inverse;
  gradient.row(0) = -inverse.colwise().sum();
  constexpr double kDifference = 1e-7;
  const auto forces = [&](const Mat3& f) {
    material::DruckerPragerMemory passing = point.memory;
    elasticity::Tensor<double> piola;
    material::drucker_prager_piola(point.params, tensor(f).data(), passing.inverse_plastic.data(), piola.data());
    const Eigen::Matrix<double, 4, 3> rows = gradient * matrix(piola).transpose();
    return rows;
  };
  for (Eigen::Index a = 0; a < 4; ++a) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      Mat3 change = Mat3::Zero();
      change.row(i) = kDifference * gradient.row(a);
      const Eigen::Matrix<double, 4, 3> slope =
          (forces(point.gradient + change) - forces(point.gradient - change)) / (2 * kDifference);
      for (Eigen::Index b = 0; b < 4; ++b) stiffness.block<1, 3>(3 * a + i, 3 * b) = slope.row(b);
    }
  }
  const Eigen::Matrix<double, 12, 12> symmetric = 0.5 * (stiffness + stiffness.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>>(symmetric).eigenvalues().maxCoeff();
}

double bound(const MaterialPoint& point, const Mat3& inverse) {
  return material::drucker_prager_stiffness(point.params, tensor(point.gradient).data(), point.numbers(),
                                            tensor(inverse).data());
}

Mat3 random_gradient(std::mt19937& random) {
  for (;;) {
    const Mat3 f = test::random_rotation(random) * (Mat3::Identity() + test::random_matrix(random, 0.3));
    if (f.determinant() > 0.3) return f;
  }
}

TEST(DruckerPrager, IsNeverStifferThanItsBound) {
  std::mt19937 random(6);
  DruckerPragerParams strong = rock();
  strong.cohesion = strong.tension_cutoff = strong.cap_pressure = 1e15;
  std::uniform_real_distribution<double> volume(-0.5, 1.5);
  std::vector<double> ratios;
  for (int i = 0; i < 2000; ++i) {
    MaterialPoint point(strong);
    for (double& number : point.memory.inverse_plastic) number = 0.2 * test::random_matrix(random, 1.0)(0, 0);
    Mat3 f = random_gradient(random);
    f.col(1) *= 0.11 / f.determinant();
    point.go_to(f);  // what a crushed element goes on from
    f.col(1) *= volume(random) / f.determinant();
    point.gradient = f;
    const Mat3 inverse = Mat3::Identity() + test::random_matrix(random, 0.4);
    const double ratio = bound(point, inverse) / largest_stiffness(point, inverse);
    ASSERT_GE(ratio, 1.0) << f.determinant();
    if (f.determinant() > point.params.j_min) ratios.push_back(ratio);  // crushed ones mostly give way
  }
  std::sort(ratios.begin(), ratios.end());
  RecordProperty("least", std::to_string(ratios.front()));
  RecordProperty("median", std::to_string(ratios[ratios.size() / 2]));
  RecordProperty("most", std::to_string(ratios.back()));
  EXPECT_LT(ratios[ratios.size() / 2], 4) << "a bound that is no use";
}

TEST(DruckerPrager, IsNotStifferWhileItFlows) {
  std::mt19937 random(7);
  int flowed = 0;
  for (int i = 0; i < 300; ++i) {
    MaterialPoint point(rock());
    Mat3 f = Mat3::Identity();
    for (int step = 0; step < 20; ++step) point.go_to(f = walk(random, f, 1e-3));
    flowed += point.memory.plastic_shear > 0 ? 1 : 0;
    const Mat3 inverse = Mat3::Identity() + test::random_matrix(random, 0.4);
    ASSERT_LE(largest_stiffness(point, inverse), bound(point, inverse));
  }
  EXPECT_GT(flowed, 200);
}

}  // namespace
}  // namespace breccia::drucker_prager_test
