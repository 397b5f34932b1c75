#include "report/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
#include "system/regular_file.hpp"

namespace breccia::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Whole lines; whether something follows the last line feed is told.
std::vector<std::string_view> lines_of(std::string_view text, bool& cut) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  cut = !text.empty();
  return lines;
}

/// Cells of a line of CSV; quotes as RFC 4180.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

bool numbers_of(std::string_view line, std::vector<double>& row) {
  row.clear();
  for (const std::string& cell : cells_of(line)) {
    char* end = nullptr;
    row.push_back(std::strtod(cell.c_str(), &end));
    if (cell.empty() || *end != '\0') return false;
  }
  return true;
}

void read_history(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.history());
  if (!text) {
    record.flaws.emplace_back("history.csv is missing: there are no curves over time.");
    return;
  }
  bool cut = false;
  const std::vector<std::string_view> lines = lines_of(*text, cut);
  if (!lines.empty()) record.history.names = cells_of(lines.front());
  record.history.columns.resize(record.history.names.size());
  std::size_t left_out = cut ? 1 : 0;
  std::vector<double> row;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!numbers_of(lines[i], row) || row.size() != record.history.names.size()) {
      ++left_out;
      continue;
    }
    for (std::size_t c = 0; c < row.size(); ++c) record.history.columns[c].push_back(row[c]);
  }
  if (left_out > 0)
    record.flaws.push_back(fmt::format("history.csv: lines that are not whole are left out: {}.", left_out));
  if (record.history.rows() == 0) record.flaws.emplace_back("history.csv has no line yet.");
}

/// Names that are told for all bodies, in their order; else none.
void read_bodies(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.bodies());
  if (!text) return;
  bool cut = false;
  const std::vector<std::string_view> lines = lines_of(*text, cut);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i]);
    if (cells.size() != 2 || cells[0] != std::to_string(i - 1)) {
      record.flaws.emplace_back("bodies.csv is no list of names of bodies and is left out.");
      record.bodies.clear();
      return;
    }
    record.bodies.push_back(cells[1]);
  }
}

double number_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<double>() : kNoNumber;
}

std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void take_status(const Json& line, RunRecord& record) {
  if (line.contains("event")) {
    RunEvent event;
    event.kind = text_in(line, "event");
    event.text = text_in(line, "text");
    const auto accepted = line.find("accepted");
    event.accepted = accepted == line.end() || !accepted->is_boolean() || accepted->get<bool>();
    const double step = number_in(line, "step");
    event.step = std::isfinite(step) ? static_cast<std::int64_t>(step) : 0;
    event.time = number_in(line, "time");
    record.events.push_back(std::move(event));
    return;
  }
  record.state = text_in(line, "state");
  record.message = text_in(line, "message");
  const double wall = number_in(line, "wall_s");
  if (const double end = number_in(line, "end"); std::isfinite(end)) record.end = end;
  if (std::isfinite(wall)) record.status.push_back({wall, number_in(line, "time"), number_in(line, "imbalance")});
}

void read_status(const RunFolder& run, RunRecord& record) {
  const std::optional<std::string> text = regular_content(run.status());
  if (!text) {
    record.flaws.emplace_back("status.jsonl is missing: how the run ended is not known.");
    return;
  }
  bool cut = false;
  std::size_t left_out = 0;
  for (const std::string_view line : lines_of(*text, cut)) {
    const Json content = json_of_text<Json>(line);
    if (content.is_object())
      take_status(content, record);
    else
      ++left_out;
  }
  left_out += cut ? 1 : 0;
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

/// An object, or null with a flaw told. @param needed  its absence is a flaw
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
    const double value = number_in(content, name);
    return std::isfinite(value) ? static_cast<int>(value) : 0;
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

/// A run that was killed together with who watches over it still says that it goes on.
void settle_state(RunRecord& record) {
  if (record.state.empty()) record.state = "unknown";
  const bool alive = record.state == "running" || record.state == "paused";
  if (!alive || !holder_of(record.folder).empty()) return;
  record.state = "interrupted";
  record.message = "no process works on it any more, and none has told its end";
}

}  // namespace

const std::vector<double>& History::column(const std::string& name) const {
  static const std::vector<double> none;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return columns[i];
  }
  return none;
}

double History::last(const std::string& name) const {
  const std::vector<double>& values = column(name);
  return values.empty() ? kNoNumber : values.back();
}

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
