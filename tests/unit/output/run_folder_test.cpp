#include "output/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia {
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
  const RunFolder folder = prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse);
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
  const RunFolder folder = prepare_run_folder(place.path(), "old", kProvenance, OldResults::refuse);
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
}  // namespace breccia
