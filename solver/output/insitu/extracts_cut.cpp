#include "output/insitu/extracts_cut.hpp"

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "output/folder/folder_tree.hpp"
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

/// The lines for which `stays` holds, without a last one that has no end, in which a run was cut off; nullopt: all of
/// them.
std::optional<std::string> cut(std::string_view text,
                               const std::function<bool(const std::string&, std::size_t)>& stays) {
  std::string kept;
  std::size_t number = 0;
  const std::size_t size = text.size();
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n'), ++number) {
    const std::string line(text.substr(0, end));
    if (stays(line, number)) kept += line + '\n';
    text.remove_prefix(end + 1);
  }
  if (kept.size() == size) return std::nullopt;
  return kept;
}

bool is_step_before(const std::string& line, std::size_t number, std::int64_t step) {
  return number == 0 || std::atoll(line.c_str()) < step;
}

/// Steps at which pipelines wrote, from `step` on.
std::set<std::int64_t> steps_from(std::string_view index, std::int64_t step) {
  std::set<std::int64_t> steps;
  std::istringstream lines{std::string(index)};
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::int64_t listed = std::atoll(line.c_str());
    if (listed >= step) steps.insert(listed);
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

/// A file that lists what is in others, or rows by step; a file that loses no line is not touched.
void cut_lines(const TreeEntry& entry, std::int64_t step) {
  const bool is_list = entry.path.extension() == ".pvd";
  const bool has_rows = entry.name == "history.csv" ||
                        (entry.path.extension() == ".csv" && entry.path.parent_path().filename() == "probes");
  if (!is_list && !has_rows) return;
  const std::optional<std::string> text = regular_content(entry.folder, entry.name, entry.path);
  if (!text) return;
  const auto kept = cut(*text, [&](const std::string& line, std::size_t number) {
    return is_list ? lists_earlier(line, step) : is_step_before(line, number, step);
  });
  if (!kept) return;
  const FileContent file{entry.path, std::as_bytes(std::span(*kept))};
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
  const auto kept =
      cut(listed, [&](const std::string& line, std::size_t number) { return is_step_before(line, number, step); });
  if (kept) write_file_atomically(index, *kept);
}

}  // namespace breccia
