#include "system/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "unit/output/temporary_folder.hpp"
#include "unit/system/file_size_limit.hpp"

namespace breccia::atomic_file_test {
namespace {

using test::content_of;
using test::FileSizeLimit;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Text of the OutputError that `action` throws; "" when it throws nothing.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

TEST(AtomicFile, HoldsExactlyWhatWasGivenAndLeavesNothingBesideIt) {
  const TemporaryFolder folder;
  const std::string content("a\0b\nc", 5);
  write_file_atomically(folder.path() / "x.bin", content);
  EXPECT_EQ(content_of(folder.path() / "x.bin"), content);
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("x.bin"));
}

TEST(AtomicFile, ReplacesALongerOldFileWhole) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "x", std::string(1000, 'o'));
  write_file_atomically(folder.path() / "x", std::string_view("new"));
  EXPECT_EQ(content_of(folder.path() / "x"), "new");
}

TEST(AtomicFile, KeepsTheOldFileAndNamesItWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "x";
  write_file_atomically(path, std::string_view("old"));
  std::string message;
  {
    const FileSizeLimit limit(100);
    message = error_of([&] { write_file_atomically(path, std::string(1000, 'n')); });
  }
  EXPECT_THAT(message, HasSubstr(path.string()));
  EXPECT_THAT(message, HasSubstr("File too large"));
  EXPECT_EQ(content_of(path), "old");
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("x"));
}

TEST(AtomicFile, NamesTheFileAndTheReasonWhenItsFolderIsMissing) {
  const TemporaryFolder place;
  const std::filesystem::path file = place / "missing/folder/x";
  const std::string message = error_of([&] { write_file_atomically(file, std::string_view("a")); });
  EXPECT_THAT(message, HasSubstr(file.string()));
  EXPECT_THAT(message, HasSubstr("No such file or directory"));
}

TEST(AtomicFile, LeavesNoTemporaryWhenTheNameIsTakenByAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "x");
  EXPECT_THAT(error_of([&] { write_file_atomically(folder.path() / "x", std::string_view("a")); }),
              HasSubstr("Is a directory"));
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("x"));
}

TEST(AtomicFiles, AppearTogetherOrNotAtAllWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string small = "small", large(1000, 'l');
  const std::vector<FileContent> files{{folder / "a", std::as_bytes(std::span(small))},
                                       {folder / "b", std::as_bytes(std::span(large))}};
  std::string message;
  {
    const FileSizeLimit limit(100);
    message = error_of([&] { write_files_atomically(files); });
  }
  EXPECT_THAT(message, HasSubstr((folder / "b").string() + ": cannot write this file"));
  EXPECT_THAT(test::names_in(folder.path()), IsEmpty());
  write_files_atomically(files);
  EXPECT_EQ(content_of(folder / "a"), small);
  EXPECT_EQ(content_of(folder / "b"), large);
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("a", "b"));
}

TEST(LineFile, ShowsEveryLineAtOnce) {
  const TemporaryFolder folder;
  LineFile file(folder.path() / "lines");
  file.append_line("one");
  EXPECT_EQ(content_of(folder.path() / "lines"), "one\n");
  file.append_line("two");
  EXPECT_EQ(content_of(folder.path() / "lines"), "one\ntwo\n");
}

TEST(LineFile, CutsOffThePartOfALineThatDidNotFit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "lines";
  LineFile file(path);
  file.append_line("whole");
  {
    const FileSizeLimit limit(10);
    EXPECT_THAT(error_of([&] { file.append_line("a line too long for the disk"); }), HasSubstr(path.string()));
  }
  EXPECT_EQ(content_of(path), "whole\n");
  file.append_line("after");
  EXPECT_EQ(content_of(path), "whole\nafter\n");
}

TEST(LineFile, IsNoDevice) {
  EXPECT_THAT(error_of([] { LineFile file("/dev/full"); }),
              HasSubstr("/dev/full: cannot create this file: is a device"));
}

TEST(LineFile, IsNotReachedThroughALink) {
  const TemporaryFolder folder;
  std::ofstream(folder / "other") << "kept";
  std::filesystem::create_symlink(folder / "other", folder / "lines");
  EXPECT_THAT(error_of([&] { LineFile file(folder / "lines"); }), HasSubstr("is a symbolic link"));
  EXPECT_EQ(content_of(folder / "other"), "kept");
}

TEST(AtomicFile, DoesNotWriteThroughALinkUnderTheNameOfItsTemporaryOrItsOwn) {
  const TemporaryFolder folder;
  for (const char* name : {"first", "second"}) std::ofstream(folder / name) << "kept";
  std::filesystem::create_symlink(folder / "first", temporary_of(folder / "x"));
  std::filesystem::create_symlink(folder / "second", folder / "x");
  write_file_atomically(folder / "x", std::string_view("new"));
  EXPECT_EQ(content_of(folder / "first"), "kept");
  EXPECT_EQ(content_of(folder / "second"), "kept");
  EXPECT_EQ(content_of(folder / "x"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "x"));
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("first", "second", "x"));
}

TEST(AtomicFile, DoesNotWaitForAPipeUnderTheNameOfItsTemporary) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(temporary_of(folder / "x").c_str(), 0600), 0);
  write_file_atomically(folder / "x", std::string_view("new"));
  EXPECT_EQ(content_of(folder / "x"), "new");
}

TEST(AtomicFile, IsNotWrittenIntoALinkedSubfolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "frames");
  EXPECT_THAT(
      error_of([&] { write_file_atomically(folder / "frames" / "x", std::string_view("new"), Depth::subfolder); }),
      HasSubstr("is a symbolic link"));
  EXPECT_THAT(test::names_in(folder / "elsewhere"), IsEmpty());
}

TEST(Folder, ThatCannotBeMadeIsNamedWithTheReason) {
  EXPECT_THAT(error_of([] { create_folder("/proc/none/at/all"); }),
              HasSubstr("/proc/none/at/all: cannot create this folder: No such file or directory"));
}

TEST(LineFile, ReportsAPlaceWhereNoFileCanBeCreated) {
  EXPECT_THAT(error_of([] { LineFile file("/proc/no_file_here"); }), HasSubstr("/proc/no_file_here: cannot create"));
}

}  // namespace
}  // namespace breccia::atomic_file_test
