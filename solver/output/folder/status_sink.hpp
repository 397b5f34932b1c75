#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "base/pace.hpp"
#include "output/sink.hpp"
#include "system/atomic_file.hpp"

namespace breccia {

/// Where a run stands.
enum class RunState { running, paused, complete, stopped, failed };
/// From Summary::status: "complete", "stopped..." or anything else, which is an error.
[[nodiscard]] RunState state_of(const Summary& summary);

/// One JSON object without line breaks: the members of StatusLine by name, "state", and "message" unless it is empty.
/// Numbers that are not finite and an unknown eta are null.
[[nodiscard]] std::string status_json(const StatusLine& line, RunState state, const std::string& message);

/// `status.jsonl`: one JSON line at the first step, about one every two seconds, and one at the end with the run's
/// state.
class StatusSink final : public Sink {
 public:
  explicit StatusSink(std::filesystem::path file, std::chrono::milliseconds interval = std::chrono::seconds(2));

  void start(const RunStart& run) override;
  void mark(OutputMarks& marks) const override;
  [[nodiscard]] bool status_due() const override { return pace_.due(); }
  /// Writes the line if it is due; keeps it for the end.
  void status(const StatusLine& line) override;
  /// Writes it at once: event_json.
  void event(const RunEvent& event) override;
  void finish(const Summary& summary) override;

 private:
  std::filesystem::path path_;
  std::optional<LineFile> file_;
  Pace pace_;
  StatusLine last_;
};

/// One JSON object without line breaks: the members of RunEvent by name, "event" being its kind; id only if there is
/// one.
[[nodiscard]] std::string event_json(const RunEvent& event);

enum class ProgressMode { none, bar, log, json };
/// A bar where it can be redrawn (descriptor is a terminal), else lines for a log.
[[nodiscard]] ProgressMode default_progress_mode(int descriptor);
/// Columns of the terminal behind the descriptor; 100 when it is none.
[[nodiscard]] int terminal_columns(int descriptor);

/// Wall time between two lines of a mode.
[[nodiscard]] std::chrono::milliseconds interval_of(ProgressMode mode);

/// One line of text for a log: share, step, time, speed, time to go, residual, joints, fragments, stage.
[[nodiscard]] std::string progress_text(const StatusLine& line);
/// The bar: at most `columns` characters, as much of the text as fits.
[[nodiscard]] std::string bar_text(const StatusLine& line, int columns);

/// Progress for the person or program that started the run: a bar redrawn in place five times a second, a line every
/// five seconds, or a JSON line (status_json) twice a second. A stream that fails is ignored: losing sight of a run
/// must not end it.
class ProgressSink final : public Sink {
 public:
  /// @pre stream outlives the sink
  ProgressSink(ProgressMode mode, std::ostream& stream, int columns = 100);

  [[nodiscard]] bool status_due() const override { return mode_ != ProgressMode::none && pace_.due(); }
  void status(const StatusLine& line) override;
  /// A line of its own, but for checkpoints that went well; warnings go to stderr in any mode but json.
  void event(const RunEvent& event) override;
  void finish(const Summary& summary) override;

 private:
  void show(const StatusLine& line, RunState state, const std::string& message);

  ProgressMode mode_;
  std::ostream& stream_;
  int columns_;
  Pace pace_;
  StatusLine last_;
};

}  // namespace breccia
