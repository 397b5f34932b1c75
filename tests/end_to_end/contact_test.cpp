#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"

/// Bodies in contact as a user meets them: overlaps at the start, ridges, slopes.
namespace breccia::test::contact_test {
namespace {

using nlohmann::json;

std::string material(const std::string& group, const std::string& young) {
  return "[[material]]\ngroup = \"" + group + "\"\nyoung = \"" + young +
         "\"\npoisson = 0.2\ndensity = 2000\njoints = \"none\"\n";
}

const std::string kCubesGeometry = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.01, 0.01, 0.01};
Box(2) = {0.002, 0.001, 0.009, 0.01, 0.01, 0.01};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
MeshSize{ PointsOf{ Volume{:}; } } = 0.005;
)";

/// Two cubes 1 mm in each other. Returns the quoted path of the case.
std::string cubes(const Scratch& scratch) {
  scratch.write("cubes.geo", kCubesGeometry);
  return scratch.write("cubes.toml", "title = \"cubes\"\n[mesh]\nfile = \"cubes.geo\"\n" + material("lower", "40 GPa") +
                                         material("upper", "40 GPa") + R"([[contact]]
between = ["lower", "upper"]
penalty = "40 GPa"
[[initial_velocity]]
group = "upper"
velocity = [0, 0, "-0.1 m/s"]
[[stage]]
end = "30 us"
[output]
frame_interval = 0
)");
}

TEST(InitialOverlap, EndsARunWithTheBodiesTheDepthAndWhatHelps) {
  const Scratch scratch;
  const std::string file = cubes(scratch), folder = scratch.path("run").string();
  for (const Outcome& outcome : {call("run " + file + " --progress none -o '" + folder + "'"),
                                 call_ranks(2, "run " + file + " --progress none -o '" + folder + "'")}) {
    EXPECT_EQ(outcome.exit_code, 2);
    for (const char* text : {"cubes.toml:16: contact[0].initial_overlap", "\"lower\" and \"upper\"", "1 mm", "points",
                             "\"relax\"", "\"accept\""})
      EXPECT_NE(outcome.err.find(text), std::string::npos) << text << " in\n" << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder)) << "nothing was run";
  const Outcome check = call("check " + file);
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.out.find("overlap by up to 1 mm"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("A run ends with an error"), std::string::npos) << check.out;
}

TEST(InitialOverlap, IsNotSeenAtTheFrontOfACrackBetweenGluedBodies) {
  const Scratch scratch;
  scratch.write("four.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.02, 0.02, 0.02}; Box(2) = {0.02, 0, 0, 0.02, 0.02, 0.02};
Box(3) = {0, 0.02, 0, 0.02, 0.02, 0.02}; Box(4) = {0.02, 0.02, 0, 0.02, 0.02, 0.02};
Coherence;
Physical Volume("rock") = {1, 2, 3, 4};
Physical Surface("cut") = Surface In BoundingBox{-1e-6, 0.02 - 1e-6, -1e-6, 0.02 + 1e-6, 0.02 + 1e-6, 0.02 + 1e-6};
MeshSize{PointsOf{Volume{:};}} = 0.01;
)");
  const std::string file = scratch.write("four.toml", R"([mesh]
file = "four.geo"
glue = true
[[material]]
group = "rock"
young = "10 GPa"
poisson = 0.2
density = 2500
joints = "breakable"
[[joint]]
group = "rock"
tensile_strength = "3 MPa"
energy_mode_1 = "50 J/m2"
[joints]
broken = ["cut"]
[[contact]]
between = ["*", "*"]
penalty = "10 GPa"
[[stage]]
end = "1 us"
[output]
frame_interval = 0
)");
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " --progress none -o '" + folder + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json energy = json::parse(read_text(folder + "/summary.json")).at("energy");
  EXPECT_LT(energy.at("kinetic").get<double>(), 1e-18) << "nothing pushes";
}

