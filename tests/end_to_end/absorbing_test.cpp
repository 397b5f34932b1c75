#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"
#include "support/raster_case.hpp"

namespace breccia::absorbing_test {
namespace {

using test::call;
using test::history_column;
using test::Scratch;

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

nlohmann::json summary_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(test::read_text(folder / "summary.json"));
}

/// In the order in which they were written.
std::vector<std::filesystem::path> checkpoints(const std::filesystem::path& run) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(run / "checkpoints"))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

nlohmann::json run(const Scratch& scratch, const std::string& file, const std::string& folder,
                   const std::string& more = "") {
  const test::Outcome outcome =
      call("run --progress none -o " + quoted(scratch.path(folder)) + " " + file + " " + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(test::energy_fault(scratch.path(folder) / "history.csv"), "");
  return summary_of(scratch.path(folder));
}

/// A pulse runs along a bar of 0.2 m with c = 2,000 m/s.
const std::string kPulse = test::raster_case({.group = "bar",
                                              .cells = {40, 2, 2},
                                              .cell_size = 5e-3,
                                              .young = 10e9,
                                              .poisson = 0,
                                              .density = 2500,
                                              .end = 0.3e-3}) +
                           R"(absorbing = ["bar.x1"]
[[stage.pressure]]
surface = "bar.x0"
value = { table = [[0, 0], ["10 us", "1 MPa"], ["20 us", 0]] }
[output]
frame_interval = 0
)";

TEST(Absorbing, APulseLeavesABarThroughItsEnd) {
  const Scratch scratch;
  const std::string file = scratch.write("bar.toml", kPulse);
  const auto energy = run(scratch, file, "open").at("energy");
  const double work = energy.at("external_work");
  // A triangular pulse p of length T carries A p^2 T / (3 rho c).
  EXPECT_NEAR(work, 1e-4 * 1e12 * 20e-6 / (3 * 2500 * 2000), 0.02 * work);
  constexpr double kDispersed = 0.005;  // what the mesh makes of the pulse comes at wavelengths of few elements
  EXPECT_LT(energy.at("kinetic").get<double>() + energy.at("elastic").get<double>(), kDispersed * work);
  const auto closed = run(scratch, file, "closed", "--set 'stage[0].absorbing=[]'").at("energy");
  EXPECT_GT(closed.at("kinetic").get<double>() + closed.at("elastic").get<double>(), 0.99 * work);
}

/// A block settles on a foot that is held, and then rests on it without being held.
std::string block(const std::string& joints) {
  return test::raster_case({.group = "block",
                            .cells = {2, 2, 4},
                            .cell_size = 50e-3,
                            .young = 10e9,
                            .density = 2500,
                            .joints = joints,
                            .end = 0}) +
         (joints == "none" ? "" : "[[joint]]\ngroup = \"block\"\n") +
         "[output]\nframe_interval = 0\nhistory_interval = \"1 ms\"\ngauges = [\"block\"]\n";
}
const std::string kSettle = R"([[stage]]
name = "settle"
end = "10 ms"
gravity = [0, 0, -9.81]
local_damping = 0.3
[[stage.constraint]]
group = "block.z0"
fixed = "xyz"
)";
const std::string kRest = R"([[stage]]
name = "rest"
end = "20 ms"
gravity = [0, 0, -9.81]
absorbing = ["block.z0"]
)";

class Supported : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Joints, Supported, testing::Values("none", "unbreakable"));

/// What is missing of the force that held the block, as a share of its weight: its foot gives way with rho c_p A v.
double missing(const std::filesystem::path& folder) {
  constexpr double kImpedance = 2500 * 2108 * 0.1 * 0.1;     // N s/m
  constexpr double kWeight = 2500 * 0.1 * 0.1 * 0.2 * 9.81;  // N
  const auto time = history_column(folder / "history.csv", "time [s]");
  const auto velocity = history_column(folder / "history.csv", "block velocity z [m/s]");
  double most = 0;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] > 0.0125) most = std::max(most, std::abs(velocity[i]));
  return kImpedance * most / kWeight;
}

TEST_P(Supported, ABlockRestsOnWhereItWasHeld) {
  const Scratch scratch;
  const std::string file = scratch.write("whole.toml", block(GetParam()) + kSettle + kRest);
  constexpr double kUnsettled = 0.01;  // what the first stage has left
  const auto whole = run(scratch, file, "whole", "--set checkpoint.interval=15e-3 --set checkpoint.keep=9");
  EXPECT_LT(missing(scratch.path("whole")), kUnsettled);

  std::vector<std::filesystem::path> written = checkpoints(scratch.path("whole"));
  ASSERT_GE(written.size(), 3U);  // where the first stage ends, in the second one, and at its end
  written.pop_back();
  for (const auto& checkpoint : written) {
    const test::Outcome resumed = test::call_ranks(
        2, "resume --progress none " + quoted(checkpoint) + " -o " + quoted(scratch.path(checkpoint.stem())));
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(summary_of(scratch.path(checkpoint.stem())).at("state_hash"), whole.at("state_hash")) << checkpoint;
  }
  const test::Outcome divided = test::call_ranks(
      3, "run --progress none -o " + quoted(scratch.path("three")) + " " + file + " --set domains.margin=0.1");
  ASSERT_EQ(divided.exit_code, 0) << divided.err;
  EXPECT_EQ(summary_of(scratch.path("three")).at("state_hash"), whole.at("state_hash"));

  // A case of its own that starts from the first stage's end.
  run(scratch, scratch.write("settle.toml", block(GetParam()) + kSettle), "settled");
  const std::string model = block(GetParam());
  run(scratch,
      scratch.write("rest.toml", "[start]\nfrom = \"settled\"\n" + model.substr(model.find("[[material]]")) + kRest),
      "rest");
  EXPECT_LT(missing(scratch.path("rest")), kUnsettled);
}

TEST(Absorbing, StandsNotBesideDampingOfTheWaves) {
  const Scratch scratch;
  std::string text = kPulse;
  text.insert(text.find("absorbing"), "mass_damping = 5\n");
  const test::Outcome outcome = call("check " + scratch.write("bar.toml", text));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("stage[0].absorbing: stands beside mass_damping"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace breccia::absorbing_test
