#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "run_folder/lines.hpp"
#include "system/open_regular.hpp"

namespace breccia::run_folder {

/// Bytes at the end of status.jsonl in which its last state stands.
inline constexpr std::int64_t kStatusTail = 1 << 16;

/// Whole lines of a file of a run's folder that grows; a line that is half written waits for its end. A call reads a
/// few thousand lines at most, so that it does not block a window.
class GrowingLines {
 public:
  static constexpr std::int64_t kFromStart = -1;

  /// @param tail  bytes before the end at which the first call begins, with the next whole line
  explicit GrowingLines(std::filesystem::path path = {}, std::int64_t tail = kFromStart)
      : path_(std::move(path)), tail_(tail) {}

  struct News {
    std::vector<std::string> lines;
    bool is_restarted = false;  ///< the file has become shorter, or is another one than before: it is read anew
  };
  /// Lines that were added since the last call. Throws nothing but std::bad_alloc.
  [[nodiscard]] News news() {
    News found;
    has_more_ = false;
    const Opened file = open_regular(path_, O_RDONLY, Depth::file);
    struct stat about {};
    if (!file || ::fstat(file.descriptor.get(), &about) != 0) return found;
    const auto size = static_cast<std::uint64_t>(about.st_size);
    if (read_ > 0) {
      const bool same = size >= read_ && bytes_from(file.descriptor, read_ - last_.size(), last_.size()) == last_;
      found.is_restarted = !same;
      if (!same) read_ = 0;
    }
    const std::uint64_t tail = static_cast<std::uint64_t>(std::max<std::int64_t>(tail_, 0));
    if (read_ == 0 && tail_ >= 0 && size > tail && !skip_to_line(file.descriptor, size - tail)) return found;
    take_lines(file.descriptor, found.lines);
    has_more_ = !found.lines.empty() && read_ < size;
    return found;
  }
  /// The file had more than the last call returned.
  [[nodiscard]] bool has_more() const { return has_more_; }

 private:
  static constexpr std::size_t kMostAtOnce = 1 << 20;    // bytes
  static constexpr std::size_t kLongestLine = 64 << 20;  // bytes; a file with a longer line is none that a run writes
  static constexpr std::size_t kRemembered = 64;         // bytes

  /// Sets read_ to the first line that begins at `begin` or behind it.
  bool skip_to_line(const Descriptor& file, std::uint64_t begin) {
    const std::string bytes = bytes_from(file, begin - 1, kLongestLine);
    const std::size_t end = bytes.find('\n');
    if (end == std::string::npos) return false;
    read_ = begin + end;
    last_.clear();
    return true;
  }

  void take_lines(const Descriptor& file, std::vector<std::string>& lines) {
    std::string bytes = bytes_from(file, read_, kMostAtOnce);
    std::size_t end = bytes.rfind('\n');
    if (end == std::string::npos && bytes.size() == kMostAtOnce) {  // one line that is longer than all that
      bytes = bytes_from(file, read_, kLongestLine);
      end = bytes.find('\n');
    }
    if (end == std::string::npos) return;
    bytes.resize(end + 1);
    for (const std::string_view line : whole_lines(bytes).lines) lines.emplace_back(line);
    read_ += bytes.size();
    last_ = bytes.substr(bytes.size() - std::min(bytes.size(), kRemembered));
  }

  std::filesystem::path path_;
  std::int64_t tail_;
  std::uint64_t read_ = 0;
  std::string last_;  ///< bytes before read_: a file in which others stand there is another one
  bool has_more_ = false;
};

}  // namespace breccia::run_folder
