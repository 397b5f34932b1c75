#include "report/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "case/groups.hpp"
#include "case/reader.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/json_text.hpp"
#include "output/folder/run_lock.hpp"
#include "report/figures.hpp"
#include "run_folder/bodies.hpp"
#include "run_folder/lines.hpp"
#include "run_folder/status.hpp"
#include "system/regular_file.hpp"

namespace breccia::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using run_folder::text_in;

void read_history(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.history());
  if (!text) {
    record.flaws.emplace_back("history.csv is missing: there are no curves over time.");
    return;
  }
  run_folder::HistoryText read = run_folder::parse_history(*text);
  record.history = std::move(read.history);
  const std::size_t left_out = read.num_left_out + (read.is_cut ? 1 : 0);
  if (left_out > 0)
    record.flaws.push_back(fmt::format("history.csv: lines that are not whole are left out: {}.", left_out));
  if (record.history.rows() == 0) record.flaws.emplace_back("history.csv has no line yet.");
}

/// Names if given for all bodies, in their order; else none.
void read_bodies(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.bodies());
  if (!text) return;
  if (auto names = run_folder::parse_bodies(*text))
    record.bodies = std::move(*names);
  else
    record.flaws.emplace_back("bodies.csv is no list of names of bodies and is left out.");
}

void take_status(run_folder::StatusLine line, RunRecord& record) {
  if (line.event) {
    run_folder::Event& event = *line.event;
    record.events.push_back({std::move(event.kind), std::move(event.text), std::move(event.id),
                             event.accepted.value_or(true), event.step, event.time});
  }
  if (!line.status) return;
  const run_folder::Status& status = *line.status;
  record.state = status.state;
  record.message = status.message;
  if (std::isfinite(status.end)) record.end = status.end;
  if (std::isfinite(status.wall)) record.status.push_back({status.wall, status.time, status.imbalance});
}

void read_status(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.status());
  if (!text) {
    record.flaws.emplace_back("status.jsonl is missing: the end of the run is unknown.");
    return;
  }
  const run_folder::WholeLines found = run_folder::whole_lines(*text);
  std::size_t left_out = found.is_cut ? 1 : 0;
  for (const std::string_view text_line : found.lines) {
    run_folder::StatusLine line = run_folder::parse_status_line(text_line);
    left_out += line.is_whole ? 0 : 1;
    take_status(std::move(line), record);
  }
  if (left_out > 0)
    record.flaws.push_back(fmt::format("status.jsonl: lines that are not whole are left out: {}.", left_out));
}

void flatten(const Json& node, const std::string& path, RunRecord& record) {
  if (node.is_object()) {
    for (const auto& [name, value] : node.items()) flatten(value, path.empty() ? name : path + "." + name, record);
  } else if (node.is_number()) {
    record.numbers[path] = node.get<double>();
    if (path.starts_with("phases.")) record.phases.emplace_back(path.substr(7), node.get<double>());
  } else if (node.is_string()) {
    record.words[path] = node.get<std::string>();
  }
}

/// An object, or null with a reported flaw. @param needed  its absence is a flaw
Json object_in(const fs::path& file, bool needed, RunRecord& record) {
  const std::optional<std::string> text = regular_content(file);
  if (!text) {
    if (needed) record.flaws.push_back(file.filename().string() + " is missing.");
    return {};
  }
  Json content = json_of_text<Json>(*text);
  if (content.is_object()) return content;
  record.flaws.push_back(file.filename().string() + " is not whole and is left out.");
  return {};
}

void read_provenance(const RunFolder& run, RunRecord& record) {
  const Json content = object_in(run.provenance(), true, record);
  if (!content.is_object()) return;
  Provenance& p = record.provenance;
  for (const auto& [name, member] : {std::pair{"version", &p.version},
                                     {"commit", &p.commit},
                                     {"libraries", &p.libraries},
                                     {"host", &p.host},
                                     {"processor", &p.processor},
                                     {"compiler", &p.compiler},
                                     {"flags", &p.flags},
                                     {"started", &p.started}})
    *member = text_in(content, name);
  const auto count = [&](const char* name) {
    constexpr std::int64_t kMost = std::numeric_limits<int>::max();
    return static_cast<int>(std::clamp<std::int64_t>(run_folder::whole_number_in(content, name), 0, kMost));
  };
  p.ranks = count("ranks");
  p.cores = count("cores");
  if (const auto words = content.find("command_line"); words != content.end() && words->is_array()) {
    for (const Json& word : *words) {
      if (word.is_string()) p.command_line.push_back(word.get<std::string>());
    }
  }
  if (const auto inputs = content.find("inputs"); inputs != content.end() && inputs->is_array()) {
    for (const Json& input : *inputs) {
      if (input.is_object()) p.inputs.push_back({text_in(input, "file"), text_in(input, "sha256")});
    }
  }
}

