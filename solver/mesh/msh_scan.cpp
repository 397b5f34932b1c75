#include "mesh/msh_scan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "mesh/file_input.hpp"

namespace breccia {
namespace {

using Numbers = std::vector<std::int64_t>;

/// Corners and further nodes of elements by their type in a .msh; 0: a type that is not known here.
constexpr std::array<int, 32> kNodes{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                     8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

int nodes_of_type(std::int64_t type) {
  return type > 0 && type < static_cast<std::int64_t>(kNodes.size()) ? kNodes[static_cast<std::size_t>(type)] : 0;
}

class Scan {
 public:
  explicit Scan(const std::filesystem::path& file) : file_(file.string()), in_(file) {}

  std::vector<Problem> faults() {
    if (!read_format()) return {};
    std::string line;
    while (!unknown_ && problems_.size() < kProblemsNamed && in_.rest_of_line(line)) {
      while (line.ends_with(' ')) line.pop_back();
      if (!line.starts_with('$') || line.starts_with("$End")) continue;
      section_ = line;
      begin_ = in_.line() - 1;
      if (!read_section()) break;
    }
    return std::move(problems_);
  }

 private:
  /// How wide a binary integer is.
  enum class Width { four, eight };

  bool read_format() {
    std::string word;
    int binary = 0;
    double version = 0;
    if (!in_.word(word) || word != "$MeshFormat" || !in_.word(word)) return false;
    std::from_chars(word.data(), word.data() + word.size(), version);
    if (!in_.word(word)) return false;
    std::from_chars(word.data(), word.data() + word.size(), binary);
    version_ = version;
    binary_ = binary != 0;
    std::string rest;
    in_.rest_of_line(rest);
    if (!binary_) return true;
    std::int32_t one = 0;
    if (!in_.binary(one)) return false;
    in_.swap_bytes(one != 1);
    return true;
  }

  /// @return  whether what follows it can be read
  bool read_section() {
    fault_.clear();
    total_ = found_ = 0;
    numbers_.clear();
    const bool counted = section_ == "$Nodes"                       ? read_nodes()
                         : section_ == "$Elements"                  ? read_elements()
                         : section_ == "$PhysicalNames"             ? read_names()
                         : section_ == "$Entities" && version_ >= 4 ? read_entities()
                                                                    : skip_section();
    if (unknown_) return false;
    if (!counted) {
      add(fault_);
      return false;
    }
    if (section_ == "$Nodes" || section_ == "$Elements") {
      if (found_ != total_)
        add("its blocks hold " + std::to_string(found_) + ", and its heading states " + std::to_string(total_));
      if (version_ < 3) refuse_repeated();
    }
    return true;
  }

  void add(const std::string& what) {
    problems_.push_back({file_, binary_ ? 0 : begin_, section_, what + ": gmsh would leave out the rest, or misread it",
                         "a whole file, as it was written", ""});
  }

  // --- Words and numbers
  // -------------------------------------------------------------------------------------------------

  bool fail(const std::string& word) {
    fault_ = word.empty()            ? "the file ends within it"
             : word.starts_with('$') ? "it holds less than its heading states"
                                     : "\"" + word.substr(0, kShown) + "\" stands where a number is expected (line " +
                                           std::to_string(in_.line()) + ")";
    return false;
  }

  bool integer(std::int64_t& value, Width width) {
    if (binary_) {
      std::int32_t four = 0;
      const bool read = width == Width::four ? in_.binary(four) : in_.binary(value);
      if (width == Width::four) value = four;
      return read || fail({});
    }
    in_.word(word_);
    const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), value);
    return (error == std::errc{} && end == word_.data() + word_.size()) || fail(word_);
  }
  /// A number of things that follow.
  bool count(std::int64_t& value, Width width) {
    if (!integer(value, width)) return false;
    if (value >= 0) return true;
    fault_ = "a number of things is negative: " + std::to_string(value);
    return false;
  }

  bool integers(std::int64_t number, Width width) {
    std::int64_t unused = 0;
    for (std::int64_t i = 0; i < number; ++i)
      if (!integer(unused, width)) return false;
    return true;
  }
  bool reals(std::int64_t number) {
    if (binary_) return in_.skip(8 * static_cast<std::uint64_t>(number)) || fail({});
    for (std::int64_t i = 0; i < number; ++i) {
      in_.word(word_);
      const char* begin = word_.data() + (word_.starts_with('+') ? 1 : 0);
      double unused = 0;
      const auto [end, error] = std::from_chars(begin, word_.data() + word_.size(), unused);
      if (end != word_.data() + word_.size() || error == std::errc::invalid_argument) return fail(word_);
    }
    return true;
  }

  /// What the section ends with follows.
  bool ends() {
    const std::string end = "$End" + section_.substr(1);
    in_.word(word_);
    if (word_ == end) return true;
    fault_ = word_.empty()            ? "the file ends without " + end
             : word_.starts_with('$') ? word_ + " stands where it ends, not " + end
                                      : "it holds more than its heading states";
    return false;
  }

  // --- Sections
  // -------------------------------------------------------------------------------------------------

  bool skip_section() {
    const std::string end = "$End" + section_.substr(1);
    std::string line;
    while (in_.rest_of_line(line))
      if (line.ends_with(end) || line.starts_with(end)) return true;
    fault_ = "the file ends without " + end;
    return false;
  }

