#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/raster_case.hpp"

/// What the energy budget of a run holds, and what ends a run early.
namespace breccia::test::budget_test {
namespace {

using nlohmann::json;

constexpr double kResidual = 1e-3;  // of the largest term: the limit for every case of the repository

/// A call of `breccia run` and what it left.
struct FinishedRun {
  Outcome outcome;
  json summary;
  json status;                                         ///< last line of status.jsonl
  std::map<std::string, std::vector<double>> history;  ///< by column

  /// @param arguments  the case and settings
  explicit FinishedRun(const std::string& arguments) {
    const Scratch scratch;
    outcome = call("run " + arguments + " --progress none -o '" + scratch.path("run").string() + "'");
    summary = json::parse(read_text(scratch.path("run/summary.json")));
    EXPECT_EQ(energy_fault(scratch.path("run/history.csv")), "") << arguments;
    std::istringstream told(read_text(scratch.path("run/status.jsonl")));
    for (std::string line; std::getline(told, line);) status = json::parse(line);
    std::istringstream lines(read_text(scratch.path("run/history.csv")));
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      std::size_t column = 0;
      const bool header = names.empty();
      for (std::string cell; std::getline(cells, cell, ','); ++column) {
        if (header) names.push_back(cell);
        if (!header) history[names.at(column)].push_back(std::stod(cell));
      }
    }
  }

  /// Of the absolute values of a column; NaN where one is.
  [[nodiscard]] double largest(const std::string& column) const {
    double most = 0;
    for (const double value : history.at(column)) {
      if (std::isnan(value)) return value;
      most = std::max(most, std::abs(value));
    }
    return most;
  }
};

/// An elastic box, pulled to 2 ms and held where it is then.
const std::string kPulledThenHeld = raster_case({.title = "pulled, then held",
                                                 .group = "box",
                                                 .cells = {2, 1, 1},
                                                 .young = 4e6,
                                                 .poisson = 0.3,
                                                 .density = 2340,
                                                 .end = 2e-3}) +
                                    R"(name = "pull"
[[stage.constraint]]
group = "box.x0"
fixed = "xyz"
[[stage.constraint]]
group = "box.x1"
displacement = { x = { ramp = { to = "1 mm", end = "2 ms" } } }
[[stage.pressure]]
surface = "box.z1"
value = { ramp = { to = "20 kPa", end = "2 ms" } }
[[stage]]
name = "hold"
end = "4 ms"
[[stage.constraint]]
group = "box.x0"
fixed = "xyz"
[[stage.constraint]]
group = "box.x1"
fixed = "xyz"
[[stage.pressure]]
surface = "box.z1"
value = "20 kPa"
[time]
safety = 0.2
[output]
history_interval = "50 us"
)";

TEST(Budget, WhoseResidualPassesTheLimitStopsTheRunWithCode3) {
  const Scratch scratch;
  constexpr double kTiny = 1e-12;  // no run is that exact
  const FinishedRun run(scratch.write("case.toml", kSmallCase) + " --set time.residual_limit=1e-12");
  EXPECT_EQ(run.outcome.exit_code, 3);
  for (const char* words : {"the energy residual is", "(limit 1e-10 %)", "time.residual_limit"}) {
    EXPECT_NE(run.outcome.err.find(words), std::string::npos) << words << " in\n" << run.outcome.err;
  }
  EXPECT_NE(run.summary.at("status").get<std::string>().find("the energy residual is"), std::string::npos);
  EXPECT_LT(run.summary.at("simulated_time").get<double>(), 4e-3);
  // Only the last line passes the limit: the run has ended at the first that does.
  const std::vector<double>& residual = run.history.at("relative residual");
  ASSERT_FALSE(residual.empty());
  EXPECT_GT(residual.back(), kTiny);
  EXPECT_LE(*std::max_element(residual.begin(), residual.end() - 1), kTiny);
}

