#include "output/insitu/extracts_cut.hpp"

#include <cerrno>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "output/folder/folder_tree.hpp"
#include "run_folder/csv.hpp"
#include "run_folder/lines.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// The step in a name, behind its last underscore: nine digits or more.
std::optional<std::int64_t> step_of(const std::string& name) {
  static const std::regex pattern(R"(_(\d{9,18})(\D.*)?$)");
  std::smatch match;
  if (!std::regex_search(name, match, pattern)) return std::nullopt;
  return std::stoll(match[1].str());
}

/// The header of a table and its rows before a step; nothing where the header itself is not whole.
std::string table_before(std::string_view text, std::int64_t step) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return {};
  const std::string_view header = text.substr(0, end);
  return std::string(header) + '\n' + run_folder::rows_before(text, header, step);
}

/// Steps at which pipelines wrote, from `step` on.
std::set<std::int64_t> steps_from(std::string_view index, std::int64_t step) {
  std::set<std::int64_t> steps;
  // A last line that is not whole too: files of its step may be there.
  const std::string lines = std::string(index) + '\n';
  for (const std::string_view line : run_folder::whole_lines(lines).lines) {
    if (const auto listed = run_folder::step_of_row(line); listed && *listed >= step) steps.insert(*listed);
  }
  return steps;
}

/// A line of a list of times names one file.
bool lists_earlier(const std::string& line, std::int64_t step) {
  static const std::regex pattern(R"re(file="([^"]*)\.[^".]*")re");
  std::smatch match;
  if (!std::regex_search(line, match, pattern)) return true;
  return step_of(match[1].str()).value_or(-1) < step;
}

/// A list of times without those from a step on, and without a last line that has no end, in which a run was cut off.
std::string list_before(std::string_view text, std::int64_t step) {
  std::string kept;
  for (const std::string_view line : run_folder::whole_lines(text).lines) {
    if (lists_earlier(std::string(line), step)) kept.append(line) += '\n';
  }
  return kept;
}

/// Lists what is in other files.
bool is_list(const TreeEntry& entry) { return entry.path.extension() == ".pvd"; }

/// Has rows by step.
bool is_table(const TreeEntry& entry) {
  return entry.name == "history.csv" ||
         (entry.path.extension() == ".csv" && entry.path.parent_path().filename() == "probes");
}

/// What a script has written to stdout and stderr (catalyst/python/breccia_output.py).
bool is_log(const std::string& name) {
  static const std::regex pattern(R"(script(_rank_\d+)?\.log)");
  return std::regex_match(name, pattern);
}

/// A file that loses no line is not touched.
void cut_lines(const TreeEntry& entry, std::int64_t step) {
  if (!is_list(entry) && !is_table(entry)) return;
  const std::optional<std::string> text = regular_content(entry.folder, entry.name, entry.path);
  if (!text) return;
  const std::string kept = is_list(entry) ? list_before(*text, step) : table_before(*text, step);
  if (kept.size() == text->size()) return;
  const FileContent file{entry.path, std::as_bytes(std::span(kept))};
  write_files_atomically(entry.folder, {&file, 1});
}

}  // namespace

void cut_extracts_back(const fs::path& extracts, const fs::path& index, std::int64_t step) {
  const std::string listed = regular_content(index).value_or("");
  const std::set<std::int64_t> later = steps_from(listed, step);
  const Opened folder = open_folder_of(extracts / "entry", Depth::subfolder);
  if (!folder && folder.error != ENOENT) throw output_error(extracts, "cannot open this folder: " + folder.reason);
  const auto is_later = [&](const TreeEntry& entry) {
    return entry.kind != EntryKind::other && later.contains(step_of(entry.name).value_or(-1));
  };
  if (folder) {
    // Lists first: what they name is there as long as they name it.
    walk_tree(folder.descriptor, extracts, [&](const TreeEntry& entry) {
      if (entry.kind == EntryKind::file && !is_later(entry)) cut_lines(entry, step);
      return !is_later(entry);
    });
    walk_tree(folder.descriptor, extracts, [&](const TreeEntry& entry) {
      if (is_later(entry)) remove_entry(entry);
      return !is_later(entry);
    });
  }
  const std::string kept = table_before(listed, step);
  if (kept.size() != listed.size()) write_file_atomically(index, kept);
}

void remove_extracts(const fs::path& extracts, const fs::path& index) {
  const std::optional<std::string> listed = regular_content(index);
  const std::set<std::int64_t> steps = steps_from(listed.value_or(""), 0);
  const Opened folder = open_folder_of(extracts / "entry", Depth::subfolder);
  if (!folder && folder.error != ENOENT) throw output_error(extracts, "cannot open this folder: " + folder.reason);
  if (!folder) return;
  std::vector<fs::path> folders{extracts};
  walk_tree(folder.descriptor, extracts, [&](const TreeEntry& entry) {
    const bool is_extract = entry.kind != EntryKind::other && steps.contains(step_of(entry.name).value_or(-1));
    const bool is_whole =
        listed && entry.kind == EntryKind::file && (is_list(entry) || is_table(entry) || is_log(entry.name));
    if (is_extract || is_whole)
      remove_entry(entry);
    else if (entry.kind == EntryKind::folder)
      folders.push_back(entry.path);
    return !is_extract;
  });
  std::error_code not_empty;
  for (auto path = folders.rbegin(); path != folders.rend(); ++path) fs::remove(*path, not_empty);
}

}  // namespace breccia
