#include "catalyst2/catalyst_run.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace breccia::test {
namespace {

namespace fs = std::filesystem;

void add_lines(const fs::path& file, std::vector<std::string>& lines) {
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
}

/// A line of the history without its last column, the wall time, and without the couples that a search has found,
/// which depend on when it was made.
std::string without_what_runs_do_not_share(const std::string& line) {
  constexpr int kCouples = 29;  // words before it: the channel, four numbers of the cell, 24 columns
  std::istringstream in(line);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  words.pop_back();
  words.at(kCouples) = "couples";
  std::string kept;
  for (const std::string& word : words) kept += word + ' ';
  return kept;
}

}  // namespace

CatalystRun::CatalystRun(int ranks, const std::string& arguments, const std::string& more) {
  fs::create_directories(dump());
  const std::string file = scratch.write("case.toml", kSmallCase);
  outcome = called(ranks, "run " + file + " --progress none -o '" + folder().string() + "' " + arguments, more);
}

Outcome CatalystRun::resumed(int ranks, const std::string& arguments) const {
  return called(ranks, "resume '" + folder().string() + "' --progress none " + arguments, "");
}

Outcome CatalystRun::called(int ranks, const std::string& line, const std::string& more) const {
  const std::string environment = std::string("BRECCIA_LIBCATALYST='") + BRECCIA_STANDIN +
                                  "' CATALYST_IMPLEMENTATION_NAME=standin STANDIN_DUMP='" + dump().string() + "' " +
                                  more;
  return ranks > 1 ? call_ranks(ranks, line, environment) : call(line, environment);
}

std::vector<std::string> CatalystRun::cells_of_rank(int rank) const {
  std::vector<std::string> lines;
  add_lines(dump() / ("rank_" + std::to_string(rank) + ".txt"), lines);
  return lines;
}

std::vector<std::string> CatalystRun::cells() const {
  std::vector<std::string> lines;
  for (const auto& file : fs::directory_iterator(dump())) add_lines(file.path(), lines);
  for (std::string& line : lines)
    if (line.starts_with("history ")) line = without_what_runs_do_not_share(line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace breccia::test
