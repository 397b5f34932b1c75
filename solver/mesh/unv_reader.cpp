#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/trimmed.hpp"
#include "mesh/file_input.hpp"
#include "mesh/set_mesh.hpp"
#include "mesh/set_readers.hpp"

namespace breccia {
namespace {

/// Places of the corners among the nodes of an element; empty: it is left out.
std::vector<std::size_t> corners_of_kind(std::int64_t kind) {
  switch (kind) {
    case 111:
      return {0, 1, 2, 3};
    case 118:
      return {0, 2, 4, 9};  // nodes between corners stand between them
    case 41:
    case 51:
    case 61:
    case 74:
    case 81:
    case 91:
      return {0, 1, 2};
    case 42:
    case 52:
    case 62:
    case 72:
    case 82:
    case 92:
      return {0, 2, 4};
    case 11:
    case 21:
      return {0, 1};
    case 22:
    case 24:
      return {0, 2};
    default:
      return {};
  }
}

bool is_solid_kind(std::int64_t kind) { return kind >= 101 && kind <= 119; }
bool has_orientation(std::int64_t kind) { return kind == 11 || (kind >= 21 && kind <= 24); }

class UnvReader {
 public:
  explicit UnvReader(const std::filesystem::path& file) : file_(file.string()), in_(file) {}

  SetMesh read() {
    std::string line;
    while (in_.rest_of_line(line)) {
      if (trimmed(line) != "-1") continue;
      const std::int64_t number = integers(1)[0];
      if (number == 2411 || number == 781)
        nodes();
      else if (number == 2412 || number == 780)
        elements();
      else if (number == 2467 || number == 2477 || number == 2452 || number == 2435)
        groups();
      else
        skip();
    }
    by_property();
    return std::move(made_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed, const std::string& given = {}) {
    throw InputError(Problem{file_, in_.line() - 1, "mesh.file", what, allowed, given});
  }

  std::string line() {
    std::string text;
    if (!in_.rest_of_line(text)) refuse("is cut off: it ends within a dataset", "a whole universal file");
    return text;
  }
  /// Whether the line ends the dataset.
  static bool ends(const std::string& text) { return trimmed(text) == "-1"; }

  std::vector<std::int64_t> integers_of(const std::string& text) {
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 0; i < text.size();) {
      while (i < text.size() && text[i] <= ' ') ++i;
      if (i == text.size()) break;
      std::int64_t number = 0;
      const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), number);
      if (error != std::errc{} || (end < text.data() + text.size() && *end > ' '))
        refuse("a whole number is due here", "a universal file as text", text);
      numbers.push_back(number);
      i = static_cast<std::size_t>(end - text.data());
    }
    return numbers;
  }
  /// Numbers of the next line, at least so many.
  std::vector<std::int64_t> integers(std::size_t least) {
    const std::string text = line();
    std::vector<std::int64_t> numbers = integers_of(text);
    if (numbers.size() < least) refuse("a line has too few numbers", std::to_string(least), text);
    return numbers;
  }

  void skip() {
    while (!ends(line())) {
    }
  }

  void nodes() {
    for (std::string text = line(); !ends(text); text = line()) {
      const std::vector<std::int64_t> heading = integers_of(text);
      if (heading.empty()) refuse("a node without a label", "", text);
      Vec3 x;
      std::string coordinates = line();
      std::replace(coordinates.begin(), coordinates.end(), 'D', 'E');
      const char* at = coordinates.data();
      const char* const end = at + coordinates.size();
      for (int a = 0; a < 3; ++a) {
        while (at < end && *at <= ' ') ++at;
        const auto [next, error] = std::from_chars(at + (at < end && *at == '+' ? 1 : 0), end, x[a]);
        if (error != std::errc{}) refuse("a node has three coordinates", "x y z", coordinates);
        at = next;
      }
      if (!node_of_.emplace(heading[0], static_cast<Index>(made_.nodes.size())).second)
        refuse("two nodes have one label", "", std::to_string(heading[0]));
      made_.nodes.push_back(x);
    }
  }

