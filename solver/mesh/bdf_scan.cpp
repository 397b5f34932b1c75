#include "mesh/bdf_scan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/trimmed.hpp"
#include "mesh/file_input.hpp"

namespace breccia {
namespace {

/// A field of a card: of eight letters, of sixteen behind a star, or between commas.
std::string field(std::string_view line, std::size_t number) {
  if (line.find(',') != std::string_view::npos) {
    for (; number > 0; --number) {
      const std::size_t comma = line.find(',');
      if (comma == std::string_view::npos) return {};
      line.remove_prefix(comma + 1);
    }
    return std::string(trimmed(line.substr(0, line.find(','))));
  }
  const bool wide = line.substr(0, 8).find('*') != std::string_view::npos;
  const std::size_t width = wide && number > 0 ? 16 : 8, from = number == 0 ? 0 : 8 + (number - 1) * width;
  return from < line.size() ? std::string(trimmed(line.substr(from, width))) : std::string();
}

std::string card_of(std::string_view line) {
  std::string name = field(line, 0);
  if (name.ends_with('*')) name.pop_back();
  name = std::string(trimmed(name));
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

}  // namespace

BdfScan scan_bdf(const std::filesystem::path& file) {
  BdfScan scan;
  FileInput in(file);
  std::string line;
  bool ended = false;
  const auto refuse = [&](const std::string& card, const std::string& what, const std::string& allowed,
                          const std::string& given) {
    if (scan.problems.size() < kProblemsNamed)
      scan.problems.push_back({file.string(), in.line() - 1, card, what, allowed, given});
  };
  constexpr std::array kSolids{"CHEXA", "CPENTA", "CPYRAM", "CPYRA"};
  while (!ended && in.rest_of_line(line)) {
    const std::string card = card_of(line);
    ended = card == "ENDDATA";
    if (card == "CTETRA") ++scan.tetrahedra;
    if (std::find(kSolids.begin(), kSolids.end(), card) != kSolids.end())
      refuse(card, "solids of another shape than tetrahedra", "CTETRA", "element " + field(line, 1));
    const std::string system = card == "GRID" ? field(line, 2) : std::string();
    if (!system.empty() && system != "0")
      refuse(card, "a grid point in a coordinate system of its own", "coordinates of the basic system (field 3 blank)",
             "system " + system);
    if (card.starts_with("INCLUDE")) refuse("INCLUDE", "other files are not read", "one file with all cards", line);
  }
  if (!ended)
    scan.problems.push_back(
        {file.string(), 0, "mesh.file", "is cut off: it does not end with ENDDATA", "a whole file", ""});
  return scan;
}

}  // namespace breccia
