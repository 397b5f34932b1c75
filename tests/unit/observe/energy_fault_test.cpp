#include "observe/energy_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace breccia::energy_fault_test {
namespace {

constexpr double kResidualLimit = 0.05, kGainLimit = 0.01, kFloor = 1e-9;

std::string key_of_fault(EnergyBudget budget, double first_excess = 0) {
  set_residual(first_excess, kFloor, budget);
  return energy_fault(budget, kResidualLimit, kGainLimit).key;
}

TEST(EnergyFault, NamesTheGainBeforeTheResidualThatItIsPartOf) {
  EnergyBudget budget;
  budget.external_work = 100;
  budget.kinetic = 60;
  budget.elastic = 30;
  budget.plastic = 10;
  EXPECT_EQ(key_of_fault(budget), "");
  budget.elastic = 42;
  EXPECT_EQ(key_of_fault(budget), "time.energy_gain_limit") << "2 % more is held than was put in";
  budget.elastic = 20;
  budget.plastic = 10;
  EXPECT_EQ(key_of_fault(budget), "time.residual_limit") << "10 % have gone nowhere";
}

TEST(EnergyFault, RefusesSharesThatAreNoNumbersThoughTheResidualIsOne) {
  EnergyBudget budget;
  set_residual(0, 0, budget);  // 0 / 0
  ASSERT_TRUE(std::isnan(budget.residual_relative));
  EXPECT_EQ(energy_fault(budget, kResidualLimit, kGainLimit).what, "the energies are not finite");
}

TEST(EnergyFault, SeesAGainThatAFallingDissipationHides) {
  EnergyBudget budget;
  budget.external_work = 100;
  budget.kinetic = 110;
  budget.joint_mode_1 = -10;
  EXPECT_EQ(key_of_fault(budget), "time.energy_gain_limit");
  EXPECT_EQ(budget.residual, 0);
}

TEST(EnergyFault, CountsWhatWasThereAtFirstAsPutIn) {
  EnergyBudget budget;
  budget.kinetic = 100;
  EXPECT_EQ(key_of_fault(budget, 100), "");
  EXPECT_EQ(key_of_fault(budget, 50), "time.energy_gain_limit");
}

TEST(EnergyFault, AccountsWhatChangesOfTheStepMoveButDoesNotCountItAsPutIn) {
  EnergyBudget budget;
  budget.external_work = 100;
  budget.kinetic = 90;
  budget.step_change = -10;
  EXPECT_EQ(key_of_fault(budget), "") << "taken";
  budget.kinetic = 110;
  budget.step_change = 10;
  EXPECT_EQ(key_of_fault(budget), "time.energy_gain_limit") << "given";
}

TEST(EnergyFault, IsNoneWhileTheLargestTermIsRoundOff) {
  EnergyBudget budget;
  budget.kinetic = 0.9 * kFloor;
  EXPECT_EQ(key_of_fault(budget), "");
  budget.kinetic = 1.1 * kFloor;
  EXPECT_EQ(key_of_fault(budget), "time.energy_gain_limit");
}

TEST(EnergyFault, IsFoundInNumbersThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EnergyBudget budget;
    budget.elastic = bad;
    set_residual(0, kFloor, budget);
    EXPECT_EQ(energy_fault(budget, kResidualLimit, kGainLimit).what, "the energies are not finite");
  }
}

}  // namespace
}  // namespace breccia::energy_fault_test
