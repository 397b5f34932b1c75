#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/raster_case.hpp"
#include "verification/recorder.hpp"

/// Cubes of Drucker-Prager material under slowly growing, homogeneous load: whole runs against closed form.
namespace breccia::test::plasticity_test {
namespace {

constexpr double kYoung = 30e9, kPoisson = 0.2, kCohesion = 8e6, kHardening = 1e9, kEdge = 20e-3;
constexpr double kBulk = kYoung / (3 * (1 - 2 * kPoisson));
constexpr double kPhi = 35 * std::numbers::pi / 180, kPsi = 10 * std::numbers::pi / 180;
constexpr double kQuasiStatic = 2e-3;  // of the strength: what is left of waves, and of the pressure on moved faces
constexpr double kResidual = 1e-3;     // of the largest term: the limit for every case of the repository

/// Three planes of symmetry; the stages follow. They end while the faces still move: no jump of speed in the reaction.
const std::string kCube = raster_case({.title = "a cube yields",
                                       .group = "cube",
                                       .cells = {2, 2, 2},
                                       .young = kYoung,
                                       .poisson = kPoisson,
                                       .density = 2340,
                                       .material = R"(law = "drucker_prager"
friction_angle = "35 deg"
dilation_angle = "10 deg"
cohesion = "8 MPa"
hardening = "1 GPa"
cap_pressure = "60 MPa"
cap_hardening = "5 GPa"
)",
                                       .end = 0}) +
                          R"([output]
gauges = ["cube.x1"]
history_interval = "20 us"
)";

/// @param x1  what is asked of the face x1: a constraint or nothing;  @param sides  pressure on y1 and z1
std::string stage(const std::string& name, const std::string& end, const std::string& x1, const std::string& sides) {
  std::string text = "[[stage]]\nname = \"" + name + "\"\nend = \"" + end + "\"\nmass_damping = 3e3\n";
  for (const std::string axis : {"x", "y", "z"}) {
    text += "[[stage.constraint]]\ngroup = \"cube." + axis + "0\"\nfixed = \"" + axis + "\"\n";
  }
  if (!x1.empty()) text += "[[stage.constraint]]\ngroup = \"cube.x1\"\ndisplacement = { x = " + x1 + " }\n";
  for (const std::string surface : {"x1", "y1", "z1"}) {
    if (sides.empty() || (surface == "x1" && !x1.empty())) continue;
    text += "[[stage.pressure]]\nsurface = \"cube." + surface + "\"\nvalue = " + sides + "\n";
  }
  return text;
}

/// Kirchhoff stress along x at the end, Pa.
double axial_stress(const Recording& run) {
  const GaugeReading& gauge = run.rows.back().gauges[0];
  return gauge.reaction[0] / (kEdge * kEdge) * (1 + gauge.displacement[0] / kEdge);
}

/// Compressive strength under a lateral pressure after so much plastic shear [Mohr-Coulomb].
double strength(double lateral, double gamma) {
  const double s = std::sin(kPhi);
  return lateral * (1 + s) / (1 - s) + 2 * (kCohesion + kHardening * gamma) * std::cos(kPhi) / (1 - s);
}

/// Axial stress that goes with an axial logarithmic strain beyond yield, from rest under the lateral pressure:
/// strain = -(stress - 2 nu lateral) / E - gamma (1/sqrt 3 - eta_g / 3), stress = strength(lateral, gamma).
double stress_at(double strain, double lateral) {
  const double dilation = 6 * std::sin(kPsi) / (std::sqrt(3.0) * (3 - std::sin(kPsi)));
  const double flow = 1 / std::sqrt(3.0) - dilation / 3, slope = strength(0, 1) - strength(0, 0);
  const double gamma = (-strain - (strength(lateral, 0) - 2 * kPoisson * lateral) / kYoung) / (flow + slope / kYoung);
  EXPECT_GT(gamma, 1e-3) << "the test shows nothing";
  return strength(lateral, gamma);
}

