#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"

/// What is held along curves and at points of the mesh, and forces on them.
namespace breccia::test::curve_test {
namespace {

constexpr double kLength = 1.0, kSide = 0.1, kDensity = 2400, kGravity = 9.81;

/// A beam on two edges, held along its axis at a corner.
const std::string kBeam = R"(title = "Beam on two lines"
[mesh]
file = "beam.geo"
[[material]]
group = "beam"
young = "3 GPa"
poisson = 0.2
density = "2400 kg/m3"
[[joint]]
group = "beam"
penalty_factor = 20
tensile_strength = "3 MPa"
shear_strength = "9 MPa"
energy_mode_1 = "50 J/m2"
[[stage]]
end = "60 ms"
gravity = [0, 0, "-9.81 m/s2"]
local_damping = 0.8
[[stage.constraint]]
group = "left"
fixed = "yz"
[[stage.constraint]]
group = "right"
fixed = "yz"
[[stage.constraint]]
group = "pin"
fixed = "x"
[output]
gauges = ["left", "right", "pin"]
history_interval = "10 ms"
)";

const std::string kGeometry = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.1, 0.1};
Physical Volume("beam") = {1};
Physical Curve("left") = Curve In BoundingBox {-0.01, -0.01, -0.01, 0.01, 0.11, 0.01};
Physical Curve("right") = Curve In BoundingBox {0.99, -0.01, -0.01, 1.01, 0.11, 0.01};
Physical Point("pin") = Point In BoundingBox {-0.01, -0.01, -0.01, 0.01, 0.01, 0.01};
MeshSize{:} = 0.05;
)";

/// The same without gravity, with a force of 100 N on a line across its top.
std::string pressed_beam() {
  std::string text = kBeam;
  text.replace(text.find("gravity = "), std::string("gravity = [0, 0, \"-9.81 m/s2\"]").size(), "");
  text.replace(text.find("local_damping = 0.8"), 19, "mass_damping = \"300 1/s\"");
  text.insert(text.find("[output]"), "[[stage.force]]\ngroup = \"load\"\nvalue = [0, 0, \"-100 N\"]\n");
  text.replace(text.find("\"pin\"]"), 6, "\"pin\", \"load\"]");
  return text;
}

class Curves : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("beam.geo", kGeometry);
    beam_ = scratch_.write("beam.toml", kBeam);
  }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + scratch_.path(name).string() + "'"; }
  [[nodiscard]] std::string hash(const std::string& run) const {
    return nlohmann::json::parse(read_text(scratch_.path(run) / "summary.json")).at("state_hash");
  }

  Scratch scratch_;
  std::string beam_;
};

TEST_F(Curves, BearTheWeightOfWhatLiesOnThemTheSameOnAnyNumberOfRanks) {
  for (const int ranks : {1, 3}) {
    const std::string run = "run_" + std::to_string(ranks);
    const Outcome outcome =
        call_ranks(ranks, "run " + beam_ + " --progress none --set stage[0].end=40ms -o " + quoted(run));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(hash(run), hash("run_1"));
  }
  const double half = 0.5 * kLength * kSide * kSide * kDensity * kGravity;
  const auto last = [&](const std::string& column) {
    return history_column(scratch_.path("run_1") / "history.csv", column).back();
  };
  EXPECT_NEAR(last("left reaction z [N]"), half, 0.01 * half);
  EXPECT_NEAR(last("right reaction z [N]"), half, 0.01 * half);
  EXPECT_NEAR(last("pin reaction x [N]"), 0, 0.01 * half);
}

TEST_F(Curves, TakeAForceThatTheirSupportsCarryTheSameOnAnyNumberOfRanks) {
  std::string geometry = kGeometry;
  geometry.insert(geometry.find("Physical Volume"), R"(Point(101) = {0.3, 0, 0.1}; Point(102) = {0.3, 0.1, 0.1};
Line(101) = {101, 102};
BooleanFragments{ Volume{1}; Delete; }{ Line{101}; Delete; }
Physical Curve("load") = Curve In BoundingBox {0.29, -0.01, 0.09, 0.31, 0.11, 0.11};
)");
  scratch_.write("beam.geo", geometry);
  const std::string beam = scratch_.write("pressed.toml", pressed_beam());
  for (const int ranks : {1, 3}) {
    const std::string run = "pressed_" + std::to_string(ranks);
    const Outcome outcome = call_ranks(ranks, "run " + beam + " --progress none -o " + quoted(run));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(hash(run), hash("pressed_1"));
  }
  const auto last = [&](const std::string& column) {
    return history_column(scratch_.path("pressed_1") / "history.csv", column).back();
  };
  EXPECT_NEAR(last("left reaction z [N]"), 70, 0.1) << "by its levers";
  EXPECT_NEAR(last("right reaction z [N]"), 30, 0.1);
  const double sinks = -last("load displacement z [m]");
  EXPECT_GT(sinks, 0);
  EXPECT_NEAR(last("external work [J]"), 100 * sinks, 0.02 * 100 * sinks) << "F u of a force that was there at once";
}

TEST_F(Curves, AreHeldOnAfterAResumeOnOtherRanks) {
  const Outcome whole = call("run " + beam_ + " --progress none --set stage[0].end=4ms -o " + quoted("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string first = " --progress none --set stage[0].end=4ms --set time.max_steps=200 -o " + quoted("part");
  ASSERT_EQ(call("run " + beam_ + first).exit_code, 0);
  const Outcome rest = call_ranks(2, "resume " + quoted("part") + " --progress none --set time.max_steps=0");
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(hash("part"), hash("whole"));
}

TEST_F(Curves, AreRefusedWhereNoNodeOfAnElementIsOnThem) {
  scratch_.write("apart.geo", kGeometry + "Point(101) = {5, 5, 5};\nPhysical Point(\"apart\") = {101};\n");
  std::string text = kBeam;
  text.replace(text.find("beam.geo"), 8, "apart.geo");
  text.replace(text.find("group = \"pin\""), 13, "group = \"apart\"");
  const Outcome outcome = call("check " + scratch_.write("apart.toml", text));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("stage[0].constraint[2].group: the group \"apart\" of the mesh holds no element, and no "
                             "node of one"),
            std::string::npos)
      << outcome.err;
}

TEST_F(Curves, AreNoSurfaces) {
  std::string text = kBeam;
  text.insert(text.find("[output]"), "[[stage.pressure]]\nsurface = \"left\"\nvalue = \"1 kPa\"\n");
  const Outcome outcome = call("check " + scratch_.write("wrong.toml", text));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("stage[0].pressure[0].surface: this is a curve or point of the mesh, where a surface group is "
                       "required; allowed: the mesh has none; given: left"),
      std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace breccia::test::curve_test
