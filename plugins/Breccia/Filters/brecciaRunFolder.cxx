#include "brecciaRunFolder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "brecciaData.h"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Empty: no run.
fs::path FolderOf(const std::string& given) {
  std::error_code failed;
  const fs::path path(given);
  std::vector<fs::path> candidates{path, path.parent_path(), path.parent_path().parent_path()};
  for (const fs::path& folder : candidates) {
    if (!folder.empty() && fs::is_directory(fs::symlink_status(folder / "frames", failed)) &&
        fs::exists(folder / "history.csv", failed))
      return folder;
  }
  return {};
}

/// Whether a regular file stands there. The folder may be another's: a link could lead out of it, and a pipe or a device
/// would be read for ever.
bool IsPlain(const fs::path& path) {
  std::error_code failed;
  return fs::is_regular_file(fs::symlink_status(path, failed)) && !failed;
}

std::string ContentOf(const fs::path& path) {
  if (!IsPlain(path)) return {};
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// An HDF5 file that is as long as its superblock says (HDF5 File Format Specification, II.A).
bool IsWhole(const fs::path& path) {
  if (!IsPlain(path)) return false;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  std::array<char, 48> head{};
  std::ifstream file(path, std::ios::binary);
  if (failed || !file.read(head.data(), head.size())) return false;
  if (std::memcmp(head.data(), "\x89HDF\r\n\x1a\n", 8) != 0) return false;
  const bool early = head[8] <= 1;  // versions 0 and 1 have the sizes of addresses elsewhere
  if (head[early ? 13 : 9] != 8) return true;
  std::uint64_t end = 0;
  std::memcpy(&end, head.data() + (head[8] == 0 ? 40 : early ? 44 : 28), sizeof end);
  return end <= size;
}

/// The value behind `key` in an index that Breccia has written, from `from` on; empty at the end of the text.
std::string ValueOf(const std::string& text, const char* key, std::size_t& from) {
  const std::string quoted = "\"" + std::string(key) + "\"";
  from = text.find(quoted, from);
  if (from == std::string::npos) return {};
  from = text.find_first_not_of(" \t\r\n:", from + quoted.size());
  if (from == std::string::npos) return {};
  const bool is_text = text[from] == '"';
  const std::size_t begin = from + (is_text ? 1 : 0), end = text.find_first_of(is_text ? "\"" : ",}\r\n ", begin);
  if (end == std::string::npos) return {};
  from = end;
  return text.substr(begin, end - begin);
}

RecordedChannel ChannelOf(const fs::path& index, std::vector<std::string>& incomplete) {
  RecordedChannel channel;
  channel.name = index.filename().string();
  channel.name.erase(channel.name.find(".hdf.series"));
  const std::string text = ContentOf(index);
  std::size_t at = text.find("\"files\"");
  while (at != std::string::npos) {
    const std::string name = ValueOf(text, "name", at);
    if (name.empty()) break;
    const std::string time = ValueOf(text, "time", at);
    if (time.empty()) break;
    const fs::path file = index.parent_path() / name;
    if (!fs::path(name).has_parent_path() && IsWhole(file)) {
      channel.frames.push_back({std::strtod(time.c_str(), nullptr), file.string()});
    } else {
      incomplete.push_back(file.string());
    }
  }
  std::stable_sort(channel.frames.begin(), channel.frames.end(),
                   [](const FrameFile& a, const FrameFile& b) { return a.time < b.time; });
  return channel;
}

/// Cells of a line; those in quotes may hold commas, and quotes twice (RFC 4180).
std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
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
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "frames", failed)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > 11 && name.compare(name.size() - 11, 11, ".hdf.series") == 0) indices.push_back(entry.path());
  }
  if (indices.empty())
    throw BadInput((folder / "frames").string() +
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

HistoryColumns ReadHistory(const std::string& folder) {
  const fs::path path = fs::path(folder) / "history.csv";
  std::error_code failed;
  if (!fs::exists(path, failed)) throw BadInput("there is no " + path.string());
  if (!IsPlain(path)) throw BadInput(path.string() + " is no regular file");
  const std::string text = ContentOf(path);
  std::stringstream lines(text.substr(0, text.rfind('\n') + 1));
  HistoryColumns history;
  std::string line;
  if (std::getline(lines, line)) history.names = Split(line);
  history.values.resize(history.names.size());
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = Split(line);
    if (cells.size() != history.names.size()) {
      throw BadInput(path.string() + ":" + std::to_string(number) + ": " + std::to_string(cells.size()) +
                     " numbers for " + std::to_string(history.names.size()) + " columns");
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      char* end = nullptr;
      history.values[i].push_back(std::strtod(cells[i].c_str(), &end));
      if (end == cells[i].c_str())
        throw BadInput(path.string() + ":" + std::to_string(number) + ": '" + cells[i] + "' is no number");
    }
  }
  return history;
}

std::vector<std::string> ReadBodyNames(const std::string& folder) {
  std::stringstream file(ContentOf(fs::path(folder) / "bodies.csv"));
  std::vector<std::string> names;
  std::string line;
  if (!std::getline(file, line) || Split(line) != std::vector<std::string>{"body", "name"}) return {};
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = Split(line);
    if (cells.size() != 2 || cells[0] != std::to_string(names.size())) return {};
    names.push_back(cells[1]);
  }
  return names;
}

}  // namespace breccia
