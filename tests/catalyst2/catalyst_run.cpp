#include "catalyst2/catalyst_run.hpp"

#include <algorithm>
#include <sstream>

namespace breccia::test {
namespace {

namespace fs = std::filesystem;

void add_lines(const fs::path& file, std::vector<std::string>& lines) {
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
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
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace breccia::test
