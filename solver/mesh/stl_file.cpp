#include "mesh/stl_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <unordered_map>

#include "base/error.hpp"
#include "base/trimmed.hpp"

namespace breccia {
namespace {

constexpr std::size_t kBefore = 84, kTriangle = 50;  // bytes of a binary file before its triangles, and of each
constexpr double kSamePoint = 1e-8;                  // of the extent: below the rounding of single precision
constexpr double kRounding = 1e-15;                  // of coordinates

[[noreturn]] void refuse(const std::string& file, int line, const std::string& what, const std::string& allowed,
                         const std::string& given = {}) {
  throw InputError(Problem{file, line, "mesh.file", what, allowed, given});
}

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

/// Makes one point of those that are closer than the tolerance: a grid of cells twice as wide, of which a point
/// searches all that its surroundings reach.
class Points {
 public:
  Points(std::vector<Vec3>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

  Index add(const Vec3& x) {
    const auto cell = [&](double value) {
      return tolerance_ > 0 ? static_cast<std::int64_t>(std::floor(value / (2 * tolerance_))) : 0;
    };
    std::array<std::int64_t, 3> from{}, to{};
    for (int a = 0; a < 3; ++a) {
      from[static_cast<std::size_t>(a)] = cell(x[a] - tolerance_);
      to[static_cast<std::size_t>(a)] = cell(x[a] + tolerance_);
    }
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k)
          if (const Index found = found_in({i, j, k}, x); found >= 0) return found;
    const auto made = static_cast<Index>(points_.size());
    points_.push_back(x);
    of_cell_[{cell(x[0]), cell(x[1]), cell(x[2])}].push_back(made);
    return made;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t sum = 0xcbf29ce484222325;  // FNV-1a
      for (const std::int64_t number : cell) sum = (sum ^ static_cast<std::uint64_t>(number)) * 0x100000001b3;
      return static_cast<std::size_t>(sum ^ (sum >> 32));
    }
  };

  [[nodiscard]] Index found_in(const Cell& cell, const Vec3& x) const {
    const auto found = of_cell_.find(cell);
    if (found == of_cell_.end()) return -1;
    for (const Index i : found->second)
      if ((points_[static_cast<std::size_t>(i)] - x).cwiseAbs().maxCoeff() <= tolerance_) return i;
    return -1;
  }

  std::vector<Vec3>& points_;
  double tolerance_;
  std::unordered_map<Cell, std::vector<Index>, Hash> of_cell_;
};

/// Corners of triangles as they stand in the file, three for each.
struct Facets {
  std::vector<Vec3> corners;
  std::vector<Index> solid;
  std::vector<std::string> names;
};

// --- Text
// -----------------------------------------------------------------------------------------------------

class TextReader {
 public:
  TextReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  Facets read() {
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "solid") {
        facets_.names.push_back(name());
      } else if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        rest_of_line();
      } else {
        unexpected("solid, facet or endsolid", word);
      }
    }
    return std::move(facets_);
  }

 private:
  [[noreturn]] void unexpected(const std::string& allowed, const std::string& word) {
    constexpr std::size_t kShown = 40;
    if (at_ == text_.size()) refuse(file_, line_, "is cut off: the text ends within a facet", "a whole STL file");
    refuse(file_, line_, "is no STL text here", allowed, "\"" + word.substr(0, kShown) + "\"");
  }

  /// The next word in small letters; "end" and the word behind it are one. Empty at the end.
  std::string next() {
    const std::string word = lower(raw());
    if (word != "end") return word;
    return word + lower(raw());
  }
  std::string_view raw() {
    while (at_ < text_.size() && is_blank(text_[at_])) step();
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) step();
    return text_.substr(from, at_ - from);
  }
  static bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '\0'; }
  void step() {
    const char c = text_[at_++];
    // A lone carriage return ends a line as well.
    if (c == '\n' || (c == '\r' && (at_ == text_.size() || text_[at_] != '\n'))) ++line_;
  }
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    const std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    return trimmed(rest);
  }

  /// The rest of the line, or what stands there before the first facet.
  std::string name() {
    const std::size_t from = at_;
    const std::string_view whole = rest_of_line();
    const std::size_t facet = lower(text_.substr(from, at_ - from)).find("facet normal");
    if (facet == std::string::npos) return std::string(whole);
    at_ = from + facet;
    return std::string(trimmed(text_.substr(from, facet)));
  }

  /// Its normal is left to the order of its corners: many programs write zeros or "nan".
  void facet() {
    std::string word = next();
    while (word != "outer" && word != "vertex") {
      if (word.empty() || word == "endfacet" || word == "facet") unexpected("normal x y z, then outer loop", word);
      word = next();
    }
    if (word == "outer") {
      if (word = next(); word != "loop") unexpected("outer loop", word);
      word = next();
    }
    int corners = 0;
    for (; word == "vertex"; word = next()) {
      if (++corners > 3) refuse(file_, line_, "a facet has more than three corners", "triangles");
      Vec3 x;
      for (int a = 0; a < 3; ++a) x[a] = number();
      facets_.corners.push_back(x);
    }
    if (corners < 3) unexpected("three corners: vertex x y z", word);
    if (word == "endloop") word = next();
    if (word != "endfacet") unexpected("endloop, endfacet", word);
    if (facets_.names.empty()) facets_.names.emplace_back();
    facets_.solid.push_back(static_cast<Index>(facets_.names.size()) - 1);
  }

  double number() {
    std::string word = lower(raw());
    std::replace(word.begin(), word.end(), 'd', 'e');  // of Fortran
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    double value = 0;
    const auto [read, error] = std::from_chars(begin, end, value);
    if (word.empty()) unexpected("", word);
    if (read != end && *read == ',') refuse(file_, line_, "a number has a comma", "a decimal point", word);
    if (read != end || error == std::errc::invalid_argument) refuse(file_, line_, "is no number", "x y z", word);
    if (error != std::errc{}) return std::abs(value) < 1 && word.find("e-") != std::string::npos ? 0.0 : beyond(word);
    if (!std::isfinite(value)) return beyond(word);
    return value;
  }
  double beyond(const std::string& word) { refuse(file_, line_, "is not finite", "finite coordinates", word); }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  Facets facets_;
};

