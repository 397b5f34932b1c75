#include "run_folder/content.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "unit/output/temporary_folder.hpp"

namespace breccia::run_folder::content_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(RunFolderContent, IsThatOfTheFile) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "a\0b";
  EXPECT_EQ(read_content(folder / "file").text, "a");
  EXPECT_THAT(read_content(folder / "file").problem, IsEmpty());
  EXPECT_FALSE(read_content(folder / "file").is_missing);
}

TEST(RunFolderContent, OfAnEmptyFileIsNotMissing) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file").flush();
  const Content content = read_content(folder / "file");
  EXPECT_FALSE(content.is_missing);
  EXPECT_THAT(content.problem, IsEmpty());
  EXPECT_THAT(content.text, IsEmpty());
}

TEST(RunFolderContent, OfAFileThatIsNotThereIsMissing) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(read_content(folder / "none").is_missing);
  EXPECT_TRUE(read_content(folder / "none" / "none", Depth::subfolder).is_missing);
  EXPECT_THAT(read_content(folder / "none").problem, IsEmpty());
}

TEST(RunFolderContent, IsNotReadThroughALinkOrFromAPipeOrADevice) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "outside") << "secret";
  std::filesystem::create_directory(folder / "run");
  std::filesystem::create_symlink(folder / "outside", folder / "run" / "link");
  std::filesystem::create_symlink("/dev/zero", folder / "run" / "device");
  std::filesystem::create_directory_symlink(folder.path(), folder / "run" / "frames");
  ASSERT_EQ(::mkfifo((folder / "run" / "pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "device", "pipe"}) {
    const Content content = read_content(folder / "run" / name);
    EXPECT_THAT(content.problem, HasSubstr("not a regular file")) << name;
    EXPECT_THAT(content.text, IsEmpty()) << name;
  }
  EXPECT_THAT(read_content(folder / "run" / "frames" / "outside", Depth::subfolder).text, IsEmpty());
  EXPECT_THAT(read_content("/dev/zero").problem, HasSubstr("is a device"));
  EXPECT_THAT(read_content(folder.path()).problem, HasSubstr("directory"));
}

TEST(RunFolderContent, IsBounded) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "12345";
  EXPECT_EQ(read_content(folder / "file", Depth::file, 5).text, "12345");
  const Content content = read_content(folder / "file", Depth::file, 4);
  EXPECT_THAT(content.problem, HasSubstr("larger"));
  EXPECT_THAT(content.text, IsEmpty());
  std::ofstream(folder / "sparse").flush();
  std::filesystem::resize_file(folder / "sparse", std::uintmax_t{1} << 40);
  EXPECT_THAT(read_content(folder / "sparse").problem, HasSubstr("larger"));
}

TEST(RunFolderContent, IsReadFromAPlaceOnAsFarAsItGoes) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "12345";
  const Opened file = open_regular(folder / "file", O_RDONLY, Depth::file);
  EXPECT_EQ(bytes_from(file.descriptor, 1, 3), "234");
  EXPECT_EQ(bytes_from(file.descriptor, 3, 100), "45");
  EXPECT_EQ(bytes_from(file.descriptor, 9, 100), "");
}

}  // namespace
}  // namespace breccia::run_folder::content_test