TEST(InitialOverlap, ThatIsRelaxedGivesNoEnergyAndTheSameBitsOnAnyNumberOfRanks) {
  const Scratch scratch;
  const std::string arguments =
      "run " + cubes(scratch) +
      " --progress none --set contact[0].initial_overlap=relax --set contact[0].points_on=first"
      " --set contact[0].damping_ratio=0.2 --set contact_points.per_face=4 -o '";
  std::string hash;
  for (const int ranks : {1, 2, 3}) {
    const std::string folder = scratch.path("run" + std::to_string(ranks)).string();
    const Outcome outcome = ranks == 1 ? call(arguments + folder + "'") : call_ranks(ranks, arguments + folder + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json summary = json::parse(read_text(folder + "/summary.json"));
    if (hash.empty()) hash = summary["state_hash"];
    EXPECT_EQ(summary["state_hash"], hash) << ranks << " ranks";
    constexpr double kUpper = 0.5 * 2000 * 1e-6 * 0.01;  // J, of the cube that flies
    EXPECT_LE(summary["energy"]["kinetic"].get<double>(), kUpper * 1.0001);
    EXPECT_GT(summary["energy"]["contact_dissipated"].get<double>(), 0.0);
    EXPECT_LT(std::abs(summary["energy"]["residual"].get<double>()), 2e-3 * kUpper);
  }
}

TEST(Interaction, ThatIsNoneLetsBodiesPassEachOtherWithTheSameBitsWhateverSearchesOnAnyRanks) {
  const Scratch scratch;
  const std::string file = cubes(scratch);
  std::string text = read_text(scratch.path("cubes.toml"));
  const std::string penalty = "penalty = \"40 GPa\"\n";
  text.replace(text.find(penalty), penalty.size(), "interaction = \"none\"\n");
  const std::string apart = scratch.write("apart.toml", text);
  const Outcome check = call("check " + apart);
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("no interaction (contact[0], line 16): lower with upper\n"), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("overlap"), std::string::npos) << check.out;
  std::string hash;
  for (const auto& [ranks, algorithm] : std::vector<std::pair<int, std::string>>{
           {1, "packed_tree"}, {1, "ms"}, {1, "brute_force"}, {2, "packed_tree"}, {3, "sorted_grid"}}) {
    const std::string folder = scratch.path(algorithm + std::to_string(ranks)).string();
    const std::string arguments = "run " + apart + " --progress none --set detection.verify=true" +
                                  " --set detection.algorithm=" + algorithm + " -o '" + folder + "'";
    const Outcome outcome = ranks == 1 ? call(arguments) : call_ranks(ranks, arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json summary = json::parse(read_text(folder + "/summary.json"));
    if (hash.empty()) hash = summary["state_hash"];
    EXPECT_EQ(summary["state_hash"], hash) << ranks << " ranks, " << algorithm;
    constexpr double kUpper = 0.5 * 2000 * 1e-6 * 0.01;  // J, of the cube that flies
    EXPECT_NEAR(summary["energy"]["kinetic"].get<double>() / kUpper, 1.0, 1e-9);
  }
  // Keys beside it would have no effect.
  const Outcome refused = call("check " + file + " --set contact[0].interaction=none");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("cubes.toml:18: contact[0].penalty: has no effect beside interaction = \"none\""),
            std::string::npos)
      << refused.err;
}

/// Runs a case in a folder of its own. @return  where its history is
std::string history_of(const Scratch& scratch, const std::string& file) {
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " --progress none -o '" + folder + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return folder + "/history.csv";
}

