#include "system/regular_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "base/error.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::regular_file_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RegularFile : public testing::Test {
 protected:
  RegularFile() {
    fs::create_directories(folder_ / "run" / "frames");
    std::ofstream(folder_ / "outside") << "secret";
    std::ofstream(folder_ / "run" / "file") << "content";
    std::ofstream(folder_ / "run" / "frames" / "frame") << "frame";
  }
  [[nodiscard]] static std::string reason(const fs::path& path, Depth depth = Depth::file) {
    return open_regular(path, O_RDONLY, depth).reason;
  }
  const test::TemporaryFolder folder_;
  const fs::path run_ = folder_ / "run";
};

TEST_F(RegularFile, IsReadWhole) {
  EXPECT_EQ(regular_content(run_ / "file"), "content");
  EXPECT_EQ(regular_content(run_ / "frames" / "frame", Depth::subfolder), "frame");
}

TEST_F(RegularFile, NeedNotBeThere) {
  EXPECT_EQ(regular_content(run_ / "none"), std::nullopt);
  EXPECT_EQ(regular_content(run_ / "none" / "none", Depth::subfolder), std::nullopt);
  EXPECT_FALSE(RegularStream(run_ / "none").good());
}

TEST_F(RegularFile, IsNotALinkUnlessTheUserNamedIt) {
  fs::create_symlink(folder_ / "outside", run_ / "link");
  EXPECT_THAT(reason(run_ / "link"), HasSubstr("is a symbolic link"));
  EXPECT_THROW((void)regular_content(run_ / "link"), InputError);
  EXPECT_EQ(regular_content(run_ / "link", Depth::named), "secret");
}

TEST_F(RegularFile, IsNotReachedThroughALinkInPlaceOfAFolder) {
  fs::create_directory_symlink(run_ / "frames", run_ / "linked");
  EXPECT_THAT(reason(run_ / "linked" / "frame", Depth::subfolder), HasSubstr("is a symbolic link"));
  EXPECT_EQ(regular_content(run_ / "linked" / "frame"), "frame") << "the folder itself was named by the user";
}

TEST_F(RegularFile, IsNoPipeAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo((run_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(reason(run_ / "pipe"), "is a pipe, not a regular file");
  EXPECT_EQ(open_regular(run_ / "pipe", O_WRONLY, Depth::file).reason, "is a pipe, not a regular file");
  EXPECT_EQ(unusual_kind(run_ / "pipe"), "is a pipe");
}

TEST_F(RegularFile, IsNoDevice) {
  EXPECT_EQ(reason("/dev/zero"), "is a device, not a regular file");
  EXPECT_EQ(unusual_kind("/dev/zero"), "is a device");
}

TEST_F(RegularFile, IsNoFolder) { EXPECT_EQ(reason(run_ / "frames"), "Is a directory"); }

TEST_F(RegularFile, IsEmptiedOnlyWhereItIsOne) {
  fs::create_symlink(folder_ / "outside", run_ / "link");
  EXPECT_FALSE(open_regular(run_ / "link", O_WRONLY | O_TRUNC, Depth::file));
  EXPECT_EQ(regular_content(folder_ / "outside"), "secret");
  EXPECT_TRUE(open_regular(run_ / "file", O_WRONLY | O_TRUNC, Depth::file));
  EXPECT_EQ(regular_content(run_ / "file"), "");
}

}  // namespace
}  // namespace breccia::regular_file_test