TEST(Budget, IsSampledAtTheEndOfARunToo) {
  // Fifteen steps of 1.6 times the stable length, far fewer than lie between two lines of the history.
  const Scratch scratch;
  const FinishedRun run(scratch.write("case.toml", kSmallCase) +
                        " --set time.step=3e-5 --set time.max_steps=15 --set output.history_interval=1");
  EXPECT_EQ(run.outcome.exit_code, 3) << run.outcome.err;
  EXPECT_EQ(run.summary.at("steps"), 15);
  EXPECT_EQ(run.history.at("step").size(), 1U);
  EXPECT_NE(run.outcome.err.find("; lower time.safety, or raise time."), std::string::npos) << run.outcome.err;
}

TEST(Budget, HoldsTheWorkOfConstraintsAndPressuresOfEarlierStages) {
  const Scratch scratch;
  const FinishedRun run(scratch.write("case.toml", kPulledThenHeld));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_LT(run.largest("relative residual"), kResidual);
  const std::vector<double>&time = run.history.at("time [s]"), &work = run.history.at("external work [J]");
  double pulled = 0;
  for (std::size_t line = 0; line < time.size() && time[line] < 2e-3; ++line) pulled = work[line];
  constexpr double kOfTheBox = 1e-3;  // J: E A (1 mm)^2 / (2 x 20 mm) = 1e-2 J, less what the free sides give
  EXPECT_GT(pulled, kOfTheBox);
  EXPECT_GT(work.back(), 0.5 * pulled) << "held, not taken back";
}

TEST(Budget, HoldsWhatAStageBeginsWithOnABodyAtRestWhoseStepChangesThere) {
  // Steps of 10/4 and 40/15 us: in the first one of the push nothing else has moved yet.
  const std::string text =
      raster_case(
          {.title = "rests, then pushed or dragged", .group = "box", .cells = {3, 1, 1}, .poisson = 0, .end = 10e-6}) +
      R"(name = "rest"
[[stage]]
name = "load"
end = "50 us"
LOAD
[time]
step = "2.7 us"
[output]
history_interval = "10 us"
)";
  for (const char* load : {"[[stage.pressure]]\nsurface = \"box.x1\"\nvalue = \"10 kPa\"",
                           "[[stage.constraint]]\ngroup = \"box.x1\"\nvelocity = { x = \"10 mm/s\" }"}) {
    const Scratch scratch;
    std::string with_load = text;
    with_load.replace(with_load.find("LOAD"), 4, load);
    const FinishedRun run(scratch.write("case.toml", with_load));
    ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_LT(run.largest("relative residual"), kResidual) << load;
    EXPECT_GT(run.history.at("external work [J]").back(), 0);
    const std::vector<double>& step = run.history.at("time step [s]");
    EXPECT_GT(*std::max_element(step.begin(), step.end()), 1.05 * step.front()) << "the step changes";
  }
}

TEST(Budget, HoldsWhatTheSpringsOfFrictionStore) {
  // The right tetrahedron is pressed in by 0.5 mm and, from 2 ms on, moved along the face; friction makes it stick.
  const std::string motion =
      "x = { table = [[0, 0], [\"2 ms\", \"-0.6 mm\"]] }, "
      "y = { table = [[\"2 ms\", 0], [\"4 ms\", \"0.2 mm\"]] }, z = 0";
  const FinishedRun run("'" BRECCIA_MESHES
                        "/contact_pair/case.toml' --set 'contact[0].friction=100' "
                        "--set 'stage[0].constraint[1].displacement={ " +
                        motion + " }'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_LT(run.largest("relative residual"), kResidual);
  const std::vector<double>&time = run.history.at("time [s]"), &stored = run.history.at("contact stored [J]");
  double pressed = 0;
  for (std::size_t line = 0; line < time.size() && time[line] < 2e-3; ++line) pressed = stored[line];
  // As stiff along the face as across: (0.2 mm / 0.5 mm)^2 of what pressing has stored.
  constexpr double kShare = 0.16, kSampling = 0.01;
  EXPECT_NEAR(stored.back() / pressed, 1 + kShare, kSampling);
}

TEST(Budget, HoldsAllThatDampingTakesWhereEveryStepIsSampled) {
  const Scratch scratch;
  const FinishedRun run(
      scratch.write("case.toml", kSmallCase) +
      " --set stage.fly.mass_damping=1000 --set output.history_interval=1e-7 --set stage.fly.end=1e-4");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const std::vector<double>&damped = run.history.at("damping [J]"), &kinetic = run.history.at("kinetic [J]");
  constexpr double kLost = 0.1;  // at least, of the energy: 1 - exp(-0.2) where nothing drives
  EXPECT_GT(damped.back(), kLost * kinetic.front());
  EXPECT_LT(run.largest("relative residual"), kResidual);
}

/// A beam clamped at both ends, with stiff joints, so that most vibrations are near the limit of the stable step.
const std::string kHeavyBeam = raster_case({.group = "beam",
                                            .cells = {20, 1, 1},
                                            .cell_size = 0.2,
                                            .young = 30e9,
                                            .density = 2400,
                                            .penalty_factor = 100,
                                            .end = 0.1}) +
                               R"(gravity = [0, { ramp = { to = -9.81, end = "50 ms" } }, 0]
local_damping = 0.4
[[stage.constraint]]
group = "beam.x0"
fixed = "xyz"
[[stage.constraint]]
group = "beam.x1"
fixed = "xyz"
[output]
gauges = ["beam.x0", "beam.x1"]
history_interval = "1 ms"
frame_interval = 0
)";