  void elements() {
    for (std::string text = line(); !ends(text); text = line()) {
      const std::vector<std::int64_t> heading = integers_of(text);
      if (heading.size() < 6) refuse("the heading of an element has six numbers", "", text);
      const std::int64_t kind = heading[1];
      const auto count = static_cast<std::size_t>(std::max<std::int64_t>(0, heading[5]));
      const std::vector<std::size_t> corners = corners_of_kind(kind);
      if (corners.empty() && is_solid_kind(kind))
        refuse("solids of another shape than tetrahedra", "tetrahedra (111, 118)",
               "element " + std::to_string(heading[0]) + " of kind " + std::to_string(kind));
      if (has_orientation(kind)) line();
      std::vector<std::int64_t> labels;
      while (labels.size() < count) {
        const std::vector<std::int64_t> more = integers(1);
        labels.insert(labels.end(), more.begin(), more.end());
      }
      if (corners.empty()) continue;
      if (labels.size() != count || corners.back() >= count)
        refuse("an element has not the nodes of its kind", "", "element " + std::to_string(heading[0]));
      add(heading, labels, corners);
    }
  }

  void add(const std::vector<std::int64_t>& heading, const std::vector<std::int64_t>& labels,
           const std::vector<std::size_t>& corners) {
    SetMesh::Element element{heading[0], static_cast<int>(corners.size()), {}};
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const auto found = node_of_.find(labels[corners[c]]);
      if (found == node_of_.end())
        refuse("element " + std::to_string(heading[0]) + " has a node that the file does not have before it", "",
               std::to_string(labels[corners[c]]));
      element.nodes[c] = found->second;
    }
    if (!element_of_.emplace(heading[0], static_cast<Index>(made_.elements.size())).second)
      refuse("two elements have one label", "", std::to_string(heading[0]));
    made_.higher_order = made_.higher_order || labels.size() > corners.size();
    made_.elements.push_back(element);
    property_.push_back(heading[2]);
  }

  /// Eight numbers, the last of which counts the members; the name; members of four numbers, two a line.
  void groups() {
    constexpr std::int64_t kNode = 7, kElement = 8;
    for (std::string text = line(); !ends(text); text = line()) {
      const std::vector<std::int64_t> heading = integers_of(text);
      if (heading.size() < 8) refuse("the heading of a group has eight numbers", "", text);
      SetMesh::Set set;
      set.name = std::string(trimmed(line()));
      if (set.name.empty()) set.name = "group_" + std::to_string(heading[0]);
      std::int64_t missing = 0;
      for (std::int64_t read = 0; read < heading[7];) {
        const std::vector<std::int64_t> numbers = integers(4);
        for (std::size_t i = 0; i + 3 < numbers.size(); i += 4, ++read) {
          const auto& known = numbers[i] == kNode ? node_of_ : element_of_;
          if (numbers[i] != kNode && numbers[i] != kElement) continue;
          const auto found = known.find(numbers[i + 1]);
          if (found != known.end()) (numbers[i] == kNode ? set.nodes : set.elements).push_back(found->second);
          missing += found == known.end() ? 1 : 0;
        }
      }
      if (missing > 0 && (set.nodes.empty() || !set.elements.empty()))  // gmsh names the points of a group twice
        made_.notes.push_back("group \"" + set.name + "\" has " + std::to_string(missing) +
                              " members that are no node, tetrahedron, triangle or line of the file");
      made_.sets.push_back(std::move(set));
    }
  }

  void by_property() {
    for (const SetMesh::Set& set : made_.sets)
      for (const Index e : set.elements)
        if (made_.elements[static_cast<std::size_t>(e)].corners == 4) return;
    std::map<std::int64_t, SetMesh::Set> sets;
    for (std::size_t e = 0; e < made_.elements.size(); ++e)
      if (made_.elements[e].corners == 4) sets[property_[e]].elements.push_back(static_cast<Index>(e));
    for (auto& [property, set] : sets) {
      set.name = "volume_" + std::to_string(property);
      made_.sets.push_back(std::move(set));
    }
  }

  std::string file_;
  FileInput in_;
  SetMesh made_;
  std::unordered_map<std::int64_t, Index> node_of_, element_of_;
  std::vector<std::int64_t> property_;  ///< (elements)
};

}  // namespace

RawMesh read_unv(const std::filesystem::path& file, double scale) {
  return raw_mesh(UnvReader(file).read(), file, scale);
}

}  // namespace breccia
