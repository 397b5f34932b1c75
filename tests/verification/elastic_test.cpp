#include <gtest/gtest.h>

#include <cmath>

#include "verification/recorder.hpp"

namespace breccia::test::elastic_test {
namespace {

constexpr double kResidual = 1e-3;  // of the largest term: the limit for every case of the repository

TEST(Elastic, APulseRunsAlongABarThatCannotWidenAtTheSpeedOfPWaves) {
  const Recording run = run_case_file("bar_wave/case.toml");
  constexpr double kYoung = 26.6e9, kPoisson = 0.205, kDensity = 2340, kLength = 1.0, kPulse = 120e-6;
  const double speed = std::sqrt(kYoung * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson)) / kDensity);
  // Centroid of the pulse at the far end, in the window before its echo can come back.
  double sum = 0, moment = 0;
  for (const HistoryRow& row : run.rows) {
    if (row.time > 2.5 * kLength / speed) break;
    // Velocities belong to half a step after the row's time.
    const double velocity = row.gauges[1].velocity[0], time = row.time + 0.5 * row.time_step;
    sum += velocity;
    moment += velocity * time;
  }
  const double travelled = moment / sum - 0.5 * kPulse;
  constexpr double kDispersion = 1e-3;  // 100 elements a length
  EXPECT_NEAR(kLength / travelled / speed, 1.0, kDispersion);
  EXPECT_LT(run.worst_residual(), kResidual);
}

TEST(Elastic, ACantileverOfLinearTetrahedraBendsByTheirStaticDeflection) {
  const Recording run = run_case_file("cantilever/case_smoke.toml");
  constexpr double kStatic = -5.014e-3;  // m, linear static solution on the same mesh
  constexpr double kTolerance = 0.1e-3;  // m, choice of diagonals and what damping leaves of the ringing
  EXPECT_NEAR(run.rows.back().gauges[0].max_displacement[2], kStatic, kTolerance);
  EXPECT_LT(run.worst_residual(), kResidual);
}

TEST(Elastic, JointsMakeTheCantileverSofterByTheirCompliance) {
  const Recording run =
      run_case_file("cantilever/case_joints_10.toml",
                    {"stage.bend.end=0.5 s", "stage[0].mass_damping=60",
                     "stage[0].gravity=[0, 0, {ramp = {from = 0, to = -9.81, start = 0, end = 0.2}}]"});
  constexpr double kStatic = -6.25e-3, kTolerance = 0.1e-3;  // m, static solution with joints of penalty 10 E
  EXPECT_NEAR(run.rows.back().gauges[0].max_displacement[2], kStatic, kTolerance);
  EXPECT_LT(run.worst_residual(), kResidual);
}

}  // namespace
}  // namespace breccia::test::elastic_test
