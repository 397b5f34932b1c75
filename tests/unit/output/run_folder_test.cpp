#include "output/folder/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.hpp"
#include "output/folder/resumed_folder.hpp"
#include "output/folder/run_diff.hpp"
#include "output/folder/run_lock.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::run_folder_test {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::TemporaryFolder;
using testing::HasSubstr;

const Provenance kProvenance = collect_provenance("1.2.3", {"breccia", "run", "case.toml"});

std::string error_of(const fs::path& root, OldResults old_results) {
  try {
    (void)prepare_run_folder(root, "title = \"x\"\n", kProvenance, old_results);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

void touch(const fs::path& path) { std::ofstream(path) << "old\n"; }

TEST(RunFolderTest, GetsTheResolvedCaseItsProvenanceAndAPlaceForFrames) {
  const TemporaryFolder place;
  const RunFolder folder =
      prepare_run_folder(place.path() / "runs" / "glass", "title = \"x\"\n", kProvenance, OldResults::refuse);
  EXPECT_EQ(content_of(folder.case_file()), "title = \"x\"\n");
  EXPECT_TRUE(fs::is_directory(folder.frames()));
  const auto json = nlohmann::json::parse(content_of(folder.provenance()));
  EXPECT_EQ(json.at("program"), "breccia");
  EXPECT_EQ(json.at("version"), "1.2.3");
  EXPECT_EQ(json.at("command_line"), nlohmann::json({"breccia", "run", "case.toml"}));
}

TEST(RunFolderTest, KnowsTheMachineAndTheBuild) {
  EXPECT_FALSE(kProvenance.host.empty());
  EXPECT_GE(kProvenance.cores, 1);
  EXPECT_THAT(kProvenance.compiler, HasSubstr("."));
  EXPECT_THAT(kProvenance.flags, HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(kProvenance.started,
              testing::MatchesRegex("20[0-9][0-9]-[0-9][0-9]-[0-9][0-9]T[0-9][0-9]:[0-9][0-9]:[0-9][0-9]Z"));
}

TEST(RunFolderTest, RefusesAFolderThatHoldsOtherThingsAndTouchesNothingInIt) {
  const TemporaryFolder place;
  touch(place.path() / "thesis.tex");
  touch(place.path() / "history.csv");
  for (const OldResults old : {OldResults::refuse, OldResults::overwrite}) {
    EXPECT_THAT(error_of(place.path(), old), HasSubstr(place.path().string() + ": this folder holds other things"));
  }
  EXPECT_EQ(test::names_in(place.path()), (std::vector<std::string>{"history.csv", "thesis.tex"}));
}

TEST(RunFolderTest, RefusesResultsOfAnEarlierRunUnlessTheyMayGo) {
  const TemporaryFolder place;
  const RunFolder folder{prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse).root};
  EXPECT_EQ(error_of(place.path(), OldResults::refuse), "") << "a prepared folder without results is free";
  for (const fs::path& result : {folder.history(), folder.status(), folder.summary(), folder.summary_text(),
                                 folder.frames() / "joints_000007.vtkhdf"}) {
    touch(result);
    EXPECT_THAT(error_of(place.path(), OldResults::refuse), HasSubstr("results of an earlier run")) << result;
    fs::remove(result);
  }
}

TEST(RunFolderTest, OverwritingRemovesResultsAndNothingElse) {
  const TemporaryFolder place;
  const RunFolder folder{prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse).root};
  const std::vector<fs::path> results{folder.history(),
                                      folder.status(),
                                      folder.summary(),
                                      folder.frames() / "elements_000000.vtkhdf",
                                      folder.frames() / "elements_1000000.vtkhdf",
                                      folder.frames() / "elements.hdf.series",
                                      folder.frames() / ".contacts_000001.vtkhdf.tmp"};
  const std::vector<fs::path> others{place.path() / "notes.txt", folder.frames() / "elements.png",
                                     folder.frames() / "my.vtkhdf"};
  for (const fs::path& path : results) touch(path);
  for (const fs::path& path : others) touch(path);
  EXPECT_EQ(error_of(place.path(), OldResults::overwrite), "");
  for (const fs::path& path : results) EXPECT_FALSE(fs::exists(path)) << path;
  for (const fs::path& path : others) EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_EQ(content_of(folder.case_file()), "title = \"x\"\n");
}

TEST(RunFolderTest, OverwritingRemovesOfExtractsAndCheckpointsWhatTheRunWrote) {
  const TemporaryFolder place;
  const RunFolder folder{prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse).root};
  const fs::path stress = folder.extracts() / "stress", cracks = folder.extracts() / "cracks";
  for (const fs::path& made : {stress, cracks, folder.checkpoints()}) fs::create_directories(made);
  const std::vector<fs::path> results{stress / "stress_000000120.png", cracks / "cracks.pvd",
                                      folder.checkpoints() / "step_000000000120.h5",
                                      folder.checkpoints() / ".step_000000000240.h5.tmp"};
  const std::vector<fs::path> others{stress / "film.mp4", stress / "stress_000000999.png",
                                     folder.checkpoints() / "step_12.h5"};
  for (const fs::path& path : results) touch(path);
  for (const fs::path& path : others) touch(path);
  std::ofstream(folder.extract_steps()) << "step,time [s],pipeline\n120,1e-6,stress\n";
  EXPECT_THAT(error_of(place.path(), OldResults::refuse), HasSubstr("results of an earlier run"));
  EXPECT_EQ(error_of(place.path(), OldResults::overwrite), "");
  for (const fs::path& path : results) EXPECT_FALSE(fs::exists(path)) << path;
  for (const fs::path& path : others) EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_FALSE(fs::exists(cracks)) << "nothing is left in it";
  EXPECT_FALSE(fs::exists(folder.extract_steps()));
}

