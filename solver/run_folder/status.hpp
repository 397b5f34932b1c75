#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "run_folder/json_text.hpp"

namespace breccia::run_folder {

/// A line of status.jsonl with the progress of the run. Missing numbers are NaN.
struct Status {
  std::string state;  ///< running, paused, complete, stopped, failed, interrupted
  std::string stage, message;
  double step = 0, steps_total = 0;
  double time = 0, end = 0;  ///< s, simulated
  double share = 0;          ///< 0..1
  double wall = 0, eta = 0;  ///< s
  double energy_residual = 0, element_steps_per_s = 0, imbalance = 0;
  double broken_joints = 0, fragments = 0;
};

/// A line of status.jsonl about something that happened: an answer to a command, a checkpoint, ...
struct Event {
  std::string kind, text;
  std::string id;                ///< of the command that it answers; empty: none
  std::optional<bool> accepted;  ///< nullopt: not stated
  std::int64_t step = 0;
  double time = 0;  ///< s, simulated; NaN: not stated
};

/// One of both, or neither for a line of another kind.
struct StatusLine {
  bool is_whole = false;  ///< a JSON object; false: left out
  std::optional<Status> status;
  std::optional<Event> event;
};

/// True for a state that no other one follows.
[[nodiscard]] inline bool is_end(std::string_view state) {
  return state == "complete" || state == "stopped" || state == "failed" || state == "interrupted";
}

/// Throws nothing but std::bad_alloc, for any content.
[[nodiscard]] inline StatusLine parse_status_line(std::string_view line) {
  const auto json = json_of_text<nlohmann::json>(line);
  StatusLine read;
  read.is_whole = json.is_object();
  if (!read.is_whole) return read;
  if (json.contains("event")) {
    Event& event = read.event.emplace();
    event.kind = text_in(json, "event");
    event.text = text_in(json, "text");
    event.id = text_in(json, "id");
    if (const auto found = json.find("accepted"); found != json.end() && found->is_boolean())
      event.accepted = found->get<bool>();
    event.step = whole_number_in(json, "step");
    event.time = number_in(json, "time");
  } else if (json.contains("state")) {
    const auto number = [&](const char* name) { return number_in(json, name); };
    read.status = Status{text_in(json, "state"), text_in(json, "stage"),    text_in(json, "message"),
                         number("step"),         number("steps_total"),     number("time"),
                         number("end"),          number("share"),           number("wall_s"),
                         number("eta_s"),        number("energy_residual"), number("element_steps_per_s"),
                         number("imbalance"),    number("broken_joints"),   number("fragments")};
  }
  return read;
}

}  // namespace breccia::run_folder
