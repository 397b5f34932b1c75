#include "output/folder/status_sink.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/printable.hpp"
#include "base/quantity_text.hpp"

namespace breccia {
namespace {

constexpr int kUsualColumns = 100;
constexpr int kBarWidth = 24;

const char* name_of(RunState state) {
  switch (state) {
    case RunState::running:
      return "running";
    case RunState::paused:
      return "paused";
    case RunState::complete:
      return "complete";
    case RunState::stopped:
      return "stopped";
    case RunState::failed:
      break;
  }
  return "failed";
}

/// The last line of a run: where it was when it ended.
StatusLine last_line(StatusLine line, const Summary& summary) {
  line.step = summary.steps;
  line.time = summary.simulated_time;
  line.wall_s = summary.wall_s;
  line.element_steps_per_s = summary.element_steps_per_s;
  line.energy_residual = summary.energy.residual_relative;
  line.broken_joints = summary.broken_joints;
  line.fragments = summary.fragments;
  line.eta_s = 0;
  if (state_of(summary) == RunState::complete) {
    line.share = 1;
    line.steps_total = summary.steps;
  }
  return line;
}

/// Message of finish beyond the state.
std::string message_of(const Summary& summary) { return state_of(summary) == RunState::complete ? "" : summary.status; }

RunState state_now(const StatusLine& line) { return line.paused ? RunState::paused : RunState::running; }

double percent(const StatusLine& line) { return 100 * std::clamp(line.share, 0.0, 1.0); }

}  // namespace

RunState state_of(const Summary& summary) {
  if (summary.status == "complete") return RunState::complete;
  return summary.status.starts_with("stopped") ? RunState::stopped : RunState::failed;
}

std::string status_json(const StatusLine& line, RunState state, const std::string& message) {
  nlohmann::ordered_json json;
  json["state"] = name_of(state);
  json["stage"] = line.stage;
  json["step"] = line.step;
  json["steps_total"] = line.steps_total;
  json["time"] = line.time;
  json["end"] = line.end;
  json["share"] = line.share;
  json["element_steps_per_s"] = line.element_steps_per_s;
  json["wall_s"] = line.wall_s;
  if (line.eta_s >= 0) {
    json["eta_s"] = line.eta_s;
  } else {
    json["eta_s"] = nullptr;
  }
  json["energy_residual"] = line.energy_residual;
  json["imbalance"] = line.imbalance;
  json["decompositions"] = line.decompositions;
  json["broken_joints"] = line.broken_joints;
  json["fragments"] = line.fragments;
  if (!message.empty()) json["message"] = message;
  // Names come from the user's files: bytes that are not UTF-8 are replaced, not thrown at.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string event_json(const RunEvent& event) {
  nlohmann::ordered_json json;
  json["event"] = event.kind;
  json["step"] = event.step;
  json["time"] = event.time;
  json["accepted"] = event.accepted;
  json["text"] = event.text;
  if (!event.id.empty()) json["id"] = event.id;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

StatusSink::StatusSink(std::filesystem::path file, std::chrono::milliseconds interval)
    : path_(std::move(file)), pace_(interval) {}

void StatusSink::start(const RunStart& run) {
  file_.emplace(path_, run.marks ? static_cast<std::size_t>(run.marks->status_bytes) : 0);
}

void StatusSink::mark(OutputMarks& marks) const {
  if (file_) marks.status_bytes = static_cast<std::int64_t>(file_->size());
}

void StatusSink::status(const StatusLine& line) {
  last_ = line;
  if (!file_ || !pace_.due()) return;
  pace_.done();
  file_->append_line(status_json(line, state_now(line), ""));
}

void StatusSink::event(const RunEvent& event) {
  if (file_) file_->append_line(event_json(event));
}

void StatusSink::finish(const Summary& summary) {
  if (!file_) return;
  file_->append_line(status_json(last_line(last_, summary), state_of(summary), message_of(summary)));
  file_->sync();
}

ProgressMode default_progress_mode(int descriptor) {
  // A launcher of ranks may give them a terminal of its own, and send what they write there to a file.
  for (const char* launched : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
    if (std::getenv(launched) != nullptr) return ProgressMode::log;
  }
  return ::isatty(descriptor) == 1 ? ProgressMode::bar : ProgressMode::log;
}

int terminal_columns(int descriptor) {
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
  return size.ws_col;
}

std::chrono::milliseconds interval_of(ProgressMode mode) {
  using namespace std::chrono_literals;
  return mode == ProgressMode::bar ? 200ms : mode == ProgressMode::json ? 500ms : 5000ms;
}

std::string progress_text(const StatusLine& line) {
  std::string text = fmt::format(
      "{:5.1f} %  step {} of {}  {} of {}  {}  {} to go  residual {:.1e}", percent(line), count_text(line.step),
      count_text(line.steps_total), quantity_text(line.time, "s"), quantity_text(line.end, "s"),
      quantity_text(line.element_steps_per_s, "element-steps/s"), duration_text(line.eta_s), line.energy_residual);
  text += fmt::format("  broken joints {}  fragments {}", count_text(line.broken_joints), count_text(line.fragments));
  if (!line.stage.empty()) text += fmt::format("  [{}]", printable(line.stage));
  return text;
}

std::string bar_text(const StatusLine& line, int columns) {
  const int filled = std::isfinite(line.share) ? static_cast<int>(percent(line) / 100 * kBarWidth) : 0;
  std::string text = fmt::format("[{:#<{}}{:.<{}}] {:5.1f} %  {}  {}  {} to go  {} broken, {} fragments", "", filled,
                                 "", kBarWidth - filled, percent(line), quantity_text(line.time, "s"),
                                 quantity_text(line.element_steps_per_s, "element-steps/s"), duration_text(line.eta_s),
                                 count_text(line.broken_joints), count_text(line.fragments));
  if (!line.stage.empty()) text += fmt::format("  [{}]", printable(line.stage));
  // A line as long as the terminal would wrap, and a wrapped line cannot be redrawn.
  text.resize(std::min(text.size(), static_cast<std::size_t>(std::max(columns - 1, 1))));
  return text;
}

ProgressSink::ProgressSink(ProgressMode mode, std::ostream& stream, int columns)
    : mode_(mode), stream_(stream), columns_(columns), pace_(interval_of(mode)) {}

void ProgressSink::status(const StatusLine& line) {
  last_ = line;
  if (!status_due()) return;
  pace_.done();
  show(line, state_now(line), "");
}

void ProgressSink::event(const RunEvent& event) {
  if (mode_ == ProgressMode::json) {
    stream_ << event_json(event) << '\n' << std::flush;
  } else if (!event.accepted) {
    std::cerr << (mode_ == ProgressMode::bar ? "\n" : "") << "breccia: warning: " << printable_lines(event.text)
              << '\n';
  } else if (mode_ != ProgressMode::none && event.kind != "checkpoint") {
    stream_ << (mode_ == ProgressMode::bar ? "\r\033[K" : "") << printable_lines(event.text) << '\n' << std::flush;
  }
}

void ProgressSink::finish(const Summary& summary) {
  show(last_line(last_, summary), state_of(summary), message_of(summary));
}

void ProgressSink::show(const StatusLine& line, RunState state, const std::string& message) {
  constexpr const char* redraw = "\r\033[K";
  const bool goes_on = state == RunState::running || state == RunState::paused;
  const std::string ending = state == RunState::running ? "" : fmt::format("  {}", name_of(state));
  switch (mode_) {
    case ProgressMode::none:
      return;
    case ProgressMode::bar:
      stream_ << redraw << bar_text(line, columns_) << (goes_on ? "" : "\n") << std::flush;
      return;
    case ProgressMode::log:
      stream_ << progress_text(line) << ending << '\n' << std::flush;
      return;
    case ProgressMode::json:
      stream_ << status_json(line, state, message) << '\n' << std::flush;
      return;
  }
}

}  // namespace breccia
