#include "system/bounded_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/json_depth.hpp"

namespace breccia::bounded_file_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class BoundedFiles : public testing::Test {
 protected:
  BoundedFiles() {
    std::string pattern = (fs::temp_directory_path() / "breccia_bounded_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~BoundedFiles() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(BoundedFiles, AreReadWholeUpToTheBound) {
  std::ofstream(folder_ / "a", std::ios::binary) << std::string("one\0two\n", 8);
  EXPECT_EQ(read_bounded(folder_ / "a", 8).text, std::string("one\0two\n", 8));
  EXPECT_EQ(read_bounded(folder_ / "a", 8).problem, "");
  EXPECT_EQ(read_bounded(folder_ / "a", 7).problem, "is larger (8 B) than such a file may be (7 B)");
  EXPECT_EQ(read_bounded(folder_ / "a", 7).text, "");
  EXPECT_EQ(read_bounded(folder_ / "b", 7).problem, kDoesNotExist);
}

TEST_F(BoundedFiles, OfOtherKindsAreRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_bounded(folder_ / "pipe", 100).problem, "is not a file");
  EXPECT_EQ(read_bounded("/dev/zero", 100).problem, "is not a file");
  EXPECT_EQ(read_bounded(folder_, 100).problem, "is a folder");
  EXPECT_THAT(read_bounded("/proc/self/mem", 100).problem, StartsWith("cannot be read"));
}

TEST_F(BoundedFiles, ThatHideTheirSizeAreReadUpToTheBound) {
  EXPECT_THAT(read_bounded("/proc/self/maps", 1'000'000).text, HasSubstr("[stack]"));
  EXPECT_EQ(read_bounded("/proc/self/maps", 10).problem, "is larger than such a file may be (10 B)");
}

TEST(BytesText, HasThreeDigitsAndADecimalPrefix) {
  EXPECT_EQ(bytes_text(7), "7 B");
  EXPECT_EQ(bytes_text(512), "512 B");
  EXPECT_EQ(bytes_text(17'200'000'000), "17.2 GB");
  EXPECT_EQ(bytes_text(64'000'000), "64 MB");
  EXPECT_EQ(bytes_text(999'900'000), "1 GB");
  EXPECT_EQ(bytes_text(123'456'789'012), "123 GB");
}

TEST(JsonDepth, CountsBracketsOutsideTexts) {
  EXPECT_FALSE(is_nested_deeper(R"([[{"a": "[[[[\"[[["}, []]])", 3));
  EXPECT_TRUE(is_nested_deeper(R"([[{"a": "[[[[\"[[["}, []]])", 2));
  EXPECT_TRUE(is_nested_deeper(std::string(1'000'000, '['), kDeepestJson));
  EXPECT_FALSE(is_nested_deeper("", 0));
}

}  // namespace
}  // namespace breccia::bounded_file_test
