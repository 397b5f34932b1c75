#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "output/folder/history_sink.hpp"
#include "output/folder/status_sink.hpp"
#include "system/atomic_file.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;

/// What was handed to the disk, and the names that stood in its folder at that moment.
struct Synced {
  std::filesystem::path path;
  std::vector<std::string> names;
};
std::vector<Synced> synced;

/// For the length of a test, from nothing on.
class SyncedFile : public testing::Test {
 protected:
  SyncedFile() { synced.clear(); }
  [[nodiscard]] static std::vector<std::filesystem::path> paths() {
    std::vector<std::filesystem::path> all;
    for (const Synced& call : synced) all.push_back(call.path);
    return all;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path root_ = std::filesystem::canonical(folder_.path());
};

}  // namespace
}  // namespace breccia

/// Goes before the C library's in this program: notes the call and does as that one does.
extern "C" int fsync(int descriptor) {
  const auto path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor));
  const auto folder = std::filesystem::is_directory(path) ? path : path.parent_path();
  breccia::synced.push_back({path, breccia::test::names_in(folder)});
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

namespace breccia {
namespace {

TEST_F(SyncedFile, IsOnTheDiskBeforeItHasItsNameAndItsFolderAfterwards) {
  write_file_atomically(folder_ / "x", std::string_view("content"));
  ASSERT_THAT(paths(), ElementsAre(root_ / ".x.tmp", root_));
  EXPECT_THAT(synced[0].names, ElementsAre(".x.tmp"));
  EXPECT_THAT(synced[1].names, ElementsAre("x"));
}

TEST_F(SyncedFile, IsOnTheDiskWithAllOfItsKindBeforeTheFirstHasItsName) {
  const std::string content = "content";
  std::ofstream(temporary_of(folder_ / "b")) << content;  // written already
  const std::vector<FileContent> files{{folder_ / "a", std::as_bytes(std::span(content))}, {folder_ / "b", {}}};
  write_files_atomically(files);
  ASSERT_THAT(paths(), ElementsAre(root_ / ".a.tmp", root_ / ".b.tmp", root_));
  EXPECT_THAT(synced[1].names, ElementsAre(".a.tmp", ".b.tmp"));
  EXPECT_THAT(synced[2].names, ElementsAre("a", "b"));
}

TEST_F(SyncedFile, OfLinesIsOnTheDiskWhenAskedFor) {
  LineFile file(folder_ / "lines");
  file.append_line("one");
  EXPECT_TRUE(synced.empty());
  file.sync();
  EXPECT_THAT(paths(), ElementsAre(root_ / "lines"));
}

TEST_F(SyncedFile, OfHistoryAndStatusIsOnTheDiskWhenARunEnds) {
  HistorySink history(folder_ / "history.csv");
  StatusSink status(folder_ / "status.jsonl");
  for (Sink* sink : {static_cast<Sink*>(&history), static_cast<Sink*>(&status)}) sink->start({});
  EXPECT_TRUE(synced.empty());
  for (Sink* sink : {static_cast<Sink*>(&history), static_cast<Sink*>(&status)}) sink->finish({});
  EXPECT_THAT(paths(), ElementsAre(root_ / "history.csv", root_ / "status.jsonl"));
}

}  // namespace
}  // namespace breccia
