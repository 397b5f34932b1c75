#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <tuple>

#include "end_to_end/program.hpp"

/// Disks that are full, over quota, read-only, broken or slow in the middle of a run (faulty_disk.cpp): what the run
/// says, what stands, and that it goes on to the same end when there is space again.
namespace breccia::test::faulty_disk_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct DiskFault {
  const char* name;    ///< of the test
  const char* file;    ///< part of the paths that are written to
  const char* result;  ///< what of the undisturbed run's folder such files become; their bytes are counted
  int error;           ///< errno
  bool ends_the_run = true;
};
constexpr DiskFault kFaults[] = {
    {"FullForFrames", "/frames/", "frames", ENOSPC},
    {"OverQuotaForFrames", "/frames/", "frames", EDQUOT},
    {"FullForIndexOfFrames", ".series", "frames/elements.hdf.series", ENOSPC},
    {"FullForHistory", "history.csv", "history.csv", ENOSPC},
    {"ReadOnlyForHistory", "history.csv", "history.csv", EROFS},
    {"FullForStatus", "status.jsonl", "status.jsonl", ENOSPC},
    {"FullForSummary", "summary.json", "", ENOSPC},
    {"FullForCheckpoints", "/checkpoints/", "", ENOSPC, false},
    {"BrokenForCheckpoints", "/checkpoints/", "checkpoints", EIO, false},
};
void PrintTo(const DiskFault& fault, std::ostream* stream) { *stream << fault.name; }

std::uintmax_t size_of(const fs::path& path) {
  if (!fs::is_directory(path)) return fs::file_size(path);
  std::uintmax_t sum = 0;
  for (const auto& entry : fs::directory_iterator(path)) sum += fs::file_size(entry.path());
  return sum;
}

/// All lines of a file are whole; those of the status are JSON.
void expect_whole_lines(const fs::path& run) {
  const std::string history = read_text(run / "history.csv");
  EXPECT_TRUE(history.empty() || history.back() == '\n');
  std::ifstream status(run / "status.jsonl");
  for (std::string line; std::getline(status, line);)
    EXPECT_TRUE(json::parse(line, nullptr, false).is_object()) << line;
}

/// Every frame that the index lists is there.
void expect_sound_frames(const fs::path& run) {
  const fs::path index = run / "frames/elements.hdf.series";
  if (!fs::exists(index)) return;
  const json listed = json::parse(read_text(index), nullptr, false);
  ASSERT_TRUE(listed.is_object());
  for (const json& file : listed.at("files")) EXPECT_TRUE(fs::exists(run / "frames" / file.at("name"))) << file;
}

class FaultyDisk : public testing::TestWithParam<std::tuple<int, DiskFault>> {
 protected:
  FaultyDisk() : case_(scratch_.write("case.toml", kSmallCase)) {
    const Outcome whole = call("run " + case_ + kSettings + quoted("whole"));
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
  }
  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }
  [[nodiscard]] Outcome run_on_disk(const std::string& disk) const {
    const std::string arguments = "run " + case_ + kSettings + quoted("run");
    const std::string environment = "LD_PRELOAD='" BRECCIA_FAULTY_DISK "' FAULTY_DISK='" + disk + "'";
    return ranks_ == 1 ? call(arguments, environment) : call_ranks(ranks_, arguments, environment);
  }
  void expect_same_as_undisturbed() const {
    const json whole = json::parse(read_text(folder("whole") / "summary.json"));
    const json other = json::parse(read_text(folder("run") / "summary.json"), nullptr, false);
    ASSERT_TRUE(other.is_object());
    EXPECT_EQ(other.at("state_hash"), whole.at("state_hash"));
    EXPECT_EQ(history_without_couples(folder("run") / "history.csv"),
              history_without_couples(folder("whole") / "history.csv"));
    EXPECT_EQ(read_text(folder("run") / "frames/elements.hdf.series"),
              read_text(folder("whole") / "frames/elements.hdf.series"));
  }

  static constexpr const char* kSettings =
      " --progress none --set checkpoint.steps=30 --set 'output.frame_interval=\"0.25 ms\"' -o ";
  const int ranks_ = std::get<0>(GetParam());
  Scratch scratch_;
  std::string case_;
};

