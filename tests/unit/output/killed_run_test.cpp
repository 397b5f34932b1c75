#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "output/history_sink.hpp"
#include "output/vtkhdf_sink.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/synthetic_plate.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia {
namespace {

constexpr int kKills = 25;

/// Writes frames and history rows until it is killed.
[[noreturn]] void write_without_end(const test::TemporaryFolder& folder, Frame frame) {
  VtkhdfSink frames(folder.path());
  HistorySink history(folder / "history.csv");
  history.start(RunStart{});
  for (frame.number = 0;; ++frame.number) {
    frame.time = static_cast<double>(frame.number);
    frames.frame(frame);
    HistoryRow row;
    row.time = frame.time;
    history.history(row);
  }
}

/// Number of frames in an index; each of them must be whole and carry the time the index gives it.
std::size_t check_index(const test::TemporaryFolder& folder, const std::string& part, std::size_t cells) {
  const std::filesystem::path path = folder / (part + ".hdf.series");
  if (!std::filesystem::exists(path)) return 0;
  const nlohmann::json index = nlohmann::json::parse(test::content_of(path));
  for (const nlohmann::json& entry : index["files"]) {
    const test::Hdf5Reader file(folder / entry["name"].get<std::string>());
    EXPECT_EQ(file.values("VTKHDF/FieldData/time"), std::vector<double>{entry["time"].get<double>()});
    EXPECT_EQ(file.values("VTKHDF/CellData/body").size(), cells);
    EXPECT_EQ(file.values("VTKHDF/Types").size(), cells);
  }
  return index["files"].size();
}

/// Also frames that no index lists yet are whole under their final names.
void check_frame_files(const test::TemporaryFolder& folder) {
  for (const std::string& name : test::names_in(folder.path())) {
    if (name.starts_with(".") || !name.ends_with(".vtkhdf")) continue;
    EXPECT_NO_THROW(static_cast<void>(test::Hdf5Reader(folder / name).values("VTKHDF/FieldData/time"))) << name;
  }
}

void check_history(const test::TemporaryFolder& folder) {
  const std::string text = test::content_of(folder / "history.csv");
  if (text.empty()) return;
  EXPECT_EQ(text.back(), '\n') << "a part of a line";
  const std::vector<std::string> lines = test::lines_of(folder / "history.csv");
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(lines[0].begin(), lines[0].end(), ','));
  }
}

TEST(KilledRun, LeavesReadableFilesOnly) {
  test::SyntheticPlate plate;
  plate.cubes = 8;
  const Frame frame = plate.frame(0, plate.end);
  std::size_t frames = 0;
  int caught_writing = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    const test::TemporaryFolder folder;
    const pid_t writer = ::fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) write_without_end(folder, frame);
    std::this_thread::sleep_for(std::chrono::microseconds(20000 + 3700 * kill));
    ::kill(writer, SIGKILL);
    int status = 0;
    ::waitpid(writer, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    frames += check_index(folder, "elements", frame.elements.id.size());
    frames += check_index(folder, "contacts", frame.contacts.body.size());
    check_frame_files(folder);
    check_history(folder);
    for (const std::string& name : test::names_in(folder.path())) caught_writing += name.ends_with(".tmp") ? 1 : 0;
  }
  EXPECT_GT(frames, 0u) << "no frame was ever complete: the test has shown nothing";
  EXPECT_GT(caught_writing, 0) << "never killed in the middle of a file: the test has shown nothing";
}

}  // namespace
}  // namespace breccia
