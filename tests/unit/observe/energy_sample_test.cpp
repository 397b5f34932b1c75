#include "observe/energy_sample.hpp"

#include <gtest/gtest.h>

#include "unit/observe/two_cubes.hpp"

namespace breccia::energy_sample_test {
namespace {

constexpr double kVolume = 2 * test::kCubeEdge * test::kCubeEdge * test::kCubeEdge;  // m3
constexpr double kRounding = 1e-13;                                                  // relative

class EnergySampleOfCubes : public testing::Test, protected test::CubesDomain {
 protected:
  /// Every node gets the velocity, m/s, and is moved to strain * its place.
  void set(const Vec3& velocity, const Mat3& gradient) {
    NodalState& nodes = domain.state.nodes;
    for (Index n = 0; n < model.local.num_nodes; ++n) {
      store_node(nodes.velocity.data(), n, velocity);
      store_node(nodes.position.data(), n, gradient * load_node(model.local.reference.data(), n));
    }
  }
};

TEST_F(EnergySampleOfCubes, HasTheKineticEnergyOfHalfStepsBeforeAndAfter) {
  set(Vec3(3, 0, 4), Mat3::Identity());
  const double mass = test::kCubeDensity * kVolume;
  EXPECT_NEAR(energy_sample(domain.state.nodes.velocity, domain).budget.kinetic, 0.5 * mass * 25,
              kRounding * mass * 25);
  const Field<double> at_rest(domain.state.nodes.velocity.size(), 0.0);
  EXPECT_EQ(energy_sample(at_rest, domain).budget.kinetic, 0) << "1/2 m v(n-1/2) . v(n+1/2)";
}

TEST_F(EnergySampleOfCubes, HasTheElasticEnergyOfAUniformStretchAndNoneInItsJoints) {
  constexpr double kStretch = 1e-6, kYoung = 1e9, kPoisson = 0.2;
  const double modulus = kYoung * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson));  // Pa, of uniaxial strain
  set(Vec3::Zero(), Vec3(1 + kStretch, 1, 1).asDiagonal());
  const EnergySample sample = energy_sample(domain.state.nodes.velocity, domain);
  const double expected = 0.5 * modulus * kStretch * kStretch * kVolume;
  constexpr double kSecondOrder = 1e-5;  // the law is not linear in the stretch
  EXPECT_NEAR(sample.budget.elastic, expected, kSecondOrder * expected);
  EXPECT_NEAR(sample.budget.joint_elastic, 0, kRounding * expected);
  EXPECT_GE(sample.worst_element, 0);
}

TEST(EnergyResidual, IsWhatNoTermAccountsForInShareOfTheLargest) {
  EnergyBudget budget;
  budget.kinetic = 3;
  budget.joint_mode_1 = 1;
  budget.external_work = 5;
  set_residual(0.5, 1e-6, budget);
  EXPECT_DOUBLE_EQ(budget.residual, 0.5 + 5 - 4);
  EXPECT_DOUBLE_EQ(budget.residual_relative, 1.5 / 5);
  EXPECT_DOUBLE_EQ(excess_energy(budget), 4 - 5);
}

TEST(EnergyResidual, OfARunAtRestIsMeasuredAgainstItsRoundOff) {
  EnergyBudget budget;
  budget.elastic = 1e-20;
  set_residual(0, 1e-10, budget);
  EXPECT_DOUBLE_EQ(budget.residual_relative, 1e-10);
}

}  // namespace
}  // namespace breccia::energy_sample_test
