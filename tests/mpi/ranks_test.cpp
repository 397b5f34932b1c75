#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"
#include "mpi/same_bits.hpp"

/// The shipped program on several ranks against the same program on one.
namespace breccia::ranks_test {
namespace {

using test::Outcome;
using test::SameBits;
using test::Scratch;

std::string mesh_case(const std::string& name) { return "'" BRECCIA_MESHES "/" + name + "'"; }

TEST(Ranks, GiveTheSameBitsWhileBoxesBreakRubAndAreHeld) {
  const Scratch scratch;
  SameBits boxes(scratch.write("case.toml", test::kSmallCase));
  EXPECT_GT(boxes.alone().at("broken_joints"), 0);
  for (const int ranks : {2, 3, 8}) boxes.on(ranks);
  boxes.on(4, "--set domains.kind=grid");
  boxes.on(2, "--set domains.kind=grid --set domains.n=[1,2,1] --set domains.rebalance=false");
}

TEST(Ranks, GiveTheSameBitsWhenTheModelIsDividedAgainAndAgain) {
  const Scratch scratch;
  SameBits boxes(scratch.write("case.toml", test::changed("end = \"4 ms\"", "end = \"6 ms\"")));
  EXPECT_GT(boxes.on(2, "--set domains.margin=0.1").at("decompositions"), 5);
  EXPECT_GT(boxes.on(3, "--set domains.margin=0.1").at("decompositions"), 5);
  EXPECT_GT(boxes.on(4, "--set domains.margin=0.1 --set detection.algorithm=ms").at("decompositions"), 5);
  EXPECT_GT(boxes.on(3, "--set domains.margin=0.1 --set detection.verify=true").at("decompositions"), 5);
}

TEST(Ranks, GiveTheSameBitsWhereStrengthsScatter) {
  const Scratch scratch;
  const std::string law = "penalty_factor = 10";
  SameBits boxes(scratch.write(
      "case.toml", test::changed(law, law + "\nweibull_modulus = 4\nweibull_area = \"1 cm2\"\nweibull_seed = 3")));
  EXPECT_GT(boxes.alone().at("broken_joints"), 0);
  EXPECT_NE(boxes.alone().at("state_hash"),
            SameBits(scratch.write("even.toml", test::kSmallCase)).alone().at("state_hash"));
  for (const int ranks : {2, 3}) boxes.on(ranks);
  boxes.on(2, "--set domains.margin=0.1");
}

TEST(Ranks, GiveTheSameBitsWhile64BoxesShatterInASphere) {
  SameBits boxes(mesh_case("bouncing_cubes/case_breaking.toml"));
  EXPECT_GT(boxes.alone().at("broken_joints"), 100);
  EXPECT_GT(boxes.alone().at("steps"), 2000);
  boxes.on(2);
  boxes.on(3, "--set domains.kind=grid --set domains.rebalance=false");
}

/// 50 times the speed of waves in the boxes: further in a step than contact can be found for.
TEST(Ranks, EndWithTheSameErrorWhenNodesMoveTooFarInAStep) {
  const Scratch scratch;
  const std::string boxes = scratch.write("case.toml", test::changed("[\"1 m/s\", \"2 m/s\"]", "[2000, 2400]"));
  std::string message;
  for (const int ranks : {1, 2, 3}) {
    const std::string folder = scratch.path("run" + std::to_string(ranks)).string();
    const Outcome outcome = test::call_ranks(ranks, "run --progress none -o '" + folder + "' " + boxes);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    const auto summary = nlohmann::json::parse(test::read_text(folder + "/summary.json"));
    const std::string status = std::to_string(summary.at("steps").get<int>()) + ": " + std::string(summary["status"]);
    if (ranks == 1) message = status;
    EXPECT_EQ(status, message) << ranks << " ranks";
  }
  for (const char* part : {"of element", "m/s", "would be missed", "lower time.safety"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

/// Frames of the small case: at 0, 1, 2, 3 and 4 ms.
TEST(Ranks, KnowWhenTheirJointsFailed) {
  const Scratch scratch;
  SameBits boxes(scratch.write("case.toml", test::kSmallCase));
  std::set<double> times, states;
  for (const auto& [joint, failure] : boxes.failures()) {
    const auto& [time, state] = failure;
    const double frame = 1e-3 * std::stoi(joint.first.substr(std::string("joints_").size()));  // s
    EXPECT_LE(time, frame) << joint.first;
    EXPECT_EQ(time >= 0, state >= 2) << joint.first;
    if (time >= 0) times.insert(time);
    states.insert(state);
  }
  EXPECT_GT(times.size(), 5);
  EXPECT_GE(states.size(), 2);
}

TEST(Ranks, GiveTheSameBitsWhileGlassShatters) {
  SameBits glass(mesh_case("glass_impact/case_smoke.toml"));
  EXPECT_GT(glass.alone().at("broken_joints"), 0);
  glass.on(2);
  glass.on(4, "--set domains.kind=grid");
}

TEST(Ranks, GiveTheSameBitsWhileASlitOpensAndABlockFalls) {
  SameBits plate(mesh_case("slit_plate/case_smoke.toml"));
  plate.on(2);
  plate.on(3);
  SameBits block(mesh_case("block_drop/case_smoke.toml"));
  block.on(2);
  block.on(4, "--set domains.kind=grid");
}

TEST(Ranks, GiveTheSameBitsForElementsThatShareNodesUnderGravityAndDamping) {
  SameBits bar(mesh_case("cantilever/case_smoke.toml"));
  bar.on(2);
  bar.on(3);
}

/// The small case for 6 ms, in which it is divided again and again, with one thing changed.
std::string longer(const std::string& from, const std::string& to) {
  std::string text = test::changed("end = \"4 ms\"", "end = \"6 ms\"");
  return text.replace(text.find(from), from.size(), to);
}

/// Compares one rank with 2 and 3, which divide the model anew on the way. Returns the summary of the one.
nlohmann::json same_bits_of_migrants(const std::string& text) {
  const Scratch scratch;
  SameBits boxes(scratch.write("case.toml", text));
  for (const int ranks : {2, 3}) EXPECT_GT(boxes.on(ranks, "--set domains.margin=0.1").at("decompositions"), 2);
  return boxes.alone();
}

constexpr double kDampedResidual = 5e-3;  // of the largest term, at usual steps; a term that is left out is far larger

TEST(Ranks, GiveTheSameBitsWithLocalDamping) {
  const nlohmann::json summary = same_bits_of_migrants(longer("name = \"fly\"", "name = \"fly\"\nlocal_damping = 0.3"));
  EXPECT_LT(summary.at("energy_residual_relative"), kDampedResidual);
  EXPECT_GT(summary.at("energy").at("damping"), 0.1 * summary.at("energy").at("kinetic").get<double>());
}

TEST(Ranks, GiveTheSameBitsWithViscosity) {
  for (const char* joints : {"breakable", "none"}) {
    std::string text = longer("poisson = 0.3", "poisson = 0.3\nviscosity = \"200 Pa s\"");
    const std::string breakable = "\"breakable\"";
    text.replace(text.find(breakable), breakable.size(), std::string("\"") + joints + "\"");
    if (std::string(joints) == "none") {
      const std::size_t first = text.find("[[joint]]");
      text.erase(first, text.find("[[contact]]") - first);
    }
    const nlohmann::json summary = same_bits_of_migrants(text);
    EXPECT_LT(summary.at("energy_residual_relative"), kDampedResidual) << joints;
    EXPECT_GT(summary.at("energy").at("viscous"), 0.01 * summary.at("energy").at("kinetic").get<double>()) << joints;
  }
}

TEST(Ranks, GiveTheSameBitsWithTheLawOfGreenAndStVenant) {
  const nlohmann::json summary =
      same_bits_of_migrants(longer("poisson = 0.3", "poisson = 0.3\nlaw = \"green_st_venant\""));
  const Scratch scratch;
  const SameBits default_law(scratch.write("case.toml", test::changed("end = \"4 ms\"", "end = \"6 ms\"")));
  EXPECT_NE(summary.at("state_hash"), default_law.alone().at("state_hash")) << "the law has done nothing";
}

TEST(Ranks, GiveTheSameBitsWithPlasticFlowOnAnyInstructionSet) {
  for (const char* joints : {"breakable", "none"}) {
    std::string text = longer("poisson = 0.3", std::string("poisson = 0.3\nlaw = \"drucker_prager\"\n") +
                                                   "friction_angle = \"30 deg\"\ndilation_angle = \"10 deg\"\n" +
                                                   "cohesion = \"20 kPa\"\nhardening = \"100 kPa\"\n" +
                                                   "cap_pressure = \"60 kPa\"\ncap_hardening = \"200 kPa\"");
    const std::string breakable = "\"breakable\"";
    text.replace(text.find(breakable), breakable.size(), std::string("\"") + joints + "\"");
    if (std::string(joints) == "none") {
      const std::size_t first = text.find("[[joint]]");
      text.erase(first, text.find("[[contact]]") - first);
    }
    const std::string output = "[output]";  // at half the usual step: joints and contacts alone miss more at that
    text.replace(text.find(output), output.size(), "[time]\nsafety = 0.4\n[output]");
    const nlohmann::json summary = same_bits_of_migrants(text);
    EXPECT_LT(summary.at("energy_residual_relative"), kDampedResidual) << joints;
    EXPECT_GT(summary.at("energy").at("plastic"), 0.01 * summary.at("energy").at("kinetic").get<double>()) << joints;
    const Scratch scratch;
    for (const std::string simd : {"sse2", "avx2", "avx512"}) {
      const std::string folder = scratch.path(simd).string(), file = scratch.write("case.toml", text);
      ASSERT_EQ(test::call("run --progress none -o '" + folder + "' " + file, "BRECCIA_SIMD=" + simd).exit_code, 0);
      const nlohmann::json run = nlohmann::json::parse(test::read_text(scratch.path(simd) / "summary.json"));
      EXPECT_EQ(run.at("state_hash"), summary.at("state_hash")) << simd << " " << joints;
    }
  }
}

TEST(Ranks, KeepTheWorkOfConstraintsWhenElementsMoveFromRankToRankAndStagesEnd) {
  std::string text = longer("velocity = { z = 0 }", "velocity = { z = \"0.5 m/s\" }");
  const std::string output = "[output]";
  text.replace(text.find(output), output.size(), R"([[stage]]
name = "let go"
end = "8 ms"
[output])");
  const nlohmann::json summary = same_bits_of_migrants(text);
  const nlohmann::json& energy = summary.at("energy");
  EXPECT_GT(std::abs(energy.at("external_work").get<double>()), 0.005 * energy.at("kinetic").get<double>());
}

/// With this seed it is an element of the second box, which is not the root's.
TEST(Ranks, NameTheSameElementWhenTheResidualPassesItsLimit) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::changed("seed = 3", "seed = 5"));
  std::set<std::string> messages;
  for (const int ranks : {1, 2, 3}) {
    const std::string folder = scratch.path("out" + std::to_string(ranks)).string();
    const Outcome outcome =
        test::call_ranks(ranks, "run --progress none -o '" + folder + "' " + file + " --set time.residual_limit=1e-9");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    const std::size_t first = outcome.err.find("breccia: error: step ");
    ASSERT_NE(first, std::string::npos) << outcome.err;
    messages.insert(outcome.err.substr(first, outcome.err.find('\n', first) - first));
    const std::string before = "densest in element ";
    const std::size_t element = outcome.err.find(before, first);
    ASSERT_NE(element, std::string::npos) << outcome.err;
    constexpr int kElementsABox = 4 * 24;
    EXPECT_GE(std::stoi(outcome.err.substr(element + before.size())), kElementsABox) << "the test shows nothing";
  }
  EXPECT_EQ(messages.size(), 1u) << *messages.begin() << "\n" << *messages.rbegin();
}

TEST(Ranks, WarnOnceOfAStepThatIsTooLong) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::kSmallCase);
  const std::string run = "run --progress none -o '" + scratch.path("out").string() + "' -f " + file +
                          " --set time.max_steps=1 --set time.step=";
  for (const int ranks : {1, 2, 3}) {
    const Outcome outcome = test::call_ranks(ranks, run + "1e-3");
    EXPECT_EQ(outcome.exit_code, 0);
    const std::size_t first = outcome.err.find("the run will blow up");
    ASSERT_NE(first, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("the run will blow up", first + 1), std::string::npos) << outcome.err;
    EXPECT_EQ(test::call_ranks(ranks, run + "1e-9").err.find("time.step"), std::string::npos);
  }
}

TEST(Ranks, TellAWrongCaseOnce) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::changed("2340 kg/m3", "-1 kg/m3"));
  const Outcome outcome = test::call_ranks(4, "run -o '" + scratch.path("out").string() + "' " + file);
  EXPECT_EQ(outcome.exit_code, 2);
  const std::size_t first = outcome.err.find("material[0].density");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("material[0].density", first + 1), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("ending after the present step"), std::string::npos) << outcome.err;
}

