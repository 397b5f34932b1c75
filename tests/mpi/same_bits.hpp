#pragma once

#include <gtest/gtest.h>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"
#include "unit/output/hdf5_reader.hpp"

namespace breccia::test {

/// By frame and joint: when it failed, state.
using Failures = std::map<std::pair<std::string, double>, std::pair<double, double>>;

inline Failures failures_in(const std::filesystem::path& frames) {
  Failures failures;
  for (const auto& file : std::filesystem::directory_iterator(frames)) {
    const std::string name = file.path().filename();
    if (name.find("joints_") != 0) continue;
    const Hdf5Reader joints(file.path());
    const std::vector<double> id = joints.values("CellData/id"), time = joints.values("CellData/time_of_failure"),
                              state = joints.values("CellData/state");
    for (std::size_t j = 0; j < id.size(); ++j) failures[{name, id[j]}] = {time.at(j), state.at(j)};
  }
  return failures;
}

/// What must not depend on the ranks.
struct Result {
  std::string hash, history;
  nlohmann::json summary;
  Failures failures;
};

inline Result result_of(const std::filesystem::path& folder) {
  const auto summary = nlohmann::json::parse(read_text(folder / "summary.json"));
  EXPECT_EQ(energy_fault(folder / "history.csv"), "");
  return {summary.at("state_hash"), history_without_couples(folder / "history.csv"), summary,
          failures_in(folder / "frames")};
}

/// Runs a case on 1 rank and in other ways, and compares.
class SameBits {
 public:
  explicit SameBits(std::string case_file) : case_file_(std::move(case_file)) {
    const Outcome one = call("run --progress none -o " + folder("one") + " " + case_file_);
    EXPECT_EQ(one.exit_code, 0) << one.err;
    one_ = result_of(scratch_.path("one"));
  }

  /// Returns the summary. @param settings  of the case
  nlohmann::json on(int ranks, const std::string& settings = "") {
    const std::string name = "run" + std::to_string(++number_);
    const Outcome outcome =
        call_ranks(ranks, "run --progress none -o " + folder(name) + " " + case_file_ + " " + settings);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (outcome.exit_code != 0) return {};
    const Result result = result_of(scratch_.path(name));
    EXPECT_EQ(result.hash, one_.hash) << ranks << " ranks " << settings;
    EXPECT_EQ(result.history, one_.history) << ranks << " ranks " << settings;
    EXPECT_EQ(result.failures, one_.failures) << ranks << " ranks " << settings;
    EXPECT_EQ(result.summary.at("ranks"), ranks);
    return result.summary;
  }
  [[nodiscard]] const nlohmann::json& alone() const { return one_.summary; }
  [[nodiscard]] const Failures& failures() const { return one_.failures; }
  Scratch& scratch() { return scratch_; }

 private:
  [[nodiscard]] std::string folder(const std::string& name) const { return "'" + scratch_.path(name).string() + "'"; }

  Scratch scratch_;
  std::string case_file_;
  Result one_;
  int number_ = 0;
};

}  // namespace breccia::test
