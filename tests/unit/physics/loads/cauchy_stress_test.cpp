#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "physics/cauchy_stress.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::cauchy_stress_test {
namespace {

using test::Model;

constexpr double kRounding = 2e-15;  // of the largest entry: some ten ulps

Vec3 by_eigen(const Mat3& t) {
  const Vec3 ascending = Eigen::SelfAdjointEigenSolver<Mat3>(t, Eigen::EigenvaluesOnly).eigenvalues();
  return ascending.reverse();
}

Mat3 with_principals(std::mt19937& random, const Vec3& values) {
  std::normal_distribution<double> normal;
  const Mat3 q = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                     .normalized()
                     .toRotationMatrix();
  const Mat3 t = q * values.asDiagonal() * q.transpose();
  return 0.5 * (t + t.transpose());
}

TEST(PrincipalStresses, AgreeWithAnIterativeSolverOnRandomTensors) {
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const Mat3 m = test::random_matrix(random, 1e7), t = m + m.transpose();
    EXPECT_LT((principal_stresses(t) - by_eigen(t)).norm(), 5 * kRounding * t.norm());
  }
}

TEST(PrincipalStresses, StayAccurateWhereTheyNearlyCoincide) {
  std::mt19937 random(2);
  for (double gap = 1.0; gap > 1e-18; gap *= 0.1) {
    for (const Vec3& values : {Vec3(3, 3 - gap, 1), Vec3(3, 1 + gap, 1), Vec3(2 + gap, 2, 2 - gap), Vec3(gap, 0, 0),
                               Vec3(1e6, gap, -gap), Vec3(-1, -1 - gap, -1 - 2 * gap)}) {
      const Mat3 t = with_principals(random, values);
      const Vec3 found = principal_stresses(t);
      EXPECT_LT((found - values).norm(), 10 * kRounding * values.cwiseAbs().maxCoeff()) << values.transpose();
      EXPECT_GE(found[0], found[1]);
      EXPECT_GE(found[1], found[2]);
    }
  }
}

TEST(PrincipalStresses, OfDiagonalAndZeroTensorsAreTheirEntries) {
  EXPECT_EQ(principal_stresses(Mat3::Zero()), Vec3(0, 0, 0));
  EXPECT_EQ(principal_stresses(5.0 * Mat3::Identity()), Vec3(5, 5, 5));
  EXPECT_LT((principal_stresses(Vec3(-4, 7, 1).asDiagonal()) - Vec3(7, 1, -4)).norm(), 7 * kRounding);
  EXPECT_LT((principal_stresses(Vec3(0, 1e9, 0).asDiagonal()) - Vec3(1e9, 0, 0)).norm(), 1e9 * kRounding);
}

TEST(VonMises, IsTheFormulaOfThePrincipalStresses) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Mat3 m = test::random_matrix(random, 10), t = m + m.transpose();
    const Vec3 s = by_eigen(t);
    const double expected =
        std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)));
    EXPECT_NEAR(von_mises(t), expected, 1e-13 * expected);
  }
}

TEST(VonMises, OfUniaxialTensionIsThatTension) { EXPECT_NEAR(von_mises(Vec3(-7, 0, 0).asDiagonal()), 7.0, 1e-14); }

TEST(CauchyStress, OfAUniaxiallyStrainedElementIsTheClosedForm) {
  Model model(test::jittered(test::box({1, 1, 1}), 0.05, 4), Discretisation::own_nodes, 1000);
  const ElasticParams p = make_elastic_params(BulkLaw::neo_hookean, 2e9, 0.2, 300.0);
  constexpr double kStretch = 1.1, kRate = 50.0;  // 1/s, of the reference length
  model.map_positions([](const Vec3& x) { return Vec3(x[0], kStretch * x[1], x[2]); });
  for (const Index n : model.real_nodes()) {
    model.state.velocity[nodal(n, 1)] = kRate * model.local.reference[nodal(n, 1)];
  }
  const double along = p.mu / kStretch * (kStretch * kStretch - 1) + p.lambda / 2 * (kStretch - 1 / kStretch);
  const double across = p.lambda / 2 * (kStretch - 1 / kStretch);
  const double viscous = 2 * p.viscosity / kStretch * (kRate / kStretch);
  for (Index slot = 0; slot < 24; ++slot) {
    const Mat3 elastic = cauchy_stress(model.local, p, slot, model.state.position.data(), nullptr);
    EXPECT_LT((elastic - Mat3(Vec3(across, along, across).asDiagonal())).norm(), 1e-12 * 2e9);
    const Mat3 all = cauchy_stress(model.local, p, slot, model.state.position.data(), model.state.velocity.data());
    EXPECT_LT((all - elastic - Mat3(Vec3(0, viscous, 0).asDiagonal())).norm(), 1e-12 * 2e9);
    EXPECT_EQ(components(elastic), (std::array<double, 6>{elastic(0, 0), elastic(1, 1), elastic(2, 2), elastic(0, 1),
                                                          elastic(1, 2), elastic(0, 2)}));
  }
}

}  // namespace
}  // namespace breccia::cauchy_stress_test