TEST(Ranks, RefuseADivisionThatCannotBe) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::kSmallCase);
  const std::string run =
      "run -o '" + scratch.path("out").string() + "' " + file + " --set domains.kind=grid --set domains.n=";
  const Outcome product = test::call_ranks(4, run + "[3,1,1]");
  EXPECT_EQ(product.exit_code, 2);
  EXPECT_NE(product.err.find("[2, 2, 1]"), std::string::npos) << product.err;
  const Outcome thin = test::call_ranks(8, run + "[1,1,8]");
  EXPECT_EQ(thin.exit_code, 2);
  EXPECT_NE(thin.err.find("smaller than the largest element"), std::string::npos) << thin.err;
}

TEST(Ranks, EndTogetherWhenTheNumbersGoWrongOnOne) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::kSmallCase);
  const Outcome outcome = test::call_ranks(
      2, "run --progress none -o '" + scratch.path("out").string() + "' " + file + " --set time.step=1e-4");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const std::size_t first = outcome.err.find("breccia: error: step ");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("breccia: error:", first + 1), std::string::npos) << outcome.err;
}

/// Processes whose parent is this one.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string stat = test::read_text(entry.path() / "stat");
    const std::size_t after_name = stat.rfind(')');
    if (after_name == std::string::npos) continue;
    std::istringstream fields(stat.substr(after_name + 1));
    std::string state;
    pid_t of = 0;
    fields >> state >> of;
    if (of == parent) children.push_back(std::stoi(name));
  }
  return children;
}

