#include "output/folder/run_diff.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "case/reader_toml.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/json_text.hpp"
#include "output/folder/run_folder.hpp"
#include "run_folder/csv.hpp"
#include "run_folder/lines.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;
using Values = std::map<std::string, std::string>;  // path of a value to its text
using Json = nlohmann::json;

constexpr const char* kNone = "(none)";
constexpr std::size_t kColumnsNamed = 8;

void flatten(const case_::Node& node, const std::string& path, Values& out) {
  for (const auto& [name, value] : node.entries) flatten(value, path.empty() ? name : path + "." + name, out);
  const bool of_tables = !node.items.empty() && node.items.front().is(case_::Node::Kind::table);
  for (std::size_t i = 0; of_tables && i < node.items.size(); ++i)
    flatten(node.items[i], path + "[" + std::to_string(i) + "]", out);
  if (!of_tables && !node.is(case_::Node::Kind::table)) out[path] = node.shown();
}

/// Hashes of inputs, each by its place relative to the case, wherever the program was called and however they were
/// named.
void flatten_inputs(const Json& inputs, Values& out) {
  std::vector<std::pair<fs::path, std::string>> files;
  fs::path folder;
  for (const Json& input : inputs) {
    files.emplace_back(fs::path(input.value("file", "")).lexically_normal(), input.value("sha256", ""));
    if (files.back().first.extension() == ".toml") folder = files.back().first.parent_path();
  }
  for (const auto& [file, hash] : files) {
    const fs::path relative = folder.empty() ? file : file.lexically_relative(folder);
    out["input " + (relative.empty() ? file : relative).string()] = hash;
  }
}

void flatten(const Json& node, const std::string& path, Values& out) {
  if (node.is_object()) {
    for (const auto& [name, value] : node.items()) flatten(value, path.empty() ? name : path + "." + name, out);
  } else if (node.is_array() && path == "inputs") {
    flatten_inputs(node, out);
  } else if (node.is_array() && (path == "parents" || path == "conditions")) {
    for (std::size_t i = 0; i < node.size(); ++i) flatten(node[i], path + "[" + std::to_string(i) + "]", out);
  } else if (node.is_string()) {
    out[path] = node.get<std::string>();
  } else {
    out[path] = node.dump();
  }
}

Values case_of(const RunFolder& run) {
  Values values;
  flatten(case_::parse_toml_file(run.case_file()), "", values);
  return values;
}

Values json_of(const fs::path& file, const std::set<std::string>& left_out) {
  Values values;
  const auto content = json_of_file<Json>(file);
  if (content.is_object()) {
    Json kept = content;
    for (const std::string& name : left_out) kept.erase(name);
    flatten(kept, "", values);
  }
  return values;
}

/// Lines "  path: a | b" of what differs.
std::string differences(const Values& a, const Values& b) {
  std::string text;
  std::set<std::string> paths;
  for (const auto& [path, value] : a) paths.insert(path);
  for (const auto& [path, value] : b) paths.insert(path);
  for (const std::string& path : paths) {
    const auto one = a.find(path), other = b.find(path);
    const std::string left = one == a.end() ? kNone : one->second, right = other == b.end() ? kNone : other->second;
    if (left != right) text += "  " + path + ": " + left + " | " + right + "\n";
  }
  return text;
}

std::string part(const std::string& title, const std::string& lines) {
  return title + (lines.empty() ? ": the same\n" : "\n" + lines);
}

/// How searches were timed, and time itself, are no results.
bool counts(const std::string& column) { return column != "couples" && column.find("in situ") == std::string::npos; }

std::string history_part(const fs::path& first, const fs::path& second) {
  RegularStream a(first), b(second);
  std::string head_a, head_b, line_a, line_b;
  // A row that a run is still writing, or was killed in, is none.
  (void)run_folder::next_whole_line(a, head_a);
  (void)run_folder::next_whole_line(b, head_b);
  if (head_a != head_b) return "  the columns differ\n";
  const std::vector<std::string> columns = run_folder::fields_of(head_a);
  for (std::size_t line = 2;; ++line) {
    const bool more_a = run_folder::next_whole_line(a, line_a), more_b = run_folder::next_whole_line(b, line_b);
    if (!more_a && !more_b) return {};
    if (more_a != more_b)
      return "  the " + std::string(more_a ? "second" : "first") + " ends before line " + std::to_string(line) + "\n";
    if (line_a == line_b) continue;
    const std::vector<std::string> left = run_folder::fields_of(line_a), right = run_folder::fields_of(line_b);
    std::string found;
    std::size_t named = 0;
    for (std::size_t c = 0; c < std::min({columns.size(), left.size(), right.size()}); ++c) {
      if (left[c] == right[c] || !counts(columns[c]) || ++named > kColumnsNamed) continue;
      found += "    " + columns[c] + ": " + left[c] + " | " + right[c] + "\n";
    }
    if (named > kColumnsNamed) found += "    and " + std::to_string(named - kColumnsNamed) + " more columns\n";
    if (!found.empty()) return "  they part in line " + std::to_string(line) + ", step " + left[0] + "\n" + found;
  }
}

}  // namespace

std::string diff_runs(const fs::path& first, const fs::path& second) {
  const RunFolder a{first}, b{second};
  for (const RunFolder* run : {&a, &b}) {
    demand_plain_folder(*run);
    if (!fs::exists(run->provenance()) || !fs::exists(run->case_file()))
      throw OutputError(
          Problem{run->root.string(), 0, "", "is no folder of a run", "two folders that `run` has made", ""});
  }
  const std::set<std::string> of_a_run{"run", "started", "command_line"};
  // Beside timings: extremes of gauges, whose columns the history compares.
  const std::set<std::string> left_out{
      "wall_s",      "element_steps_per_s", "phases",         "max_rss_bytes", "imbalance",
      "messages",    "message_bytes",       "decompositions", "searches",      "insitu",
      "checkpoints", "since_resume",        "gauges"};
  return part("case", differences(case_of(a), case_of(b))) +
         part("inputs, versions, machine",
              differences(json_of(a.provenance(), of_a_run), json_of(b.provenance(), of_a_run))) +
         part("results", differences(json_of(a.summary(), left_out), json_of(b.summary(), left_out))) +
         part("history", history_part(a.history(), b.history()));
}

}  // namespace breccia
