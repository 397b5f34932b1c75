#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pace.hpp"

namespace breccia {

/// Request of a user or program to a running solver.
struct Command {
  enum class Kind { refused, pause, resume, stop, extract, frame, frame_interval, checkpoint };
  Kind kind = Kind::refused;
  double value = 0;       ///< frame_interval: s
  std::string text;       ///< as it was given, without the id
  std::string id;         ///< given by the sender, to identify the answer; may be empty
  std::string complaint;  ///< why it is refused
};

/// One line: "pause", "resume", "stop", "extract", "frame", "frame_interval 2 us",
/// "checkpoint", each perhaps with " id=WORD" at its end. Anything else is refused, with what is allowed.
[[nodiscard]] Command parse_command(std::string_view line);

/// Words that parse_command knows, for messages and help.
inline constexpr std::string_view kCommandWords =
    "pause, resume, stop, extract, frame, frame_interval TIME, checkpoint";

/// The file `control` in the folder of a run: users and programs append requests, one a line; the solver reads and
/// removes them, at most five times a second.
class ControlFile {
 public:
  explicit ControlFile(std::filesystem::path file) : path_(std::move(file)) {}

  /// The lines that have been written since, if any. Never throws: an unreadable file counts as empty.
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::filesystem::path path_;
  int num_left_ = 0;  ///< of what was taken and could not be removed
  Pace pace_{std::chrono::milliseconds(200)};
};

/// Whether a "stop" waits in the file, by which the run would end if it read it. Takes nothing, never throws;
/// for any thread.
[[nodiscard]] bool stop_waits(const std::filesystem::path& control_file);

/// Writes a command for the run in a folder and waits for the answer in its status.jsonl.
/// @param patience  s, wall
/// Throws OutputError when there is no such run, it has ended, it does not answer, or it refuses.
/// @return  the answer, in words
std::string ask_run(const std::filesystem::path& run_folder, const std::string& command, double patience);

}  // namespace breccia
