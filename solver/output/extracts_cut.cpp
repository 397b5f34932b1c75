#include "output/extracts_cut.hpp"

#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include "output/atomic_file.hpp"

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

/// Keeps the lines for which `stays` holds, but for a last one without an end, in which a run was cut off; a file that
/// loses none is not touched.
void cut_lines(const fs::path& file, const std::function<bool(const std::string&, std::size_t)>& stays) {
  std::ifstream stream(file);
  std::string kept;
  bool all = true;
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line); ++number) {
    if (!stream.eof() && stays(line, number)) {
      kept += line + '\n';
    } else {
      all = false;
    }
  }
  stream.close();
  if (!all) write_file_atomically(file, kept);
}

/// A line of a list of times names one file.
bool lists_earlier(const std::string& line, std::int64_t step) {
  static const std::regex pattern(R"re(file="([^"]*)\.[^".]*")re");
  std::smatch match;
  if (!std::regex_search(line, match, pattern)) return true;
  return step_of(match[1].str()).value_or(-1) < step;
}

}  // namespace

void cut_extracts_back(const fs::path& extracts, std::int64_t step) {
  std::vector<fs::path> later, lists, histories;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(extracts, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    if (step_of(path.filename().string()).value_or(-1) >= step) {
      later.push_back(path);
      entry.disable_recursion_pending();
    } else if (path.extension() == ".pvd") {
      lists.push_back(path);
    } else if (path.filename() == "history.csv" ||
               (path.extension() == ".csv" && path.parent_path().filename() == "probes")) {
      histories.push_back(path);
    }
  }
  // Lists first: what they name is there as long as they name it.
  for (const fs::path& list : lists)
    cut_lines(list, [&](const std::string& line, std::size_t) { return lists_earlier(line, step); });
  for (const fs::path& history : histories)
    cut_lines(history, [&](const std::string& line, std::size_t number) {
      return number == 0 || std::atoll(line.c_str()) < step;
    });
  for (const fs::path& path : later) {
    fs::remove_all(path, error);
    if (error) throw output_error(path, "cannot remove this extract, which is ahead of the run", error.value());
  }
}

}  // namespace breccia
