#include "brecciaRunFolder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include "brecciaData.h"
#include "run_folder/bodies.hpp"
#include "run_folder/content.hpp"
#include "run_folder/names.hpp"
#include "run_folder/series.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Empty: no run.
fs::path FolderOf(const std::string& given) {
  std::error_code failed;
  const fs::path path(given);
  std::vector<fs::path> candidates{path, path.parent_path(), path.parent_path().parent_path()};
  for (const fs::path& folder : candidates) {
    if (!folder.empty() && fs::is_directory(fs::symlink_status(folder / run_folder::kFrames, failed)) &&
        fs::exists(folder / run_folder::kHistory, failed))
      return folder;
  }
  return {};
}

/// Empty where there is no regular file: the folder may be another's.
std::string ContentOf(const fs::path& path, Depth depth) { return run_folder::read_content(path, depth).text; }

/// An HDF5 file of the length in its superblock (HDF5 File Format Specification, II.A).
bool IsWhole(const fs::path& path) {
  const Opened file = open_regular(path, O_RDONLY, Depth::subfolder);
  std::array<char, 48> head{};
  struct stat about {};
  if (!file || ::fstat(file.descriptor.get(), &about) != 0 ||
      ::pread(file.descriptor.get(), head.data(), head.size(), 0) != static_cast<ssize_t>(head.size()))
    return false;
  if (std::memcmp(head.data(), "\x89HDF\r\n\x1a\n", 8) != 0) return false;
  const bool early = head[8] <= 1;  // versions 0 and 1 have the sizes of addresses elsewhere
  if (head[early ? 13 : 9] != 8) return true;
  std::uint64_t end = 0;
  std::memcpy(&end, head.data() + (head[8] == 0 ? 40 : early ? 44 : 28), sizeof end);
  return end <= static_cast<std::uint64_t>(about.st_size);
}

RecordedChannel ChannelOf(const fs::path& index, std::vector<std::string>& incomplete) {
  RecordedChannel channel;
  channel.name = index.filename().string();
  channel.name.erase(channel.name.find(run_folder::kSeriesEnding));
  const run_folder::Series series = run_folder::parse_series(ContentOf(index, Depth::subfolder));
  for (const run_folder::SeriesFrame& frame : series.frames) {
    const fs::path file = index.parent_path() / frame.name;
    if (IsWhole(file)) {
      channel.frames.push_back({frame.time, file.string()});
    } else {
      incomplete.push_back(file.string());
    }
  }
  for (const std::string& name : series.refused) incomplete.push_back((index.parent_path() / name).string());
  std::stable_sort(channel.frames.begin(), channel.frames.end(),
                   [](const FrameFile& a, const FrameFile& b) { return a.time < b.time; });
  return channel;
}

}  // namespace

const FrameFile& RecordedChannel::At(double time) const {
  const double slack = 1e-12 * std::abs(time);
  const FrameFile* found = &frames.front();
  for (const FrameFile& frame : frames) {
    if (frame.time <= time + slack) found = &frame;
  }
  return *found;
}

std::vector<double> RunFolder::Times() const {
  std::vector<double> times;
  for (const RecordedChannel& channel : channels) {
    for (const FrameFile& frame : channel.frames) times.push_back(frame.time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

bool IsRun(const std::string& path) { return !FolderOf(path).empty(); }

RunFolder OpenRun(const std::string& path) {
  RunFolder run;
  const fs::path folder = FolderOf(path);
  if (folder.empty()) {
    throw BadInput(
        path + " is no Breccia run: neither it nor the folder it is in has a folder 'frames' and a file 'history.csv'");
  }
  run.path = folder.string();
  std::vector<fs::path> indices;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / run_folder::kFrames, failed)) {
    const std::string name = entry.path().filename().string();
    const std::size_t ending = run_folder::kSeriesEnding.size();
    if (name.size() > ending && name.compare(name.size() - ending, ending, run_folder::kSeriesEnding) == 0)
      indices.push_back(entry.path());
  }
  if (indices.empty())
    throw BadInput((folder / run_folder::kFrames).string() +
                   " has no index of frames (elements.hdf.series, joints.hdf.series, ...)");
  std::sort(indices.begin(), indices.end());
  for (const fs::path& index : indices) {
    RecordedChannel channel = ChannelOf(index, run.incomplete);
    if (!channel.frames.empty()) run.channels.push_back(std::move(channel));
  }
  std::stable_sort(run.channels.begin(), run.channels.end(), [](const RecordedChannel& a, const RecordedChannel& b) {
    return (a.name == "elements") > (b.name == "elements");
  });
  if (run.channels.empty()) {
    throw BadInput(
        "no frame of " + run.path + " is whole" +
        (run.incomplete.empty() ? "" : ": " + run.incomplete.front() + " is missing, cut off or no HDF5 file"));
  }
  return run;
}

run_folder::History ReadHistory(const std::string& folder) {
  const fs::path path = fs::path(folder) / run_folder::kHistory;
  const run_folder::Content content = run_folder::read_content(path);
  if (content.is_missing) throw BadInput("there is no " + path.string());
  if (!content.problem.empty()) throw BadInput(path.string() + " " + content.problem);
  run_folder::HistoryText read = run_folder::parse_history(content.text);
  if (read.num_left_out > 0)
    throw BadInput(path.string() + ":" + std::to_string(read.first_left_out) + ": " + read.problem);
  return std::move(read.history);
}

std::vector<std::string> ReadBodyNames(const std::string& folder) {
  const fs::path path = fs::path(folder) / run_folder::kBodies;
  return run_folder::parse_bodies(ContentOf(path, Depth::file)).value_or(std::vector<std::string>());
}

}  // namespace breccia