TEST(LocalDamping, BringsAHeavyBeamToRestOnItsSupportsWithTheDefaultStep) {
  constexpr double kWeight = 20 * 0.2 * 0.2 * 0.2 * 2400 * 9.81;
  const Scratch scratch;
  const FinishedRun run(scratch.write("beam.toml", kHeavyBeam));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_LT(run.largest("relative residual"), kResidual);
  const double left = run.history.at("beam.x0 reaction y [N]").back();
  const double right = run.history.at("beam.x1 reaction y [N]").back();
  constexpr double kStillSwings = 0.02;
  EXPECT_NEAR((left + right) / kWeight, 1.0, kStillSwings);
}

TEST(NotFinite, NamesTheElementWhereItBeganAndLeavesNumbersThatCanBeShown) {
  const Scratch scratch;
  std::string alone = kSmallCase;  // with contact the run would end earlier: nodes move too far in a step
  alone.erase(alone.find("[[contact]]"), alone.find("[[initial_velocity]]") - alone.find("[[contact]]"));
  alone.erase(alone.find("[sphere]"), alone.find("[[stage]]") - alone.find("[sphere]"));
  const FinishedRun run(scratch.write("case.toml", alone) +
                        " --set time.step=1e-4 --set output.history_interval=1 --set output.frame_interval=0");
  EXPECT_EQ(run.outcome.exit_code, 3);
  EXPECT_NE(run.outcome.err.find("a velocity is not finite in element "), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("lower time.safety (or time.step)"), std::string::npos) << run.outcome.err;
  EXPECT_GT(run.summary.at("steps"), 1);
}

TEST(MaxSteps, IsTheNumberOfStepsAfterWhichARunStops) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  for (const int steps : {1, 7}) {
    const FinishedRun run(file + " --set time.max_steps=" + std::to_string(steps));
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.summary.at("steps"), steps);
    EXPECT_EQ(run.summary.at("status"), "stopped: time.max_steps reached");
    EXPECT_EQ(run.status.at("steps_total"), steps) << "what is told to be still to go";
    EXPECT_EQ(run.status.at("share"), 1);
  }
}

TEST(History, EndsWithTheLastStepOfARunWhateverItsInterval) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  for (const std::string end : {"", " --set time.max_steps=7"}) {
    const FinishedRun run(file + " --set output.history_interval=1" + end);
    ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    // A line is of the beginning of its step.
    EXPECT_EQ(run.history.at("step"), std::vector<double>({0, run.summary.at("steps").get<double>() - 1})) << end;
  }
}

