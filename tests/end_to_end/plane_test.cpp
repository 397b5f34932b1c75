#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"

/// Plane strain and stress with joints and contact.
namespace breccia::test::plane_test {
namespace {

/// A plate of one layer that rushes into another one.
const std::string kPlates = R"(title = "Plates"
[mesh]
file = "plates.geo"
[plane]
kind = "strain"
[[material]]
group = "plate"
young = "20 GPa"
poisson = 0.2
density = 2400
[[material]]
group = "target"
young = "20 GPa"
poisson = 0.2
density = 2400
[[joint]]
group = "plate"
penalty_factor = 20
tensile_strength = "3 MPa"
shear_strength = "9 MPa"
energy_mode_1 = "20 J/m2"
friction = 0.5
[[joint]]
group = "target"
penalty_factor = 20
tensile_strength = "3 MPa"
shear_strength = "9 MPa"
energy_mode_1 = "20 J/m2"
friction = 0.5
[[contact]]
between = ["*", "*"]
penalty = "20 GPa"
friction = 0.4
[[initial_velocity]]
group = "plate"
velocity = ["12 m/s", "2 m/s", 0]
[[stage]]
end = "0.1 ms"
[[stage.constraint]]
group = "foot"
fixed = "xyz"
[output]
frame_interval = "0.1 ms"
)";

/// Returns the quoted path of the case.
std::string plates(const Scratch& scratch, const std::string& kind) {
  scratch.write("plates.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.04, 0.03};
Rectangle(2) = {0.041, -0.01, 0, 0.02, 0.05};
v[] = Extrude {0, 0, 0.006} { Surface{1}; Layers{1}; };
w[] = Extrude {0, 0, 0.006} { Surface{2}; Layers{1}; };
Physical Volume("plate") = {v[1]};
Physical Volume("target") = {w[1]};
Physical Surface("foot") = Surface In BoundingBox {0.03, -0.011, -1, 0.07, -0.009, 1};
MeshSize{:} = 0.006;
)");
  std::string text = kPlates;
  const std::string from = "\"strain\"";
  text.replace(text.find(from), from.size(), "\"" + kind + "\"");
  if (kind == "stress") text.replace(text.find("\"xyz\""), 5, "\"xy\"");
  return scratch.write(kind + ".toml", text);
}

TEST(Plane, PlatesShatterToTheSameBitsOnAnyNumberOfRanks) {
  const Scratch scratch;
  for (const std::string kind : {"strain", "stress"}) {
    const std::string file = plates(scratch, kind);
    std::string hash;
    for (const int ranks : {1, kind == "strain" ? 3 : 2}) {
      const std::string folder = scratch.path(kind + std::to_string(ranks)).string();
      const Outcome outcome = call_ranks(ranks, "run " + file + " --progress none -o '" + folder + "'");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(energy_fault(folder + "/history.csv"), "");
      const auto summary = nlohmann::json::parse(read_text(folder + "/summary.json"));
      EXPECT_GT(summary.at("broken_joints"), 20) << kind;
      if (hash.empty()) hash = summary.at("state_hash");
      EXPECT_EQ(summary.at("state_hash"), hash) << kind << " on " << ranks << " ranks";
    }
  }
}

/// A slice that is pressed on another one, without friction, and slides along it.
const std::string kPress = R"(title = "Press"
[mesh]
file = "press.geo"
[plane]
kind = "stress"
[[material]]
group = "block"
young = "70 GPa"
poisson = 0.3
density = 2700
joints = "none"
[[material]]
group = "press"
young = "210 GPa"
poisson = 0.3
density = 7800
joints = "none"
[[contact]]
between = ["*", "*"]
penalty = "70 GPa"
[[stage]]
end = "1.2 ms"
mass_damping = 2000
[[stage.constraint]]
group = "press"
[stage.constraint.velocity]
x = { table = [[0, 0], ["0.4 ms", 0], ["0.5 ms", 0.4], ["2 ms", 0.4]] }
y = { table = [[0, 0], ["0.1 ms", -0.05], ["0.3 ms", -0.05], ["0.4 ms", 0], ["2 ms", 0]] }
[[stage.constraint]]
group = "base"
fixed = "xy"
[output]
frame_interval = 0
history_interval = "0.1 ms"
gauges = ["press", "block"]
)";

TEST(Plane, APressUnderPlaneStressStaysInItsPlaneAndKeepsPressing) {
  const Scratch scratch;
  scratch.write("press.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-0.005, -0.004, 0, 0.010, 0.004};
Rectangle(2) = {-0.001, 0, 0, 0.002, 0.002};
Extrude {0, 0, 0.001} { Surface{1:2}; Layers{1}; }
Physical Volume("block") = {1};
Physical Volume("press") = {2};
Physical Surface("base") = Surface In BoundingBox {-1, -0.004-1e-6, -1, 1, -0.004+1e-6, 1};
MeshSize{:} = 0.001;
Mesh.Algorithm = 5;
)");
  const std::string history = scratch.path("run/history.csv").string();
  const Outcome outcome =
      call("run " + scratch.write("press.toml", kPress) + " --progress none -o '" + scratch.path("run").string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(energy_fault(history), "");
  const std::vector<double> time = history_column(history, "time [s]");
  const std::vector<double> force = history_column(history, "press reaction y [N]");
  const std::vector<double> across = history_column(history, "press displacement z [m]");
  double pressed = 0;
  for (std::size_t line = 0; line < time.size(); ++line) {
    EXPECT_LT(std::abs(across[line]), 1e-6) << "at " << time[line] << " s";
    if (time[line] < 0.45e-3) pressed = force[line];
    if (time[line] < 0.55e-3) continue;
    EXPECT_NEAR(force[line] / pressed, 1.0, 0.15) << "slides at " << time[line] << " s";
  }
  // 10 um on a stack of 6 mm, whose lower part is the wider one: no less than a quarter of what a bar would bear.
  EXPECT_LT(pressed, -0.25 * 70e9 * 2e-6 * 10e-6 / 6e-3);
}

}  // namespace
}  // namespace breccia::test::plane_test
