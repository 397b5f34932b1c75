#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <functional>
#include <map>

#include "end_to_end/program.hpp"

/// The folder of a run that comes from somebody else: under any name of its files there may be a link to what the user
/// has elsewhere, a pipe, a device, a folder. No command touches anything outside, shows its content, or hangs.
namespace breccia::test::foreign_folder_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSecret = "the content of a file elsewhere";

/// Names in a run's folder that commands read or write, temporaries included.
const std::vector<std::string> kNames{"case.toml",
                                      "provenance.json",
                                      "history.csv",
                                      "bodies.csv",
                                      "status.jsonl",
                                      "summary.json",
                                      "summary.txt",
                                      "run.lock",
                                      "extracts.csv",
                                      "control",
                                      "report.html",
                                      "frames",
                                      "checkpoints",
                                      "extracts",
                                      "extracts/stress",
                                      "replay",
                                      "frames/elements.hdf.series",
                                      "frames/elements_000001.vtkhdf",
                                      "checkpoints/step_000000000040.h5",
                                      "extracts/stress_000000040.png",
                                      ".case.toml.tmp",
                                      ".provenance.json.tmp",
                                      ".summary.json.tmp",
                                      ".summary.txt.tmp",
                                      ".bodies.csv.tmp",
                                      ".report.html.tmp",
                                      ".control.tmp",
                                      ".extracts.csv.tmp",
                                      "frames/.elements.hdf.series.tmp",
                                      "frames/.elements_000005.vtkhdf.tmp",
                                      "checkpoints/.step_000000000060.h5.tmp"};

struct Kind {
  const char* name;
  void (*make)(const fs::path& at, const fs::path& elsewhere);
};
const std::array kKinds{
    Kind{"link to a file", [](const fs::path& at, const fs::path& e) { fs::create_symlink(e / "secret", at); }},
    Kind{"link to a folder", [](const fs::path& at, const fs::path& e) { fs::create_symlink(e / "folder", at); }},
    Kind{"link to an empty file", [](const fs::path& at, const fs::path& e) { fs::create_symlink(e / "empty", at); }},
    Kind{"dangling link", [](const fs::path& at, const fs::path& e) { fs::create_symlink(e / "new", at); }},
    Kind{"device", [](const fs::path& at, const fs::path&) { fs::create_symlink("/dev/zero", at); }},
    Kind{"pipe", [](const fs::path& at, const fs::path&) { ::mkfifo(at.c_str(), 0600); }},
    Kind{"folder", [](const fs::path& at, const fs::path&) { fs::create_directories(at / "inner"); }},
    Kind{"file without permission", [](const fs::path& at, const fs::path&) {
           std::ofstream(at) << "x";
           ::chmod(at.c_str(), 0);
         }}};

std::map<std::string, std::string> snapshot(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_regular_file() ? read_text(entry.path()) : "";
  return files;
}

/// Files in a folder that hold a text; links are not followed.
std::string files_with(const fs::path& folder, const std::string& text) {
  std::string names;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->symlink_status().type() == fs::file_type::regular &&
        read_text(entry->path()).find(text) != std::string::npos)
      names += entry->path().string() + " ";
  }
  return names;
}

/// A command on the folder RUN; OTHER is an untouched run, NEW a folder that is not there, CASE and START are cases.
struct Command {
  const char* name;
  const char* line;
};

class ForeignFolder : public testing::TestWithParam<Command> {
 protected:
  static void SetUpTestSuite() {
    place_ = std::make_unique<Scratch>();
    place_->write("case.toml", kSmallCase + "[checkpoint]\nsteps = 20\nkeep = 3\n");
    const Outcome made = call("run '" + path("case.toml") + "' --progress none -o '" + path("pristine") + "'");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    fs::create_directories(place_->path("pristine/extracts/stress"));
    std::ofstream(place_->path("pristine/extracts/stress/stress_000000020.png")) << "x";
    std::ofstream(place_->path("pristine/extracts.csv")) << "step,time [s]\n20,1\n40,2\n60,3\n999999,4\n";
  }
  static void TearDownTestSuite() { place_.reset(); }
  ForeignFolder() {
    fs::create_directories(elsewhere_ / "folder");
    std::ofstream(elsewhere_ / "secret") << kSecret;
    std::ofstream(elsewhere_ / "empty") << "";
    // What a run would take for its own in a folder of its own.
    for (const char* name : {"stress_000999999.png", "elements_000001.vtkhdf", "joints_000009.vtkhdf",
                             "step_000000000040.h5", "step_000000999999.h5", "history.csv", "list.pvd"})
      std::ofstream(elsewhere_ / "folder" / name) << kSecret << "\n999999,1\nfile=\"a_000999999.png\"\n";
  }

