#include "mesh/msh_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

namespace breccia {
namespace {

using Numbers = std::vector<std::int64_t>;

/// Corners and further nodes of elements by their type in a .msh; 0: a type that is not known here.
constexpr std::array<int, 32> kNodes{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                     8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

std::optional<std::int64_t> first_number(const std::string& line) {
  const std::size_t from = line.find_first_not_of(" \t");
  if (from == std::string::npos) return {};
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(line.data() + from, line.data() + line.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

/// The number at the beginning of each line.
std::optional<Numbers> numbers_of_lines(std::ifstream& in, std::int64_t count) {
  Numbers numbers;
  std::string line;
  while (static_cast<std::int64_t>(numbers.size()) < count && std::getline(in, line)) {
    const std::optional<std::int64_t> number = first_number(line);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

template <std::size_t n>
bool read_integers(std::ifstream& in, std::array<std::int32_t, n>& integers) {
  return static_cast<bool>(in.read(reinterpret_cast<char*>(integers.data()), sizeof integers));
}

std::optional<Numbers> numbers_of_binary_nodes(std::ifstream& in, std::int64_t count) {
  Numbers numbers;
  std::array<std::int32_t, 1> number{};
  while (static_cast<std::int64_t>(numbers.size()) < count && read_integers(in, number)) {
    numbers.push_back(number[0]);
    in.ignore(3 * sizeof(double));
  }
  return numbers;
}

/// Blocks of elements of one type each: type, count, tags an element; then number, tags and nodes of each.
std::optional<Numbers> numbers_of_binary_elements(std::ifstream& in, std::int64_t count) {
  Numbers numbers;
  std::array<std::int32_t, 3> block{};
  while (static_cast<std::int64_t>(numbers.size()) < count && read_integers(in, block)) {
    const auto [type, elements, tags] = block;
    const int nodes = type > 0 && type < static_cast<int>(kNodes.size()) ? kNodes[static_cast<std::size_t>(type)] : 0;
    if (nodes == 0 || elements <= 0 || tags < 0) return {};
    std::array<std::int32_t, 1> number{};
    for (std::int32_t e = 0; e < elements && read_integers(in, number); ++e) {
      numbers.push_back(number[0]);
      in.ignore((static_cast<std::streamsize>(tags) + nodes) * 4);
    }
  }
  return numbers;
}

std::optional<Problem> repeated_in(Numbers& numbers, const std::filesystem::path& file, const std::string& what) {
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice == numbers.end()) return {};
  const auto different = std::unique(numbers.begin(), numbers.end()) - numbers.begin();
  return Problem{file.string(),
                 0,
                 "mesh.file",
                 what + " share a number: gmsh would keep one of them",
                 "a number of its own for each of the " + std::to_string(numbers.size()) + " " + what,
                 what + " " + std::to_string(*twice) + ", and " + std::to_string(different) + " different numbers"};
}

}  // namespace

std::vector<Problem> repeated_numbers(const std::filesystem::path& file) {
  std::vector<Problem> problems;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  double version = 0;
  int binary = 0;
  if (!(std::getline(in, line) && in >> version >> binary) || version >= 3) return problems;
  std::getline(in, line);
  std::array<std::int32_t, 1> one{1};
  if (binary != 0 && !(read_integers(in, one) && one[0] == 1)) return problems;  // of the other byte order
  while (std::getline(in, line)) {
    if (line.ends_with('\r')) line.pop_back();
    if (line != "$Nodes" && line != "$Elements") continue;
    const std::string end = "$End" + line.substr(1), what = line == "$Nodes" ? "nodes" : "elements";
    std::getline(in, line);
    const std::int64_t count = first_number(line).value_or(0);
    std::optional<Numbers> numbers = binary == 0       ? numbers_of_lines(in, count)
                                     : what == "nodes" ? numbers_of_binary_nodes(in, count)
                                                       : numbers_of_binary_elements(in, count);
    if (!numbers) return problems;
    if (binary != 0) in >> std::ws;
    if (!std::getline(in, line) || !line.starts_with(end)) return problems;
    if (std::optional<Problem> problem = repeated_in(*numbers, file, what)) problems.push_back(std::move(*problem));
  }
  return problems;
}

}  // namespace breccia