TEST(RunFolderTest, IsRefusedWhileAnotherRunWritesThere) {
  const TemporaryFolder place;
  {
    const RunFolder first = prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse);
    EXPECT_THAT(holder_of(place.path()), HasSubstr("process " + std::to_string(::getpid())));
    touch(first.history());
    for (const OldResults old : {OldResults::refuse, OldResults::overwrite})
      EXPECT_THAT(error_of(place.path(), old), HasSubstr("another run writes here: process"));
    EXPECT_TRUE(fs::exists(first.history()));
  }
  EXPECT_EQ(holder_of(place.path()), "") << "a lock that is left over holds nothing";
  EXPECT_EQ(error_of(place.path(), OldResults::overwrite), "");
}

TEST(RunFolderTest, SaysHowOldResultsAreReplaced) {
  const TemporaryFolder place;
  touch(prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse).history());
  EXPECT_THAT(error_of(place.path(), OldResults::refuse), HasSubstr("-f (--overwrite)"));
}

TEST(RunFolderTest, KnowsTheHashOfAnInput) {
  const TemporaryFolder place;
  std::ofstream(place.path() / "abc") << "abc";
  EXPECT_EQ(input_file(place.path() / "abc").sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2, appendix B.1
  EXPECT_EQ(input_file(place.path() / "gone").sha256, "");
  std::ofstream(place.path() / "long") << std::string(1'000'000, 'a');
  EXPECT_EQ(input_file(place.path() / "long").sha256,
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");  // appendix B.3
}

/// What stands in status.jsonl after a process with a watch has ended by `end`, with this last line before.
std::string status_after(const std::string& line, const std::function<void()>& end) {
  const TemporaryFolder place;
  std::ofstream(RunFolder{place.path()}.status()) << line;
  const pid_t process = ::fork();
  if (process == 0) {
    try {
      RunWatch watch;
      const RunLock lock(place.path());
      watch.guard(place.path());
      end();
    } catch (...) {
    }
    ::_exit(0);
  }
  ::waitpid(process, nullptr, 0);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::milliseconds(3000);
  while (content_of(RunFolder{place.path()}.status()) == line && std::chrono::steady_clock::now() < patience)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return content_of(RunFolder{place.path()}.status()).substr(line.size());
}

TEST(RunWatchTest, TellsThatARunWasKilled) {
  EXPECT_THAT(status_after("{\"state\":\"running\",\"step\":7}\n", [] { ::raise(SIGKILL); }),
              testing::StartsWith("{\"state\":\"interrupted\""));
  EXPECT_THAT(status_after("{\"state\":\"paused\",\"step\":7}\n", [] { ::raise(SIGKILL); }),
              testing::StartsWith("{\"state\":\"interrupted\""));
  EXPECT_THAT(status_after("{\"state\":\"running\"}\n{\"state\":\"runn", [] { ::raise(SIGKILL); }),
              testing::StartsWith("\n{\"state\":\"interrupted\""))
      << "after a line that was cut off";
}

TEST(RunWatchTest, TellsThatAnErrorEndedARun) {
  EXPECT_THAT(status_after("{\"state\":\"running\",\"step\":7}\n", [] { throw std::runtime_error("disk full"); }),
              testing::StartsWith("{\"state\":\"failed\""));
}

TEST(RunWatchTest, TellsWhatBecameOfARunThatHasNotComeToItsFirstStep) {
  EXPECT_THAT(status_after("", [] { throw std::runtime_error("disk full"); }),
              testing::StartsWith("{\"state\":\"failed\""));
  EXPECT_THAT(status_after("{\"event\":\"resume\"}\n", [] { ::raise(SIGKILL); }),
              testing::StartsWith("{\"state\":\"interrupted\""));
}

TEST(RunWatchTest, AddsNothingToARunThatHasEnded) {
  EXPECT_EQ(status_after("{\"state\":\"complete\",\"step\":7}\n", [] { ::raise(SIGKILL); }), "");
}

// --- Two runs compared

TEST(RunDiffTest, NamesKeysInputsResultsAndTheFirstLineThatDiffers) {
  const TemporaryFolder place;
  const auto run = [&](const std::string& name, const std::string& young, const std::string& hash, double last) {
    Provenance provenance = kProvenance;
    provenance.inputs = {{"case.toml", hash}};
    const RunFolder folder = prepare_run_folder(
        place.path() / name, "title = \"x\"\n[[material]]\nyoung = " + young + "\n", provenance, OldResults::refuse);
    std::ofstream(folder.summary()) << "{\"state_hash\": \"" << hash << "\", \"wall_s\": " << last << "}";
    std::ofstream(folder.history()) << "step,time [s],couples,kinetic [J]\n1,0,5,2\n2,1," << last << ",3\n3,2,5,"
                                    << last << "\n";
    return folder.root;
  };
  const fs::path a = run("a", "4.0", "aa", 8), b = run("b", "5.0", "bb", 9), c = run("c", "4.0", "aa", 8);
  const std::string text = diff_runs(a, b);
  EXPECT_THAT(text, HasSubstr("  material[0].young: 4 | 5\n"));
  EXPECT_THAT(text, HasSubstr("  input case.toml: aa | bb\n"));
  EXPECT_THAT(text, HasSubstr("  state_hash: aa | bb\n"));
  EXPECT_THAT(text, HasSubstr("they part in line 4, step 3\n    kinetic [J]: 8 | 9\n")) << "couples are no result";
  EXPECT_THAT(text, testing::Not(HasSubstr("wall_s")));
  EXPECT_EQ(diff_runs(a, c),
            "case: the same\ninputs, versions, machine: the same\nresults: the same\nhistory: the same\n");
  EXPECT_THROW((void)diff_runs(a, place.path()), OutputError);
}

TEST(RunDiffTest, ComparesRunsWhoseFilesAreNestedWithoutEnd) {
  const TemporaryFolder place;
  const std::string deep = "{\"a\":" + std::string(1'000'000, '[');
  for (const char* name : {"a", "b"}) {
    const RunFolder folder =
        prepare_run_folder(place.path() / name, "title = \"x\"\n", kProvenance, OldResults::refuse);
    std::ofstream(folder.summary()) << deep + std::string(1'000'000, ']') + "}";
    std::ofstream(folder.history()) << "step\n";
  }
  EXPECT_THAT(diff_runs(place.path() / "a", place.path() / "b"), HasSubstr("results: the same\n"));
  const RunFolder last{place.path() / "b"};
  std::ofstream(last.provenance()) << deep;
  EXPECT_THROW((void)prepare_run_folder(last.root, "title = \"x\"\n", kProvenance, OldResults::overwrite), OutputError)
      << "no run stands there any more";
  EXPECT_FALSE(is_complete(last, 1));
}

TEST(RunFolderTest, NamesAPlaceWhereNothingCanBeWritten) {
  EXPECT_THAT(error_of("/proc/run", OldResults::refuse), HasSubstr("/proc/run: cannot create this folder"));
  const TemporaryFolder place;
  touch(place.path() / "file");
  EXPECT_THAT(error_of(place.path() / "file", OldResults::refuse), HasSubstr((place.path() / "file").string()));
  EXPECT_THAT(error_of(place.path() / "file" / "run", OldResults::refuse), HasSubstr("Not a directory"));
}

TEST(RunFolderTest, DefaultsToRunsAndTheCasesFolder) {
  EXPECT_EQ(default_run_folder("meshes/glass_impact/case.toml"), fs::path("runs/glass_impact"));
  EXPECT_EQ(default_run_folder("/a/b/../hertz/case_smoke.toml"), fs::path("runs/hertz"));
}

}  // namespace
}  // namespace breccia::run_folder_test
