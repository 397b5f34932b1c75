#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "end_to_end/program.hpp"
#include "support/raster_case.hpp"

/// Runs that end with numbers that went wrong: what stands from before, and how to go on from there.
namespace breccia::test::fault_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The small case for 2 ms, then with a wall that is driven through the boxes.
std::string driven(const std::string& velocity) {
  const std::string begin = changed("end = \"4 ms\"", "end = \"2 ms\"");
  const std::string output = "[output]";
  std::string text = begin;
  return text.replace(text.find(output), output.size(),
                      "[[stage]]\nname = \"drive\"\nend = \"4 ms\"\n[[stage.constraint]]\ngroup = \"box.x0\"\n"
                      "velocity = { x = \"" +
                          velocity + "\" }\n[output]");
}

class Fault : public testing::TestWithParam<int> {
 protected:
  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }
  [[nodiscard]] Outcome run(const std::string& name, const std::string& text, const std::string& settings = "") const {
    const std::string file = scratch_.write(name + ".toml", text);
    return call_ranks(GetParam(), "run " + file + " --progress none -o " + quoted(name) + " " + settings);
  }

  Scratch scratch_;
};

TEST_P(Fault, NamesTheLastSoundCheckpointFromWhichACaseWithoutItsCauseGoesOn) {
  const Outcome failed = run("failed", driven("1e6 m/s"), "--set checkpoint.steps=20 --set checkpoint.keep=1");
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  std::smatch named;
  static const std::regex kNamed(
      R"(sound before that: (\S+/step_0*(\d+)\.h5), frame (\d+); a case with \[start\] from = )"
      R"re("(\S+)", step = (\d+) continues from there with other settings)re");
  ASSERT_TRUE(std::regex_search(failed.err, named, kNamed)) << failed.err;
  EXPECT_TRUE(fs::exists(named[1].str()));
  EXPECT_EQ(named[2], named[5]);
  EXPECT_TRUE(fs::exists(folder("failed") / ("frames/elements_00000" + named[3].str() + ".vtkhdf")));
  const std::vector<double> lines = history_column(folder("failed") / "history.csv", "step");
  EXPECT_LE(std::stod(named[5]), lines.back() + 1);
  EXPECT_NE(json::parse(read_text(folder("failed") / "summary.json")).at("status").get<std::string>().find(named[1]),
            std::string::npos);
  std::string text = kSmallCase;
  text.insert(text.find("[mesh.raster]"),
              "[start]\nfrom = \"" + named[4].str() + "\"\nstep = " + named[5].str() + "\n");
  const Outcome mended = run("mended", text);
  EXPECT_EQ(mended.exit_code, 0) << mended.err;
  EXPECT_EQ(json::parse(read_text(folder("mended") / "summary.json")).at("status"), "complete");
}

TEST_P(Fault, SaysThatThereIsNoCheckpointFromBeforeIt) {
  const Outcome failed = run("failed", driven("1e6 m/s"), "--set checkpoint.keep=0");
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_NE(failed.err.find("sound before that: frame "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("no checkpoint (set checkpoint.steps or checkpoint.interval)"), std::string::npos)
      << failed.err;
}

/// A bar of soft elements that share nodes, drawn out until they are thirty times as long.
const std::string kDrawnOut =
    raster_case({.group = "bar", .cells = {3, 1, 1}, .young = 4e6, .poisson = 0.3, .density = 2340, .end = 0.2}) +
    R"([[stage.constraint]]
group = "bar.x0"
fixed = "xyz"
[[stage.constraint]]
group = "bar.x1"
velocity = { x = { ramp = { start = 0, end = "20 ms", to = "5 m/s" } } }
)";

TEST_P(Fault, WarnsOnceOfATimeStepThatFallsToATenth) {
  const Outcome drawn = run("drawn", kDrawnOut);
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  const std::string words = "the stable step has fallen to ";
  const std::size_t first = drawn.err.find(words);
  ASSERT_NE(first, std::string::npos) << drawn.err;
  EXPECT_EQ(drawn.err.find(words, first + 1), std::string::npos) << drawn.err;
  static const std::regex kSaid(R"(step \d+, time \S+ s: the stable step has fallen to \S+ s, \S+ % of that of the )"
                                R"(model at rest, by element \d+; the rest would take \S+ steps; )");
  EXPECT_TRUE(std::regex_search(drawn.err, kSaid)) << drawn.err;
  EXPECT_NE(read_text(folder("drawn") / "status.jsonl").find(words), std::string::npos);
}

TEST_P(Fault, IsNotWhatBodiesFlyWithFromTheStart) {
  // Faster than waves: in the first step nodes move further than any may that were at rest before.
  const Outcome flown =
      run("flown", kSmallCase, "--set 'initial_velocity[0].random=[\"100 m/s\", \"120 m/s\"]' --set time.max_steps=4");
  EXPECT_EQ(flown.exit_code, 0) << flown.err;
}

TEST_P(Fault, InTheLastStepOfARunIsOneToo) {
  const Outcome failed = run("jumped", kSmallCase, "--set 'time.step=4 ms' --set 'sphere.radius=1 m'");
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_NE(failed.err.find("step 0: corner "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("contacts would be missed"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("no checkpoint"), std::string::npos) << "the last state is not sound: " << failed.err;
}

INSTANTIATE_TEST_SUITE_P(ranks, Fault, testing::Values(1, 2));

TEST(Diff, NamesInputsByTheirPlaceBesideTheCase) {
  const Scratch scratch;
  fs::create_directories(scratch.path("a/b"));
  scratch.write("a/case.toml", kSmallCase);
  const std::string from_here = "cd '" + scratch.path("a").string() + "' && ";
  const std::string from_above = "cd '" + scratch.path("").string() + "' && ";
  ASSERT_EQ(call("run case.toml --progress none -o b/one", from_here).exit_code, 0);
  ASSERT_EQ(call("run ./a/b/../case.toml --progress none -o a/b/two", from_above).exit_code, 0);
  const Outcome diff = call("diff a/b/one a/b/two", from_above);
  EXPECT_EQ(diff.exit_code, 0) << diff.err;
  EXPECT_NE(diff.out.find("inputs, versions, machine: the same"), std::string::npos) << diff.out;
}

}  // namespace
}  // namespace breccia::test::fault_test