TEST(Plasticity, OfACubeInUniaxialCompressionIsThatOfTheClosedForm) {
  const Recording run =
      run_case_text(kCube + stage("press", "2 ms", "{ ramp = { to = \"-0.15 mm\", end = \"3 ms\" } }", ""));
  const double strain = std::log1p(run.rows.back().gauges[0].displacement[0] / kEdge);
  const double expected = stress_at(strain, 0);
  EXPECT_NEAR(axial_stress(run) / -expected, 1, kQuasiStatic);
  EXPECT_LT(run.worst_residual(), kResidual);
  const EnergyBudget& e = run.rows.back().energy;
  EXPECT_GT(e.plastic, e.elastic);
}

TEST(Plasticity, OfACubeInTriaxialCompressionIsThatOfTheClosedForm) {
  constexpr double kLateral = 10e6;
  const Recording run =
      run_case_text(kCube + stage("confine", "1 ms", "", "{ ramp = { to = \"10 MPa\", end = \"1 ms\" } }") +
                    stage("press", "3 ms", "{ table = [[\"1 ms\", 0], [\"4 ms\", \"-0.18 mm\"]] }", "\"10 MPa\""));
  const GaugeReading& gauge = run.rows.back().gauges[0];
  const double strain = std::log1p(gauge.displacement[0] / kEdge);
  EXPECT_NEAR(axial_stress(run) / -stress_at(strain, kLateral), 1, kQuasiStatic);
  EXPECT_LT(run.worst_residual(), kResidual);
}

TEST(Plasticity, OfACubeUnderPressureAllAroundIsThatOfTheCap) {
  std::string text = kCube + stage("press", "2 ms", "{ ramp = { to = \"-0.06 mm\", end = \"3 ms\" } }", "");
  for (const std::string axis : {"y", "z"}) {
    text += "[[stage.constraint]]\ngroup = \"cube." + axis + "1\"\ndisplacement = { " + axis +
            " = { ramp = { to = \"-0.06 mm\", end = \"3 ms\" } } }\n";
  }
  const Recording run = run_case_text(text);
  constexpr double kCap = 60e6, kCapHardening = 5e9;
  const double volume = -3 * std::log1p(run.rows.back().gauges[0].displacement[0] / kEdge);
  const double compaction = (kBulk * volume - kCap) / (kBulk + kCapHardening);
  ASSERT_GT(compaction, 1e-3);
  EXPECT_NEAR(axial_stress(run) / -(kCap + kCapHardening * compaction), 1, kQuasiStatic);
  EXPECT_LT(run.worst_residual(), kResidual);
  const double work = (kCap + 0.5 * kCapHardening * compaction) * compaction * kEdge * kEdge * kEdge;
  EXPECT_NEAR(run.rows.back().energy.plastic / work, 1, kQuasiStatic);
}

/// A bar of joined elements hits a wall, yields, and flies back with less: the budget closes.
TEST(Plasticity, OfABodyThatHitsAWallIsAccountedFor) {
  std::string text = kCube;
  text.replace(text.find("joints = \"none\""), 15, "joints = \"unbreakable\"");
  text +=
      "[[joint]]\ngroup = \"cube\"\n[[initial_velocity]]\ngroup = \"cube\"\nvelocity = [\"-20 m/s\", 0, 0]\n"
      "[[stage]]\nname = \"hit\"\nend = \"40 us\"\n[[stage.constraint]]\ngroup = \"cube.x0\"\nfixed = \"x\"\n";
  const Recording run = run_case_text(text);
  const EnergyBudget& e = run.rows.back().energy;
  EXPECT_GT(e.plastic, 0.1 * e.kinetic);
  EXPECT_LT(run.worst_residual(), kResidual);
  double before = 0;
  for (const HistoryRow& row : run.rows) {
    EXPECT_GE(row.energy.plastic, before) << row.time;
    before = row.energy.plastic;
  }
}

}  // namespace
}  // namespace breccia::test::plasticity_test