// --- Binary
// -----------------------------------------------------------------------------------------------------

std::uint32_t triangles_of_binary(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kBefore) std::memcpy(&count, bytes.data() + kBefore - sizeof count, sizeof count);
  return count;
}

Facets read_binary(const std::string& file, std::string_view bytes) {
  const std::uint32_t count = triangles_of_binary(bytes);
  const std::uint64_t needed = kBefore + kTriangle * std::uint64_t{count};
  if (count == 0 || bytes.size() < needed)
    refuse(file, 0,
           "is no STL file, or it is cut off: " + std::to_string(bytes.size()) + " bytes where " +
               std::to_string(count) + " triangles need " + std::to_string(needed),
           "text that begins with \"solid\" and has facets, or a whole binary file");
  Facets facets;
  facets.names.emplace_back();
  facets.solid.assign(count, 0);
  facets.corners.reserve(3 * std::size_t{count});
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = 1; c <= 3; ++c) {  // the first is the normal
      std::array<float, 3> x{};
      std::memcpy(x.data(), bytes.data() + kBefore + kTriangle * t + 12 * c, sizeof x);
      facets.corners.emplace_back(x[0], x[1], x[2]);
      if (!facets.corners.back().allFinite())
        refuse(file, 0, "triangle " + std::to_string(t + 1) + " has a corner that is not finite", "finite coordinates");
    }
  return facets;
}

/// Text has facets soon after its first word, or none at all; in a binary file the size is that of the triangles.
bool is_text(std::string_view bytes) {
  constexpr std::string_view kFirst = "solid";
  constexpr std::size_t kHead = 100000;  // more than any name is long
  const std::uint32_t count = triangles_of_binary(bytes);
  if (count > 0 && bytes.size() == kBefore + kTriangle * std::uint64_t{count}) return false;
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return false;
  const std::string head = lower(bytes.substr(begin, kHead));
  return head.starts_with("facet") || (head.starts_with(kFirst) && head.find("facet") != std::string::npos) ||
         (head.starts_with(kFirst) && head.find('\0') == std::string::npos &&
          head.find("endsolid") != std::string::npos);
}

StlFile joined(const Facets& facets) {
  StlFile made;
  made.names = facets.names;
  Vec3 low = facets.corners.front(), high = low;
  for (const Vec3& x : facets.corners) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double largest = std::max(high.cwiseAbs().maxCoeff(), low.cwiseAbs().maxCoeff());
  Points points(made.surface.points, std::max(kSamePoint * (high - low).maxCoeff(), kRounding * largest));
  std::set<std::array<Index, 3>> seen;
  for (std::size_t t = 0; t < facets.solid.size(); ++t) {
    std::array<Index, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = points.add(facets.corners[3 * t + c]);
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (!seen.insert(corners).second) {
      ++made.repeated;
      continue;
    }
    made.surface.triangles.push_back(corners);
    made.solid.push_back(facets.solid[t]);
  }
  return made;
}

}  // namespace

StlFile read_stl(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::ifstream in(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  std::string_view bytes = content;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    refuse(file, 0, "is text of 16-bit characters", "text in ASCII or UTF-8, or binary STL");
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const Facets facets = is_text(bytes) ? TextReader(file, bytes).read() : read_binary(file, bytes);
  if (facets.solid.empty()) refuse(file, 0, "holds no triangle", "a closed surface of triangles");
  return joined(facets);
}

}  // namespace breccia