TEST(MaxSteps, GivesTheLastLineAlsoWhereTheModelWouldBeDividedAnewThen) {
  const Scratch scratch;
  const std::string settings = scratch.write("case.toml", kSmallCase) +
                               " --progress none --set domains.margin=0.1 --set output.history_interval=1"
                               " --set time.residual_limit=1e9 --set time.energy_gain_limit=1e9"
                               " --set 'initial_velocity[0].random=[\"40 m/s\", \"40.5 m/s\"]' --set time.max_steps=";
  for (const int steps : {25, 26, 27}) {
    const std::string arguments = "run " + settings + std::to_string(steps) + " -o '";
    ASSERT_EQ(call(arguments + scratch.path("one").string() + "' -f").exit_code, 0);
    const Outcome two = call_ranks(2, arguments + scratch.path("two").string() + "' -f");
    ASSERT_EQ(two.exit_code, 0) << steps << " steps: " << two.err;
    EXPECT_EQ(history_without_couples(scratch.path("two/history.csv")),
              history_without_couples(scratch.path("one/history.csv")))
        << steps;
  }
}

TEST(Budget, HoldsWhatChangesOfTheStepMoveWhereABlockReboundsAndVibrates) {
  const Scratch scratch;
  scratch.write("blocks.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-0.005, -0.004, 0, 0.010, 0.004};
Rectangle(2) = {-0.001, 10e-6, 0, 0.002, 0.002};
Extrude {0, 0, 0.001} { Surface{1:2}; Layers{1}; }
Physical Volume("block") = {1};
Physical Volume("striker") = {2};
Physical Surface("base") = Surface In BoundingBox {-1, -0.004-1e-6, -1, 1, -0.004+1e-6, 1};
MeshSize{:} = 0.001;
Mesh.Algorithm = 5;
)");
  const auto material = [](const std::string& group) {
    return "[[material]]\ngroup = \"" + group + "\"\nyoung = \"70 GPa\"\npoisson = 0.3\ndensity = 2700\n" +
           "joints = \"none\"\n";
  };
  const FinishedRun run(scratch.write(
      "strike.toml",
      "[mesh]\nfile = \"blocks.geo\"\n" + material("block") + material("striker") +
          "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"70 GPa\"\n[[initial_velocity]]\ngroup = \"striker\"\n"
          "velocity = [0, \"-20 m/s\", 0]\n[[stage]]\nend = \"150 us\"\n[[stage.constraint]]\ngroup = \"base\"\n"
          "fixed = \"xyz\"\n[output]\nhistory_interval = \"0.2 us\"\nframe_interval = 0\n"));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  // While they touch it is more: what the steps leave in which that begins, the last ones put right.
  EXPECT_LT(run.history.at("relative residual").back(), kResidual);
  EXPECT_GT(run.largest("step change [J]"), kResidual * run.largest("kinetic [J]")) << "unaccounted it would stop runs";
  EXPECT_EQ(run.largest("contact dissipated [J]"), 0);
}

/// Two boxes that meet and fly apart: contact makes the step some thirty times shorter than it is without.
std::string rebound_case() {
  return raster_case({.group = "b",
                      .cell_size = 0.02,
                      .boxes = {2, 1, 1},
                      .gap = 0.2e-3,
                      .young = 26.6e6,
                      .density = 2340,
                      .contact_penalty = 2.66e9,
                      .contact_friction = 0.3,
                      .end = 40e-3}) +
         "[[initial_velocity]]\ngroup = \"b\"\nrandom = [3, 6]\nseed = 1\nangular = [3, 20, -40]\n"
         "[output]\nhistory_interval = 1e-5\n";
}

TEST(TimeStep, GrowsByHalfAtMostAfterAReboundSoThatTheRunGoesOn) {
  const Scratch scratch;
  const FinishedRun run(scratch.write("rebound.toml", rebound_case()));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  double before = 0, growth = 0, longest = 0;
  const std::vector<double>& steps = run.history.at("time step [s]");
  for (const double step : steps) {
    if (before > 0) growth = std::max(growth, step / before);
    before = step;
    longest = std::max(longest, step);
  }
  EXPECT_GT(growth, 1.2);
  EXPECT_LE(growth, 1.5 * (1 + 1e-9));
  EXPECT_GT(longest, 10 * *std::min_element(steps.begin(), steps.end()));
}

}  // namespace
}  // namespace breccia::test::budget_test