TEST_P(FaultyDisk, EndsTheRunWithOneErrorAndLeavesWhatGoesOnWhenThereIsSpaceAgain) {
  const DiskFault& fault = std::get<1>(GetParam());
  const std::uintmax_t bytes =
      *fault.result == '\0' ? 0 : size_of(folder("whole") / fault.result) / (2 * static_cast<unsigned>(ranks_));
  const Outcome ended =
      run_on_disk(fault.file + (" " + std::to_string(bytes)) + " " + std::to_string(fault.error) + " 0");
  EXPECT_EQ(ended.exit_code, fault.ends_the_run ? 2 : 0) << ended.err;
  EXPECT_NE(ended.err.find(std::strerror(fault.error)), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(folder("run").string()), std::string::npos) << ended.err;
  expect_whole_lines(folder("run"));
  expect_sound_frames(folder("run"));
  if (fault.ends_the_run) {
    std::size_t errors = 0;  // a checkpoint that was due at that moment is warned of beside it
    std::istringstream words(ended.err);
    for (std::string line; std::getline(words, line);) errors += line.starts_with("breccia: error: ") ? 1 : 0;
    EXPECT_EQ(errors, 1U) << ended.err;
    const Outcome resumed = call("resume " + quoted("run") + " --progress none");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  } else {
    const json checkpoints = json::parse(read_text(folder("run") / "summary.json")).at("checkpoints");
    EXPECT_GT(checkpoints.at("failed"), 0);
    EXPECT_NE(ended.err.find("breccia: warning: no checkpoint: "), std::string::npos) << ended.err;
  }
  expect_same_as_undisturbed();
}

INSTANTIATE_TEST_SUITE_P(ranks, FaultyDisk, testing::Combine(testing::Values(1, 2), testing::ValuesIn(kFaults)),
                         [](const auto& tested) {
                           return std::string(std::get<1>(tested.param).name) + "On" +
                                  std::to_string(std::get<0>(tested.param));
                         });

class SlowDisk : public FaultyDisk {};

TEST_P(SlowDisk, DelaysTheRunAndChangesNothing) {
  const Outcome slow = run_on_disk("/run/ 0 0 1000");
  EXPECT_EQ(slow.exit_code, 0) << slow.err;
  expect_same_as_undisturbed();
}

INSTANTIATE_TEST_SUITE_P(ranks, SlowDisk,
                         testing::Combine(testing::Values(1, 2), testing::Values(DiskFault{"Slow", "", "", 0})),
                         [](const auto& tested) { return "On" + std::to_string(std::get<0>(tested.param)); });

/// A real one, where this process may mount it.
class FullDisk : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  FullDisk() : disk_(scratch_.path("disk").string()), kept_(scratch_.path("kept").string()) {
    fs::create_directories(disk_);
  }
  [[nodiscard]] bool can_be_mounted() const {
    return std::system(("unshare -m mount -t tmpfs -o size=1m none '" + disk_ + "' > /dev/null 2>&1").c_str()) == 0;
  }
  /// On a disk of so many KB, whose files stand in `kept_` afterwards: once a line of the status says how
  /// the run ended, which may come after the program has ended ("state" followed by anything but "running").
  [[nodiscard]] Outcome call_on_disk(int ranks, int size, const std::string& arguments) const {
    const std::string launcher = ranks == 1
                                     ? ""
                                     : "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " BRECCIA_MPIEXEC
                                       " --oversubscribe -n " +
                                           std::to_string(ranks) + " ";
    return call(arguments, "unshare -m sh -c 'mount -t tmpfs -o size=" + std::to_string(size) + "k none \"$0\" && " +
                               launcher +
                               "\"$@\"; code=$?; for look in $(seq 50); do tail -n 1 \"$0/run/status.jsonl\" " +
                               "2>&1 | grep -q \"state...[^r]\" && break; sleep 0.1; done; cp -a \"$0\" \"" + kept_ +
                               "\"; exit $code' '" + disk_ + "'");
  }

  Scratch scratch_;
  std::string disk_, kept_;
};

