#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>

#include "output/folder/history_sink.hpp"
#include "output/frames/vtkhdf_sink.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/synthetic_plate.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::killed_run_test {
namespace {

constexpr int kKills = 25;
constexpr int kMostKills = 20 * kKills;
constexpr useconds_t kLongestLife = 60000;  // us after the first frame: some more are written, not hundreds
constexpr useconds_t kLook = 1000;          // us between two looks for the first frame
constexpr int kLooks = 10000;               // ten seconds in all: a busy disk is no failure

/// Writes frames and history rows until it is killed.
[[noreturn]] void write_without_end(const test::TemporaryFolder& folder, Frame frame) {
  VtkhdfSink frames(folder.path());
  HistorySink history(folder / "history.csv");
  history.start({});
  for (frame.number = 0;; ++frame.number) {
    frame.time = static_cast<double>(frame.number);
    frames.frame(frame);
    HistoryRow row;
    row.step = frame.number;
    history.history(row);
  }
}

/// Every element file under its final name is whole, and the index names only such. Returns the frames in the index.
std::size_t check_frames(const test::TemporaryFolder& folder, const Frame& frame) {
  for (const std::string& name : test::names_in(folder.path())) {
    if (!name.starts_with("elements_")) continue;
    const test::Hdf5Reader grid(folder / name);
    EXPECT_EQ(grid.values("CellData/displacement").size(), frame.elements.displacement.size()) << name;
    EXPECT_EQ(grid.values("Points"), frame.elements.points) << name;
  }
  if (!std::filesystem::exists(folder / "elements.hdf.series")) return 0;
  const auto files = nlohmann::json::parse(test::content_of(folder / "elements.hdf.series")).at("files");
  for (const auto& entry : files) {
    EXPECT_EQ(test::Hdf5Reader(folder / entry.at("name")).values("FieldData/time").at(0), entry.at("time"));
  }
  return files.size();
}

/// Every line of the history has all its fields.
void check_history(const test::TemporaryFolder& folder) {
  const auto lines = test::lines_of(folder / "history.csv");
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(lines[0].begin(), lines[0].end(), ',')) << line;
  }
  const std::string text = test::content_of(folder / "history.csv");
  EXPECT_TRUE(text.empty() || text.back() == '\n');
}

TEST(KilledRun, LeavesOnlyWholeFilesAtWhateverInstantItDies) {
  const Frame frame = test::SyntheticPlate{.cubes = 12}.frame(0, 5e-5);
  std::mt19937 random(1);
  std::uniform_int_distribution<useconds_t> life(0, kLongestLife);
  std::size_t frames_kept = 0, killed_in_a_write = 0;
  // A slow build is between two writes for most of the time: it gets longer lives until one has ended in a write.
  for (int i = 0; i < kKills || (killed_in_a_write == 0 && i < kMostKills); ++i) {
    const test::TemporaryFolder folder;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_without_end(folder, frame);
    for (int look = 0; look < kLooks && !std::filesystem::exists(folder / "elements.hdf.series"); ++look)
      ::usleep(kLook);
    ::usleep(life(random) * static_cast<useconds_t>(1 + i / kKills));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    frames_kept += check_frames(folder, frame);
    if (std::filesystem::exists(folder / "history.csv")) check_history(folder);
    for (const std::string& name : test::names_in(folder.path())) killed_in_a_write += name.ends_with(".tmp") ? 1 : 0;
  }
  EXPECT_GT(frames_kept, 0u) << "every writer died before its first frame: nothing was shown";
  EXPECT_GT(killed_in_a_write, 0u) << "no writer died in a write: nothing was shown";
}

}  // namespace
}  // namespace breccia::killed_run_test