/// Waits at most so long for something to become true.
template <class Condition>
bool within(std::chrono::seconds limit, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

TEST(Ranks, DieTogetherWhenOneIsKilledAndLeaveCompleteFrames) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::changed("end = \"4 ms\"", "end = \"4 s\""));
  const pid_t launcher = test::start_ranks(2, "run --progress none -o '" + scratch.path("out").string() + "' " + file);
  const auto series = scratch.path("out") / "frames" / "elements.hdf.series";
  ASSERT_TRUE(within(std::chrono::seconds(60),
                     [&] { return std::filesystem::exists(series) && children_of(launcher).size() >= 2; }));
  ASSERT_EQ(kill(children_of(launcher).back(), SIGKILL), 0);
  int status = 0;
  const bool ended = within(std::chrono::seconds(20), [&] { return waitpid(launcher, &status, WNOHANG) == launcher; });
  if (!ended) kill(launcher, SIGKILL);
  ASSERT_TRUE(ended);
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  const auto index = nlohmann::json::parse(test::read_text(series));
  ASSERT_FALSE(index.at("files").empty());
  for (const auto& frame : index.at("files")) {
    EXPECT_TRUE(std::filesystem::exists(series.parent_path() / frame.at("name").get<std::string>()));
  }
}

TEST(Ranks, EndTogetherWhenOneCannotWriteItsPieceOfAFrame) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", test::changed("end = \"4 ms\"", "end = \"4 s\""));
  const pid_t launcher = test::start_ranks(3, "run --progress none -o '" + scratch.path("out").string() + "' " + file);
  const auto series = scratch.path("out") / "frames" / "elements.hdf.series";
  ASSERT_TRUE(within(std::chrono::seconds(60),
                     [&] { return std::filesystem::exists(series) && children_of(launcher).size() >= 3; }));
  const rlimit nothing{0, 0};
  ASSERT_EQ(prlimit(children_of(launcher)[1], RLIMIT_FSIZE, &nothing, nullptr), 0);
  int status = 0;
  const bool ended = within(std::chrono::seconds(60), [&] { return waitpid(launcher, &status, WNOHANG) == launcher; });
  if (!ended) kill(launcher, SIGKILL);
  ASSERT_TRUE(ended);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const auto list = nlohmann::json::parse(test::read_text(series));
  EXPECT_FALSE(list.at("files").empty());
  for (const auto& frame : list.at("files")) {
    EXPECT_TRUE(std::filesystem::exists(series.parent_path() / frame.at("name").get<std::string>()));
  }
}

}  // namespace
}  // namespace breccia::ranks_test