TEST_P(FullDisk, OfARunLeavesFramesThatAreWholeAndAFolderThatGoesOnElsewhere) {
  const auto [ranks, size] = GetParam();
  if (!can_be_mounted()) GTEST_SKIP() << "nothing can be mounted here";
  const std::string file = scratch_.write("case.toml", kSmallCase);
  const Outcome full =
      call_on_disk(ranks, size,
                   "run " + file + " --progress none --set checkpoint.steps=30 --set checkpoint.keep=1 " +
                       "--set 'output.frame_interval=\"0.05 ms\"' -o '" + disk_ + "/run'");
  EXPECT_EQ(full.exit_code, 2) << full.err;
  EXPECT_NE(full.err.find(std::strerror(ENOSPC)), std::string::npos) << full.err;
  const std::string run = kept_ + "/run";
  expect_whole_lines(run);
  expect_sound_frames(run);
  std::string last;
  std::ifstream status(run + "/status.jsonl");
  for (std::string line; std::getline(status, line);) last = line;
  EXPECT_EQ(json::parse(last, nullptr, false).value("state", ""), "failed") << "the last line: " << last;
  const fs::path checkpoints = run + "/checkpoints";
  std::size_t whole = 0;
  if (fs::exists(checkpoints)) {
    for (const auto& entry : fs::directory_iterator(checkpoints)) {
      EXPECT_EQ(entry.path().extension(), ".h5") << "a part of a checkpoint takes room: " << entry.path();
      ++whole;
    }
  }
  if (whole == 0) return;
  const Outcome resumed = call("resume '" + run + "' --progress none");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

// KB: for a part of the first frame, for frames without a checkpoint, for one checkpoint, for many frames.
INSTANTIATE_TEST_SUITE_P(ranks, FullDisk, testing::Combine(testing::Values(1, 2), testing::Values(48, 320, 640, 2048)),
                         [](const auto& tested) {
                           return "WithRoomForKB" + std::to_string(std::get<1>(tested.param)) + "On" +
                                  std::to_string(std::get<0>(tested.param));
                         });

class FullDiskOfACommand : public FullDisk {};

TEST_P(FullDiskOfACommand, IsOneErrorThatNamesTheFile) {
  if (!can_be_mounted()) GTEST_SKIP() << "nothing can be mounted here";
  const std::string file = scratch_.write("case.toml", kSmallCase), run = scratch_.path("run").string();
  ASSERT_EQ(call("run " + file + " --progress none --set time.max_steps=3 -o '" + run + "'").exit_code, 0);
  const std::vector<std::string> commands{
      "mesh " + file + " -o '" + disk_ + "/mesh'", "report '" + run + "' --no-pictures -o '" + disk_ + "/report.html'",
      "resume '" + run + "' --progress none --set time.max_steps=6 -o '" + disk_ + "/resumed'"};
  for (const std::string& command : commands) {
    fs::remove_all(kept_);
    const Outcome full = call_on_disk(1, 16, command);
    EXPECT_EQ(full.exit_code, 2) << command << ": " << full.err;
    EXPECT_TRUE(full.err.starts_with("breccia: error: " + disk_)) << command << ": " << full.err;
    EXPECT_NE(full.err.find(std::strerror(ENOSPC)), std::string::npos) << command << ": " << full.err;
    EXPECT_FALSE(fs::exists(kept_ + "/report.html")) << "a part of a page";
    EXPECT_FALSE(fs::exists(kept_ + "/mesh/elements_000000.vtkhdf")) << "a part of a frame";
  }
}

INSTANTIATE_TEST_SUITE_P(command, FullDiskOfACommand, testing::Values(std::tuple(1, 16)),
                         [](const auto&) { return "OnOne"; });

// --- What a command prints

TEST(StandardOutput, ThatTakesNothingIsAnErrorOfTheCommandThatPrintsItsResultThere) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::string to_full_disk = "sh -c '\"$@\" > /dev/full' sh";
  for (const std::string& command : {"check " + file, "check --json " + file, "mesh " + file, std::string("explain"),
                                     std::string("schema --json"), std::string("--help")}) {
    const Outcome full = call(command, to_full_disk);
    EXPECT_EQ(full.exit_code, 2) << command << ": " << full.err;
    EXPECT_EQ(full.err, "breccia: error: standard output: cannot be written: No space left on device\n") << command;
  }
}

TEST(StandardOutput, ThatNobodyReadsEndsACommandWithoutWords) {
  const Outcome gone = call("explain", "bash -c '{ sleep 0.2; \"$@\"; echo \"code $?\" >&2; } | true' bash");
  EXPECT_EQ(gone.err, "code 141\n") << "128 + SIGPIPE, as of any program";
}

TEST(StandardOutput, ThatTakesNothingIsNoErrorOfARunWhoseResultsStandInItsFolder) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  const Outcome full =
      call("run " + file + " --set time.max_steps=30 -o '" + run + "'", "sh -c '\"$@\" > /dev/full' sh");
  EXPECT_EQ(full.exit_code, 0) << full.err;
  EXPECT_TRUE(json::parse(read_text(run + "/summary.json"), nullptr, false).is_object());
}

TEST(StandardError, ThatTakesNothingEndsNoCommand) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  for (const std::string& to_nobody :
       {std::string("sh -c '\"$@\" 2> /dev/full' sh"),
        std::string("bash -c '{ sleep "
                    "0.2; \"$@\"; echo $? > CODE; } 2>&1 | true; exit $(cat CODE)' bash")}) {
    std::string shell = to_nobody;
    for (std::size_t at = 0; (at = shell.find("CODE")) != std::string::npos;)
      shell.replace(at, 4, scratch.path("code").string());
    const std::string short_run = "run -f --progress log " + file + " --set time.max_steps=30 -o '" + run + "'";
    EXPECT_EQ(call(short_run, shell).exit_code, 0) << shell;
    EXPECT_EQ(json::parse(read_text(run + "/summary.json"), nullptr, false).value("steps", 0), 30);
    EXPECT_EQ(call("resume --progress log '" + run + "' --set time.max_steps=40", shell).exit_code, 0) << shell;
    EXPECT_EQ(json::parse(read_text(run + "/summary.json"), nullptr, false).value("steps", 0), 40);
  }
}

}  // namespace
}  // namespace breccia::test::faulty_disk_test
