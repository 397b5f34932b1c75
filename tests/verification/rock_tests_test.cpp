#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/recorder.hpp"

// The tests of laboratories in meshes/, on coarser meshes.

namespace breccia::test::rock_tests_test {
namespace {

/// Mean distance of the broken joints of the last frame from the plane x = 0, m.
double mean_distance_of_cracks(const Recording& run) {
  const Frame::Joints& joints = run.frames.back().joints;
  double sum = 0;
  int count = 0;
  for (std::size_t j = 0; j < joints.id.size(); ++j) {
    if (joints.broken[j] == 0) continue;
    sum += std::abs(joints.points[9 * j] + joints.points[9 * j + 3] + joints.points[9 * j + 6]) / 3;
    ++count;
  }
  return count == 0 ? INFINITY : sum / count;
}

/// Largest reaction of the first gauge along y so far and the one at the end, N.
std::pair<double, double> press(const Recording& run) {
  double most = 0;
  for (const HistoryRow& row : run.rows) most = std::max(most, std::abs(row.gauges[0].reaction[1]));
  return {most, std::abs(run.rows.back().gauges[0].reaction[1])};
}

TEST(Disc, SplitsAlongTheDiameterThatIsLoaded) {
  const Recording run = run_case_file("disc/case.toml", {R"(mesh.parameters={ h = "5 mm", h_platen = "4 mm" })"});
  // Cracks all over the disc would be 4 R / (3 pi) = 10.6 mm from the diameter in the mean.
  constexpr double kNearTheDiameter = 0.006;
  EXPECT_LT(mean_distance_of_cracks(run), kNearTheDiameter);
  const auto [most, left] = press(run);
  // Strength by the elastic solution, 2 P / (pi D t). The disc is no larger than a few process zones: it holds more.
  const double strength = 2 * most / (M_PI * 0.05 * 0.012);
  EXPECT_GT(strength, 5e6);
  EXPECT_LT(strength, 2.5 * 5e6);
  EXPECT_LT(left, 0.7 * most) << "it holds no more";
  constexpr double kResidual = 1e-3;
  EXPECT_LT(run.worst_residual(), kResidual);
}

TEST(NotchedBeam, BreaksFromItsNotchByOpening) {
  const Recording run =
      run_case_file("notched_beam/case.toml", {R"(mesh.parameters={ h = "3 mm", h_roller = "3 mm" })"});
  constexpr double kNearTheNotch = 0.003;  // an element
  EXPECT_LT(mean_distance_of_cracks(run), kNearTheNotch);
  EXPECT_GT(run.rows.back().broken_mode_1, 0);
  EXPECT_GT(run.rows.back().energy.joint_mode_1, run.rows.back().energy.joint_mode_2);
  constexpr double kResidual = 1e-3;
  EXPECT_LT(run.worst_residual(), kResidual);
}

TEST(Cylinder, IsCrushedAtTheLoadOfItsCohesionAndFriction) {
  const Recording run = run_case_file("cylinder/case.toml", {R"(mesh.parameters={ h = "8 mm", h_platen = "8 mm" })"});
  const auto [most, left] = press(run);
  // 2 c (sqrt(1 + mu^2) + mu) for a shear plane that may lie as it will; between elements it may not.
  const double strength = 2 * 15e6 * (std::sqrt(1 + 0.36) + 0.6), measured = most / (M_PI * 0.025 * 0.025);
  EXPECT_GT(measured, strength);
  EXPECT_LT(measured, 1.6 * strength);
  EXPECT_LT(left, 0.2 * most) << "it holds no more";
  EXPECT_GT(run.rows.back().broken_mode_2, run.rows.back().broken_mode_1);
  constexpr double kResidual = 1e-3;
  EXPECT_LT(run.worst_residual(), kResidual);
}

}  // namespace
}  // namespace breccia::test::rock_tests_test