/// A block on a slope, at rest first, friction 0.5, 20 MPa. Returns its acceleration once it slides, m/s2. Nothing
/// damps it; the weight grows slowly, as a block that is set down at once bounces and slips.
double acceleration(double degrees, const std::string& floor_size, const std::string& penalty) {
  const Scratch scratch;
  scratch.write("block.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, -0.01, 1e-8, 0.04, 0.04, 0.02};
Box(2) = {-0.04, -0.03, -0.02, 0.12, 0.08, 0.02};
Physical Volume("block") = {1};
Physical Volume("floor") = {2};
MeshSize{ PointsOf{ Volume{1}; } } = 0.01;
MeshSize{ PointsOf{ Volume{2}; } } = )" +
                                 floor_size + ";\nMesh.Algorithm3D = 1;\n");
  const double angle = degrees * std::acos(-1.0) / 180;
  const auto ramp = [](double to, double start, double end) {
    return "{ ramp = { from = 0, to = " + std::to_string(to) + ", start = " + std::to_string(start) +
           ", end = " + std::to_string(end) + " } }";
  };
  const std::string file =
      scratch.write("block.toml", "title = \"slope\"\n[mesh]\nfile = \"block.geo\"\n" + material("block", "20 MPa") +
                                      material("floor", "20 MPa") + R"([[contact]]
between = ["block", "floor"]
penalty = ")" + penalty + R"("
friction = 0.5
points_on = "first"
[[stage]]
end = 0.19
gravity = [)" + ramp(9.81 * std::sin(angle), 0.06, 0.1) +
                                      ", 0, " + ramp(-9.81 * std::cos(angle), 0, 0.06) + R"(]
[[stage.constraint]]
group = "floor"
fixed = "xyz"
[output]
frame_interval = 0
history_interval = "1 ms"
gauges = ["block"]
)");
  const std::string history = history_of(scratch, file);
  const std::vector<double> t = history_column(history, "time [s]");
  const std::vector<double> x = history_column(history, "block displacement x [m]");
  // Three places after the ramp: their second difference is free of small vibrations.
  const auto at = [&](double time) {
    return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin());
  };
  const std::size_t a = at(0.11), b = at(0.1495), c = t.size() - 1;
  return 2 * ((x[c] - x[b]) / (t[c] - t[b]) - (x[b] - x[a]) / (t[b] - t[a])) / (t[c] - t[a]);
}

TEST(Slope, SteeperThanFrictionAcceleratesABlockAsItShouldOnCoarseAndFineFloors) {
  constexpr double kWithin = 0.005;  // twelve blocks: 0.04 % at most
  for (const double degrees : {27.0, 28.0, 30.0}) {
    const double angle = degrees * std::acos(-1.0) / 180;
    const double expected = 9.81 * (std::sin(angle) - 0.5 * std::cos(angle));
    for (const char* size : {"0.04", "0.01"}) {
      for (const char* penalty : {"2 MPa", "20 MPa"})
        EXPECT_NEAR(acceleration(degrees, size, penalty) / expected, 1.0, kWithin)
            << degrees << " degrees, floor " << size << ", penalty " << penalty;
    }
  }
}

TEST(Slope, LessSteepThanFrictionHoldsABlock) {
  constexpr double still = 1e-3;  // of what friction would stop it with
  for (const char* size : {"0.04", "0.01"}) {
    for (const char* penalty : {"2 MPa", "20 MPa"})
      EXPECT_NEAR(acceleration(26, size, penalty) / 0.1082, 0.0, still) << "floor " << size << ", penalty " << penalty;
  }
}

/// A plate of 10 GPa on another one, pressed with 2 MPa and driven along it at its top, undamped. Returns the mean of
/// its friction over that of the normal force once it slides.
double rubbed(double friction, const std::string& delay) {
  const Scratch scratch;
  scratch.write("plates.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 1e-9, 0.04, 0.015, 0.01};
Box(2) = {-0.015, -0.0075, -0.015, 0.07, 0.03, 0.015};
Physical Volume("upper") = {1};
Physical Volume("lower") = {2};
top() = Surface In BoundingBox{-1e-6, -1e-6, 0.0099, 0.041, 0.016, 0.0101};
Physical Surface("top") = {top()};
Mesh.MeshSizeMin = 0.005; Mesh.MeshSizeMax = 0.005;
)");
  const std::string file =
      scratch.write("plates.toml", "title = \"plates\"\n[mesh]\nfile = \"plates.geo\"\n" + material("upper", "10 GPa") +
                                       material("lower", "10 GPa") + R"([[contact]]
between = ["upper", "lower"]
penalty = "10 GPa"
friction = )" + std::to_string(friction) +
                                       "\nfriction_delay = " + delay + R"(
points_on = "first"
[[stage]]
end = "4 ms"
[[stage.pressure]]
surface = "top"
value = { ramp = { to = "2 MPa", end = "0.5 ms" } }
[[stage.constraint]]
group = "lower"
fixed = "xyz"
[[stage.constraint]]
group = "top"
velocity = { x = { ramp = { start = "0.5 ms", end = "1 ms", to = "0.5 m/s" } }, y = 0 }
[output]
frame_interval = 0
history_interval = "5 us"
gauges = ["upper"]
)");
  const std::string history = history_of(scratch, file);
  const auto column = [&](const char* name) { return history_column(history, name); };
  const std::vector<double> t = column("time [s]"), x = column("upper contact force x [N]"),
                            z = column("upper contact force z [N]");
  const auto slides = std::lower_bound(t.begin(), t.end(), 1.5e-3) - t.begin();
  return -std::accumulate(x.begin() + slides, x.end(), 0.0) / std::accumulate(z.begin() + slides, z.end(), 0.0);
}

