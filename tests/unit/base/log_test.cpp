#include "base/log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.hpp"

namespace breccia::log_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Log : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    log::set_level(log::Level::info);
  }
  void TearDown() override {
    log::set_level(log::Level::info);
    std::filesystem::remove_all(folder_);
  }

  [[nodiscard]] static std::string content(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  // One folder a test: tests run at the same time.
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("breccia_log_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Log, WritesLevelAndMessageToStderrAndNothingToStdout) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  log::info("a {} stays as it is");
  log::warning("softness 12 %");
  log::error("no mesh");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "info: a {} stays as it is\nwarning: softness 12 %\nerror: no mesh\n");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST_F(Log, DropsMessagesBelowItsLevel) {
  log::set_level(log::Level::warning);
  ::testing::internal::CaptureStderr();
  log::info("chatter");
  log::warning("careful");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "warning: careful\n");
}

TEST_F(Log, AlsoWritesToItsFileInAFolderThatDidNotExist) {
  const std::filesystem::path file = folder_ / "deeper" / "run.log";
  ::testing::internal::CaptureStderr();
  log::open_file(file);
  log::warning("into the file");
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("into the file"));
  EXPECT_THAT(content(file), HasSubstr("warning: into the file\n"));
}

TEST_F(Log, LeavesTheFirstFileWhenASecondIsOpened) {
  ::testing::internal::CaptureStderr();
  log::open_file(folder_ / "first.log");
  log::info("one");
  log::open_file(folder_ / "second.log");
  log::info("two");
  static_cast<void>(::testing::internal::GetCapturedStderr());
  EXPECT_THAT(content(folder_ / "first.log"), Not(HasSubstr("two")));
  EXPECT_THAT(content(folder_ / "second.log"), HasSubstr("two"));
  EXPECT_THAT(content(folder_ / "second.log"), Not(HasSubstr("one")));
}

TEST_F(Log, RefusesAFileThatCannotBeWritten) {
  std::filesystem::create_directories(folder_);
  const std::filesystem::path occupied = folder_ / "a_file";
  std::ofstream(occupied) << "x";
  EXPECT_THROW(log::open_file(occupied / "run.log"), OutputError);
}

}  // namespace
}  // namespace breccia::log_test