/// Of the largest component, or 0. @param offer  component by axis
char axis_of(const double (&offer)[3]) {
  char axis = 0;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(offer[i]) > largest)) continue;
    largest = std::abs(offer[i]);
    axis = static_cast<char>('x' + i);
  }
  return axis;
}

void read_case_of(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.case_file());
  if (!text) {
    record.flaws.emplace_back("case.toml is missing.");
    return;
  }
  record.case_text = *text;
  try {
    case_::Case input =
        case_::read_case_text(*text, run.case_file(), {}, case_::MeshFile::may_be_gone);  // nothing is read from it
    record.title = input.title;
    record.materials = std::move(input.materials);
    record.joints = std::move(input.joints);
    record.contacts = std::move(input.contacts);
    double gravity[3]{}, velocity[3]{};
    for (const case_::Stage& stage : input.stages) {
      for (std::size_t i = 0; i < 3; ++i) gravity[i] += stage.gravity[i](0.0);
    }
    for (const auto& initial : input.initial_velocities) {
      for (std::size_t i = 0; i < 3; ++i)
        velocity[i] = std::max(velocity[i], std::abs(initial.velocity[static_cast<int>(i)]));
    }
    const char down = axis_of(gravity), fastest = axis_of(velocity);
    if (down != 0)
      record.up = down;
    else if (fastest != 0)
      record.up = fastest;
  } catch (const InputError& error) {
    const Problem& first = error.problems().front();
    record.flaws.push_back("case.toml is shown as it is: " + (first.key.empty() ? "" : first.key + ": ") + first.what +
                           (first.given.empty() ? "" : ", " + first.given) + ".");
  }
}

/// The status of a run that was killed together with its watch is still "running".
void settle_state(RunRecord& record) {
  if (record.state.empty()) record.state = "unknown";
  const bool alive = record.state == "running" || record.state == "paused";
  if (!alive || !holder_of(record.folder).empty()) return;
  record.state = "interrupted";
  record.message = "its process has ended without a final status";
}

}  // namespace

double RunRecord::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? kNoNumber : found->second;
}

std::string RunRecord::body_name(double number) const {
  constexpr double kMostBodies = 2147483647;  // their numbers have 32 bits
  if (!(number >= 0 && number <= kMostBodies)) return {};
  const auto body = static_cast<std::size_t>(number);
  return body < bodies.size() ? bodies[body] : "body " + std::to_string(body);
}

std::string RunRecord::gauge_label(const std::string& gauge) const {
  const std::int64_t body = case_::numbered_body(gauge);
  const bool is_group = std::find(bodies.begin(), bodies.end(), gauge) != bodies.end();
  if (body < 0 || is_group || static_cast<std::size_t>(body) >= bodies.size()) return gauge;
  const std::string& name = bodies[static_cast<std::size_t>(body)];
  return name.find(gauge) == std::string::npos ? name + " (" + gauge + ")" : name;
}

RunRecord read_run(const fs::path& folder) {
  const RunFolder run{folder};
  std::error_code error;
  if (!fs::is_directory(folder, error) || (!fs::exists(run.provenance(), error) && !fs::exists(run.history(), error)))
    throw OutputError(Problem{folder.string(), 0, "", "is no folder of a run",
                              "a folder that `breccia run` has made, with provenance.json and history.csv in it", ""});
  demand_plain_folder(run);
  RunRecord record;
  record.folder = folder;
  read_provenance(run, record);
  read_case_of(run, record);
  read_status(run, record);
  settle_state(record);
  read_bodies(run, record);
  read_history(run, record);
  const bool ended = record.state == "complete" || record.state == "stopped" || record.state == "failed";
  flatten(object_in(run.summary(), ended, record), "", record);
  if (const auto title = record.words.find("title"); title != record.words.end()) record.title = title->second;
  return record;
}

}  // namespace breccia::report
