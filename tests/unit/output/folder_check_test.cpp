#include "output/folder/folder_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>

#include "base/error.hpp"
#include "output/folder/folder_tree.hpp"
#include "output/folder/resumed_folder.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::folder_check_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string problem_of(const fs::path& root) {
  try {
    demand_plain_folder(RunFolder{root});
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

/// Names of a run's files; each may be a link, a pipe or anything else in a folder that comes from others.
constexpr std::array kFiles{"case.toml",
                            "provenance.json",
                            "history.csv",
                            "bodies.csv",
                            "status.jsonl",
                            "summary.json",
                            "summary.txt",
                            "run.lock",
                            "extracts.csv",
                            "frames/elements.hdf.series",
                            "frames/joints_000001.vtkhdf",
                            "checkpoints/step_000000000040.h5"};

class FolderCheck : public testing::Test {
 protected:
  FolderCheck() {
    for (const char* name : {"frames", "checkpoints", "extracts"}) fs::create_directories(run_ / name);
    for (const char* name : kFiles) std::ofstream(run_ / name) << "x";
    std::ofstream(folder_ / "outside") << "secret";
  }
  const test::TemporaryFolder folder_;
  const fs::path run_ = folder_ / "run";
};

TEST_F(FolderCheck, HasNothingAgainstRegularFiles) { EXPECT_EQ(problem_of(run_), ""); }

TEST_F(FolderCheck, HasNothingAgainstALinkToTheWholeFolderOrAFileOfTheUser) {
  fs::create_directory_symlink(run_, folder_ / "latest");
  fs::create_symlink(folder_ / "outside", run_ / "my notes");
  EXPECT_EQ(problem_of(folder_ / "latest"), "");
}

TEST_F(FolderCheck, NamesALinkUnderEveryName) {
  for (const char* name : kFiles) {
    fs::remove(run_ / name);
    fs::create_symlink(folder_ / "outside", run_ / name);
    EXPECT_THAT(problem_of(run_), HasSubstr((run_ / name).string() + ": is a symbolic link")) << name;
    fs::remove(run_ / name);
    fs::create_symlink(folder_ / "nowhere", run_ / name);
    EXPECT_THAT(problem_of(run_), HasSubstr((run_ / name).string() + ": is a symbolic link")) << name;
    fs::remove(run_ / name);
  }
}

TEST_F(FolderCheck, NamesAPipeUnderEveryName) {
  for (const char* name : kFiles) {
    fs::remove(run_ / name);
    ASSERT_EQ(::mkfifo((run_ / name).c_str(), 0600), 0);
    EXPECT_THAT(problem_of(run_), HasSubstr((run_ / name).string() + ": is a pipe")) << name;
    fs::remove(run_ / name);
  }
}

TEST_F(FolderCheck, NamesALinkInPlaceOfAFolder) {
  for (const char* name : {"frames", "checkpoints", "extracts"}) {
    fs::rename(run_ / name, folder_ / name);
    fs::create_directory_symlink(folder_ / name, run_ / name);
    EXPECT_THAT(problem_of(run_), HasSubstr((run_ / name).string() + ": is a symbolic link")) << name;
    fs::remove(run_ / name);
  }
}

TEST_F(FolderCheck, NamesALinkBelowTheExtracts) {
  fs::create_directories(run_ / "extracts" / "stress");
  EXPECT_NO_THROW(demand_plain_tree(run_ / "extracts"));
  EXPECT_NO_THROW(demand_plain_tree(run_ / "none"));
  fs::create_symlink(folder_ / "outside", run_ / "extracts" / "stress" / "stress_000000120.png");
  EXPECT_THROW(demand_plain_tree(run_ / "extracts"), OutputError);
}

TEST_F(FolderCheck, KnowsAFolderInsideAnotherHoweverItIsWritten) {
  fs::create_directory_symlink(run_, folder_ / "latest");
  EXPECT_THROW(refuse_inside(run_ / "frames" / "x", run_, "inside"), OutputError);
  EXPECT_THROW(refuse_inside(folder_ / "latest" / "frames" / ".." / "x", run_, "inside"), OutputError);
  EXPECT_NO_THROW(refuse_inside(folder_ / "run2", run_, "inside"));
}

TEST_F(FolderCheck, ACopyHoldsTheSameFilesAndNoLink) {
  std::ofstream(run_ / "frames" / "own.txt") << "text";
  copy_tree(run_ / "frames", folder_ / "copy");
  EXPECT_EQ(test::names_in(folder_ / "copy"), test::names_in(run_ / "frames"));
  EXPECT_EQ(test::content_of(folder_ / "copy" / "own.txt"), "text");
  EXPECT_TRUE(fs::equivalent(folder_ / "copy" / "joints_000001.vtkhdf", run_ / "frames" / "joints_000001.vtkhdf"))
      << "frames are linked";
  copy_tree(run_ / "none", folder_ / "no copy");
  EXPECT_FALSE(fs::exists(folder_ / "no copy"));
  fs::create_symlink(folder_ / "outside", run_ / "frames" / "secret");
  EXPECT_THROW(copy_tree(run_ / "frames", folder_ / "second copy"), OutputError);
  EXPECT_FALSE(fs::exists(folder_ / "second copy" / "secret"));
}

TEST_F(FolderCheck, ACheckpointOfAnotherRunIsRefused) {
  Checkpoint from;
  from.provenance = R"({"program": "breccia", "run": "a"})";
  std::ofstream(run_ / "provenance.json") << R"({"program": "breccia", "run": "a"})";
  EXPECT_NO_THROW(demand_own_run(RunFolder{run_}, "step.h5", from));
  std::ofstream(run_ / "provenance.json") << R"({"program": "breccia", "run": "b"})";
  EXPECT_THROW(demand_own_run(RunFolder{run_}, "step.h5", from), InputError);
  std::ofstream(run_ / "provenance.json") << R"({"program": "breccia"})";
  EXPECT_THROW(demand_own_run(RunFolder{run_}, "step.h5", from), InputError);
  from.provenance = R"({"program": "breccia"})";
  EXPECT_NO_THROW(demand_own_run(RunFolder{run_}, "step.h5", from)) << "of a version that named no runs";
}

}  // namespace
}  // namespace breccia::folder_check_test