  static std::string path(const std::string& name) { return place_->path(name).string(); }
  [[nodiscard]] std::string line(std::string text) const {
    for (const auto& [word, value] : {std::pair{"RUN", run_.string()},
                                      {"OTHER", path("pristine")},
                                      {"NEW", scratch_.path("new").string()},
                                      {"CASE", path("case.toml")},
                                      {"START", scratch_.path("start.toml").string()}}) {
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
        text.replace(at, std::string(word).size(), "'" + value + "'");
    }
    return text;
  }
  void expect_harmless(const std::string& name, const Kind& kind) {
    const std::string where = std::string(GetParam().name) + ", " + kind.name + " under " + name;
    fs::remove_all(run_);
    fs::remove_all(scratch_.path("new"));
    fs::copy(place_->path("pristine"), run_, fs::copy_options::recursive);
    scratch_.write("start.toml", kSmallCase + "[start]\nfrom = \"" + run_.string() + "\"\n");
    fs::remove_all(run_ / name);
    kind.make(run_ / name, elsewhere_);
    const auto before = snapshot(elsewhere_);
    const Outcome outcome = call(line(GetParam().line), "timeout -k 1 60");
    EXPECT_EQ(snapshot(elsewhere_), before) << where << ": something outside was changed";
    EXPECT_THAT(outcome.exit_code, testing::AnyOf(0, 2)) << where << ": " << outcome.err;
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    if (outcome.exit_code == 2) {
      EXPECT_EQ(lines, 1) << where << ": " << outcome.err;
    }
    EXPECT_EQ((outcome.out + outcome.err).find(kSecret), std::string::npos) << where;
    EXPECT_EQ(files_with(run_, kSecret) + files_with(scratch_.path("new"), kSecret), "") << where;
  }

  static std::unique_ptr<Scratch> place_;
  const Scratch scratch_;
  const fs::path run_ = scratch_.path("run"), elsewhere_ = scratch_.path("elsewhere");
};
std::unique_ptr<Scratch> ForeignFolder::place_;

TEST_P(ForeignFolder, HarmsNothingOutsideAndDoesNotHangACommand) {
  for (const std::string& name : kNames) {
    for (const Kind& kind : kKinds) {
      if (kind.name == std::string("file without permission") && ::geteuid() == 0) continue;  // root has all of them
      expect_harmless(name, kind);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Commands, ForeignFolder,
    testing::Values(Command{"run_over_it", "run CASE -f -o RUN --progress none --set time.max_steps=30"},
                    Command{"resume", "resume RUN --until '4.05 ms' --progress none"},
                    Command{"resume_elsewhere", "resume RUN -o NEW --until '4.05 ms' --progress none"},
                    Command{"start_from_it", "run START -o NEW --progress none --set time.max_steps=1"},
                    Command{"report", "report RUN --no-pictures"}, Command{"diff", "diff OTHER RUN"},
                    Command{"control", "control RUN stop --patience 1"},
                    Command{"insitu_replay", "insitu replay RUN fractures"}),
    [](const auto& command) { return std::string(command.param.name); });

TEST(OwnFolder, IsNotCopiedIntoItself) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase + "[checkpoint]\nsteps = 20\n");
  const std::string run = scratch.path("run").string();
  ASSERT_EQ(call("run " + file + " --progress none -o '" + run + "'").exit_code, 0);
  const Outcome outcome = call("resume '" + run + "' --until '4.05 ms' -o '" + run + "/frames/x'", "timeout 60");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, testing::HasSubstr("would be copied into itself"));
  EXPECT_FALSE(fs::exists(run + "/frames/x"));
}

TEST(OwnFolder, IsNotContinuedFromACheckpointOfAnotherRun) {
  const Scratch scratch;
  const std::string checkpoints = "[checkpoint]\nsteps = 20\n";
  const std::string one = scratch.write("one.toml", kSmallCase + checkpoints),
                    two = scratch.write("two.toml", changed("gauges = [\"box\"]", "") + checkpoints);
  const fs::path first = scratch.path("first"), second = scratch.path("second");
  for (const auto& [file, folder] : {std::pair{one, first}, {two, second}})
    ASSERT_EQ(call("run " + file + " --progress none -o '" + folder.string() + "'").exit_code, 0);
  for (const auto& entry : fs::directory_iterator(first / "checkpoints")) fs::remove(entry.path());
  for (const auto& entry : fs::directory_iterator(second / "checkpoints"))
    fs::copy(entry.path(), first / "checkpoints" / entry.path().filename());
  const std::string history = read_text(first / "history.csv");
  for (const std::string& command :
       {"resume '" + first.string() + "' --until '4.05 ms'",
        "resume '" + first.string() + "' --until '4.05 ms' -o '" + first.string() + "2'"}) {
    const Outcome outcome = call(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, testing::HasSubstr("this checkpoint is of another run"));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(read_text(first / "history.csv"), history);
}

}  // namespace
}  // namespace breccia::test::foreign_folder_test
