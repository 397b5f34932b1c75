#include <gtest/gtest.h>

#include <algorithm>

#include "end_to_end/program.hpp"

/// What the pipeline `history` records of a run.
namespace breccia::test::insitu_history_test {
namespace {

namespace fs = std::filesystem;

class InSituHistory : public testing::TestWithParam<int> {};

TEST_P(InSituHistory, HasTheRowsOfItsOwnSteps) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const auto run_in = [&](const std::string& name, int ranks, const std::string& arguments) {
    const std::string line = "run " + file + " --progress none -o '" + scratch.path(name).string() + "' " + arguments;
    const Outcome outcome = ranks > 1 ? call_ranks(ranks, line) : call(line);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return scratch.path(name);
  };
  const fs::path plain = run_in("plain", 1, "");
  const fs::path run =
      run_in("run", GetParam(), "--set 'insitu.pipeline=[{name=\"history\", every_steps=30, strict=true}]'");
  const fs::path rows = run / "extracts/history/history.csv", lines = run / "history.csv";
  const std::vector<double> steps = history_column(rows, "step"), energy = history_column(rows, "kinetic [J]");
  std::vector<double> due = history_column(run / "extracts.csv", "step");
  ASSERT_EQ(steps.size(), due.size());
  due.back() -= 1;  // the last state has no step behind it that finds its row
  EXPECT_EQ(steps, due);
  const std::vector<double> known = history_column(lines, "step"), known_energy = history_column(lines, "kinetic [J]");
  std::size_t shared = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto line = std::find(known.begin(), known.end(), steps[i]);
    if (line == known.end()) continue;
    ++shared;
    EXPECT_EQ(energy[i], known_energy[static_cast<std::size_t>(line - known.begin())]) << "step " << steps[i];
  }
  EXPECT_GT(shared, 2U);
  EXPECT_EQ(known, history_column(plain / "history.csv", "step")) << "the run's own history stays";
  EXPECT_EQ(known_energy, history_column(plain / "history.csv", "kinetic [J]"));
}

INSTANTIATE_TEST_SUITE_P(OfRanks, InSituHistory, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace breccia::test::insitu_history_test