  bool read_names() {  // text in binary files as well
    std::string line;
    std::int64_t names = 0;
    in_.word(word_);
    const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), names);
    if (error != std::errc{} || end != word_.data() + word_.size()) return fail(word_);
    in_.rest_of_line(line);
    for (std::int64_t i = 0; i < names; ++i) {
      if (!in_.rest_of_line(line)) return fail({});
      if (line.starts_with('$')) return fail(line);
    }
    return ends();
  }

  bool read_entities() {
    std::array<std::int64_t, 4> entities{};
    for (std::int64_t& number : entities)
      if (!count(number, Width::eight)) return false;
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < entities[dimension]; ++i) {
        std::int64_t listed = 0;
        const std::int64_t box = dimension == 0 && version_ > 4.05 ? 3 : 6;
        if (!integers(1, Width::four) || !reals(box)) return false;
        if (!count(listed, Width::eight) || !integers(listed, Width::four)) return false;
        if (dimension > 0 && (!count(listed, Width::eight) || !integers(listed, Width::four))) return false;
      }
    return ends();
  }

  bool heading_of_blocks(std::int64_t& blocks) {
    return count(blocks, Width::eight) && count(total_, Width::eight) &&
           (version_ < 4.05 || integers(2, Width::eight));  // the smallest and the largest number
  }

  /// The entity of a block: format 4.0 has its tag first, 4.1 its dimension.
  bool entity_of_block(std::int64_t& dimension, std::int64_t& third, std::int64_t& size) {
    std::int64_t first = 0, second = 0;
    if (!integer(first, Width::four) || !integer(second, Width::four) || !integer(third, Width::four)) return false;
    dimension = version_ < 4.05 ? second : first;
    return count(size, Width::eight);
  }

  bool read_nodes() {
    if (version_ < 3) {
      if (!count_of_lines()) return false;
      for (; found_ < total_; ++found_)
        if (!numbered(Width::four) || !reals(3)) return false;
      return ends();
    }
    std::int64_t blocks = 0;
    if (!heading_of_blocks(blocks)) return false;
    for (std::int64_t b = 0; b < blocks; ++b) {
      std::int64_t dimension = 0, parametric = 0, size = 0;
      if (!entity_of_block(dimension, parametric, size)) return false;
      const std::int64_t numbers = 3 + (parametric != 0 ? std::clamp<std::int64_t>(dimension, 0, 3) : 0);
      if (version_ > 4.05 && !integers(size, Width::eight)) return false;
      for (std::int64_t i = 0; i < size; ++i)
        if ((version_ < 4.05 && !integers(1, Width::four)) || !reals(numbers)) return false;
      found_ += size;
    }
    return ends();
  }

  bool read_elements() {
    if (version_ < 3) return binary_ ? binary_elements_of_format_2() : elements_of_format_2();
    std::int64_t blocks = 0;
    if (!heading_of_blocks(blocks)) return false;
    for (std::int64_t b = 0; b < blocks; ++b) {
      std::int64_t dimension = 0, type = 0, size = 0;
      if (!entity_of_block(dimension, type, size)) return false;
      const int nodes = nodes_of_type(type);
      if (nodes == 0) return unknown_ = true;
      for (std::int64_t i = 0; i < size; ++i)
        if (!integers(1 + nodes, version_ < 4.05 ? Width::four : Width::eight)) return false;
      found_ += size;
    }
    return ends();
  }

  /// "number type tags tag... node..."
  bool elements_of_format_2() {
    if (!count_of_lines()) return false;
    for (; found_ < total_; ++found_) {
      std::int64_t type = 0, tags = 0;
      if (!numbered(Width::four) || !integer(type, Width::four) || !count(tags, Width::four)) return false;
      const int nodes = nodes_of_type(type);
      if (nodes == 0) return unknown_ = true;
      if (!integers(tags + nodes, Width::four)) return false;
    }
    return ends();
  }

  /// Blocks of elements of one type each: type, count, tags an element; then number, tags and nodes of each.
  bool binary_elements_of_format_2() {
    if (!count_of_lines()) return false;
    while (found_ < total_) {
      std::int64_t type = 0, size = 0, tags = 0;
      if (!integer(type, Width::four) || !count(size, Width::four) || !count(tags, Width::four)) return false;
      const int nodes = nodes_of_type(type);
      if (nodes == 0 || size == 0) return unknown_ = true;
      for (std::int64_t i = 0; i < size; ++i)
        if (!numbered(Width::four) || !integers(tags + nodes, Width::four)) return false;
      found_ += size;
    }
    return ends();
  }

  /// The number of things stands in words, in a binary file as well.
  bool count_of_lines() {
    std::string line;
    in_.word(word_);
    const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), total_);
    if (error != std::errc{} || end != word_.data() + word_.size() || total_ < 0) return fail(word_);
    in_.rest_of_line(line);
    return true;
  }

  bool numbered(Width width) {
    std::int64_t number = 0;
    if (!integer(number, width)) return false;
    numbers_.push_back(number);
    return true;
  }

  /// gmsh keeps the last of several nodes or elements of one number.
  void refuse_repeated() {
    std::sort(numbers_.begin(), numbers_.end());
    const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end());
    if (twice == numbers_.end()) return;
    const std::string what = section_ == "$Nodes" ? "nodes" : "elements";
    const auto different = std::unique(numbers_.begin(), numbers_.end()) - numbers_.begin();
    problems_.push_back(
        {file_, 0, "mesh.file", what + " share a number: gmsh would keep one of them",
         "a number of its own for each of the " + std::to_string(numbers_.size()) + " " + what,
         what + " " + std::to_string(*twice) + ", and " + std::to_string(different) + " different numbers"});
  }

  static constexpr std::size_t kShown = 40;  // letters of a word in a message

  std::string file_;
  FileInput in_;
  double version_ = 0;
  bool binary_ = false, unknown_ = false;
  std::string section_, fault_, word_;
  int begin_ = 0;
  std::int64_t total_ = 0, found_ = 0;
  Numbers numbers_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> msh_faults(const std::filesystem::path& file) { return Scan(file).faults(); }

}  // namespace breccia