TEST(Plates, ThatSlideUndampedRubWithTheirCoefficientWhereFrictionIsLate) {
  constexpr double kWithin = 0.002;  // measured: 0.3000 and 0.6000
  for (const double friction : {0.3, 0.6}) EXPECT_NEAR(rubbed(friction, "6"), friction, kWithin);
  EXPECT_LT(rubbed(0.6, "0"), 0.5) << "they vibrate without a delay";
}

TEST(Cylinder, PressedBetweenPlatensIsFeltWithinAMicrometreWhereFacesHavePointsAtTheirCorners) {
  const Scratch scratch;
  scratch.write("cylinder.geo", R"(SetFactory("OpenCASCADE");
R = 0.01; gap = 5e-7;
Point(1) = {0, 0, gap}; Point(2) = {R, 0, R + gap}; Point(3) = {0, 0, 2*R + gap}; Point(4) = {-R, 0, R + gap};
Point(5) = {0, 0, R + gap};
Circle(1) = {1, 5, 2}; Circle(2) = {2, 5, 3}; Circle(3) = {3, 5, 4}; Circle(4) = {4, 5, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
out() = Extrude {0, 0.012, 0} { Surface{1}; };
Box(2) = {-0.013, -0.003, -0.006, 0.026, 0.018, 0.006};
Box(3) = {-0.013, -0.003, 2*R + 2*gap, 0.026, 0.018, 0.006};
Physical Volume("cylinder") = {1};
Physical Volume("bottom") = {2};
Physical Volume("top") = {3};
MeshSize{ PointsOf{ Volume{:}; } } = 0.003;
)");
  const std::string file = scratch.write(
      "cylinder.toml", "title = \"cylinder\"\n[mesh]\nfile = \"cylinder.geo\"\n" + material("cylinder", "26 GPa") +
                           material("bottom", "200 GPa") + material("top", "200 GPa") + R"([[contact]]
between = ["*", "*"]
penalty = "26 GPa"
[contact_points]
per_face = 4
[[stage]]
end = "60 us"
[[stage.constraint]]
group = "bottom"
fixed = "xyz"
[[stage.constraint]]
group = "top"
velocity = { x = 0, y = 0, z = "-0.05 m/s" }
[output]
frame_interval = 0
history_interval = "2 us"
gauges = ["top"]
)");
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " --progress none -o '" + folder + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<double> t = history_column(folder + "/history.csv", "time [s]");
  const std::vector<double> force = history_column(folder + "/history.csv", "top contact force z [N]");
  constexpr double speed = 0.05, gap = 0.5e-6, micrometre = 1e-6;
  const auto felt = std::find_if(force.begin(), force.end(), [](double f) { return f > 0; });
  ASSERT_NE(felt, force.end());
  const double travel = speed * t[static_cast<std::size_t>(felt - force.begin())];
  EXPECT_GT(travel, gap * (1 - 1e-9)) << "felt before it touches; the line at which it does may be the first";
  EXPECT_LT(travel, gap + micrometre);
}

TEST(Platens, UndampedOnARockHoldTheirEnergyForTwentyThousandSteps) {
  // Contacts that last for a few steps, some hundred at a time. 17 % were lost where each forgot what it had lost, and
  // the run was stopped at 5 %.
  const Scratch scratch;
  scratch.write("platens.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-0.01, 0, -0.01, 0.02, 0.04, 0.02};
Box(2) = {-0.013, 0.040001, -0.013, 0.026, 0.006, 0.026};
Box(3) = {-0.013, -0.006001, -0.013, 0.026, 0.006, 0.026};
Physical Volume("rock") = {1};
Physical Volume("top") = {2};
Physical Volume("bottom") = {3};
Physical Surface("drive") = Surface In BoundingBox{-1, 0.0459, -1, 1, 0.0461, 1};
Physical Surface("foot") = Surface In BoundingBox{-1, -0.0061, -1, 1, -0.0059, 1};
MeshSize{ PointsOf{ Volume{1}; } } = 0.005;
MeshSize{ PointsOf{ Volume{2,3}; } } = 0.008;
)");
  for (const char* friction : {"0", "0.3"}) {
    const std::string file = scratch.write("platens.toml", "title = \"platens\"\n[mesh]\nfile = \"platens.geo\"\n" +
                                                               material("rock", "30 GPa") + material("top", "200 GPa") +
                                                               material("bottom", "200 GPa") + R"([[contact]]
between = ["*", "*"]
penalty = "300 GPa"
friction = )" + friction + R"(
[[stage]]
end = 1
[[stage.constraint]]
group = "foot"
fixed = "xyz"
[[stage.constraint]]
group = "drive"
velocity = { x = 0, z = 0, y = { ramp = { from = "-0.5 m/s", to = 0, start = 0, end = "20 us" } } }
[time]
max_steps = 20000
[output]
frame_interval = 0
history_interval = "40 us"
)");
    const std::string folder = scratch.path("run").string();
    const Outcome outcome = call("run " + file + " --overwrite --progress none -o '" + folder + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    constexpr double kUnaccounted = 2e-3;  // of the largest term; what couples have still to put right
    for (const double residual : history_column(folder + "/history.csv", "relative residual"))
      ASSERT_LT(std::abs(residual), kUnaccounted) << "friction " << friction;
  }
}

TEST(Platens, ThatHoldAVibratingBlockTakeAndGiveNothing) {
  // A block of rock squeezed by 5 % between rigid platens: its surface vibrates and turns under the points of the
  // platens. What single steps leave over there cancels; where it was put right 0.8 % of the energy came from nowhere
  // within 20 ms, and friction took 16 times as much.
  const Scratch scratch;
  scratch.write("block.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-0.01, 0, 0, 0.02, 0.02};
Rectangle(2) = {-0.03, 0.020001, 0, 0.06, 0.01};
Rectangle(3) = {-0.03, -0.010001, 0, 0.06, 0.01};
MeshSize{ PointsOf{ Surface{1}; } } = 0.005;
MeshSize{ PointsOf{ Surface{2, 3}; } } = 0.006;
rock[] = Extrude {0, 0, 0.005} { Surface{1}; Layers{1}; };
top[] = Extrude {0, 0, 0.005} { Surface{2}; Layers{1}; };
bottom[] = Extrude {0, 0, 0.005} { Surface{3}; Layers{1}; };
Physical Volume("rock") = {rock[1]};
Physical Volume("top") = {top[1]};
Physical Volume("bottom") = {bottom[1]};
)");
  const std::string file = scratch.write(
      "block.toml", "title = \"block\"\n[mesh]\nfile = \"block.geo\"\n[plane]\nkind = \"strain\"\n" +
                        material("rock", "30 GPa") + material("top", "30 GPa") + material("bottom", "30 GPa") +
                        R"([[contact]]
between = ["*", "*"]
penalty = "30 GPa"
friction = 0.3
[[stage]]
end = "10 ms"
[[stage.constraint]]
group = "bottom"
fixed = "xy"
[[stage.constraint]]
group = "top"
velocity = { x = 0, y = { ramp = { from = "-2 m/s", to = 0, start = 0, end = "1 ms" } } }
[output]
frame_interval = 0
history_interval = "1 ms"
)");
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " --progress none -o '" + folder + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const double residual : history_column(folder + "/history.csv", "relative residual"))
    EXPECT_LT(std::abs(residual), 3e-5);
  const std::vector<double> rubbed = history_column(folder + "/history.csv", "contact friction [J]"),
                            held = history_column(folder + "/history.csv", "elastic [J]");
  const double later = rubbed.back() - rubbed[rubbed.size() / 2];
  EXPECT_LT(later, 1e-5 * held.back()) << "nothing slides any more; the surface turned under the points took 5e-3";
}

}  // namespace
}  // namespace breccia::test::contact_test
