#include "mesh/inp_parser.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "mesh/inp_lines.hpp"

namespace breccia::inp {
namespace {

/// Corners of a type of element, and all its nodes; 0: it is left out.
struct Shape {
  int corners = 0, nodes = 0;
};

std::optional<Shape> shape_of(const std::string& type) {
  constexpr std::array kTetrahedra{std::pair{"c3d4", 4}, std::pair{"c3d10", 10}};
  constexpr std::array kFirst{"s3", "stri3", "cps3", "cpe3", "cax3", "m3d3", "r3d3", "sfm3d3", "ds3"};
  constexpr std::array kSecond{"stri65", "cps6", "cpe6", "cax6", "m3d6", "sfm3d6", "ds6"};
  constexpr std::array kLines{"t3d2", "t2d2", "b31", "b33", "b21", "r2d2"};
  // Variants have letters behind the name: C3D4H, C3D10M, S3RS.
  const auto is = [&](const std::string& name) {
    const std::size_t skip = type.starts_with("dc3d") ? 1 : type.starts_with("ac3d") ? 1 : 0;
    return type.compare(skip, name.size(), name) == 0 &&
           (type.size() == skip + name.size() ||
            std::isdigit(static_cast<unsigned char>(type[skip + name.size()])) == 0);
  };
  for (const auto& [name, nodes] : kTetrahedra)
    if (is(name)) return Shape{4, nodes};
  if (type.find("c3d") != std::string::npos || type.starts_with("sc") || type.starts_with("csc")) return {};
  if (std::any_of(kFirst.begin(), kFirst.end(), is)) return Shape{3, 3};
  if (std::any_of(kSecond.begin(), kSecond.end(), is)) return Shape{3, 6};
  if (std::any_of(kLines.begin(), kLines.end(), is)) return Shape{2, 2};
  return Shape{};
}

class Parser {
 public:
  explicit Parser(const std::filesystem::path& file) : file_(file), lines_(file) { model_.parts.emplace_back(); }

  Model parse() {
    InpLine line;
    while (problems_.size() < kProblemsNamed && lines_.next(line)) {
      if (line.keyword.empty())
        data(line);
      else
        keyword(line);
    }
    finish_element();
    if (!problems_.empty()) throw InputError(std::move(problems_));
    for (const auto& [type, count] : left_out_)
      model_.notes.push_back(std::to_string(count) + " elements of type " + type + " are left out");
    return std::move(model_);
  }

 private:
  enum class Reading { nothing, nodes, elements, set, surface, instance };

  void refuse(const InpLine& line, const std::string& key, const std::string& what, const std::string& allowed,
              const std::string& given = {}) {
    if (problems_.size() < kProblemsNamed) problems_.push_back({line.file, line.line, key, what, allowed, given});
  }
  static std::string value(const InpLine& line, const char* name) {
    const auto found = line.parameters.find(name);
    return found == line.parameters.end() ? std::string() : found->second;
  }
  Part& part() { return model_.parts[part_]; }

  // --- Keywords
  // -------------------------------------------------------------------------------------------------

  void keyword(const InpLine& line) {
    finish_element();
    reading_ = Reading::nothing;
    const std::string& word = line.keyword;
    if (word == "node") {
      begin_nodes(line);
    } else if (word == "element") {
      begin_elements(line);
    } else if (word == "nset" || word == "elset") {
      begin_set(line, word == "nset" ? Set::Kind::nodes : Set::Kind::elements, value(line, word.c_str()));
      instance_of_items_ = value(line, "instance");
      generate_ = line.parameters.count("generate") != 0;
      if (const std::string of = value(line, "elset"); word == "nset" && !of.empty())
        part().sets.back().items.push_back({instance_of_items_, of, 0, 0});
      reading_ = Reading::set;
    } else if (word == "surface") {
      const bool of_nodes = lower_case(value(line, "type")) == "node";
      begin_set(line, of_nodes ? Set::Kind::node_surface : Set::Kind::surface, value(line, "name"));
      reading_ = Reading::surface;
    } else if (word == "solid section") {
      part().sections.push_back(value(line, "elset"));
    } else if (word == "part") {
      model_.parts.emplace_back().name = value(line, "name");
      part_ = model_.parts.size() - 1;
    } else if (word == "instance") {
      model_.instances.push_back(
          {value(line, "name"), value(line, "part"), Vec3::Zero(), false, Vec3::Zero(), Vec3::Zero(), 0, line.line});
      rows_ = 0;
      reading_ = Reading::instance;
    } else if (word == "end part" || word == "end instance") {
      part_ = 0;
    } else if (word == "include") {
      const std::filesystem::path name = value(line, "input");
      const std::filesystem::path from = std::filesystem::path(line.file).parent_path();
      if (!lines_.open(name.is_absolute() ? name : from / name))
        refuse(line, "*INCLUDE", "the file cannot be read, or includes itself", "", name.string());
    } else {
      refuse_generator(line);
    }
  }

  void refuse_generator(const InpLine& line) {
    constexpr std::array kGenerators{"ngen", "nfill", "nmap", "ncopy", "elgen", "elcopy", "system", "import"};
    for (const char* one : kGenerators)
      if (line.keyword == one)
        refuse(line, "*" + line.keyword, "nodes and elements that a keyword generates or moves are not read",
               "the mesh written out in full, with *NODE and *ELEMENT");
  }

  void begin_nodes(const InpLine& line) {
    if (!value(line, "input").empty() || !(value(line, "system").empty() || lower_case(value(line, "system")) == "r"))
      refuse(line, "*NODE", "INPUT and SYSTEM are not read", "nodes in Cartesian coordinates, in this file");
    named_ = value(line, "nset");
    if (!named_.empty()) begin_set(line, Set::Kind::nodes, named_);
    reading_ = Reading::nodes;
  }

  void begin_elements(const InpLine& line) {
    const std::string type = value(line, "type");
    const std::optional<Shape> shape = shape_of(lower_case(type));
    if (!value(line, "input").empty()) refuse(line, "*ELEMENT", "INPUT is not read", "elements in this file");
    if (!shape) {
      refuse(line, "*ELEMENT", "solids of another shape than tetrahedra", "C3D4, C3D10 and their variants", type);
      return;
    }
    named_ = value(line, "elset");
    if (!named_.empty()) begin_set(line, Set::Kind::elements, named_);
    shape_ = *shape;
    type_ = type;
    model_.higher_order = model_.higher_order || (shape_.corners > 0 && shape_.nodes > shape_.corners);
    reading_ = Reading::elements;
  }

  void begin_set(const InpLine& line, Set::Kind kind, const std::string& name) {
    if (name.empty()) refuse(line, "*" + line.keyword, "a set without a name", "NSET=, ELSET= or NAME= of it");
    part().sets.push_back({kind, name, {}, line.line});
    generate_ = false;
    instance_of_items_.clear();
  }

  // --- Data
  // -------------------------------------------------------------------------------------------------

  void data(const InpLine& line) {
    switch (reading_) {
      case Reading::nothing:
        return;
      case Reading::nodes:
        return node(line);
      case Reading::elements:
        return element(line);
      case Reading::set:
        return generate_ ? range(line) : items(line);
      case Reading::surface:
        return face(line);
      case Reading::instance:
        return placement(line);
    }
  }

  bool integer(const InpLine& line, const std::string& text, std::int64_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    // Some programs write labels as 12. or 1.2e1.
    if (error == std::errc{} && end == text.data() + text.size() && number > 0) return true;
    refuse(line, "", "a label is due here", "a whole number above 0", text);
    return false;
  }
  bool real(const InpLine& line, std::string text, double& number) {
    std::replace(text.begin(), text.end(), 'd', 'e');
    std::replace(text.begin(), text.end(), 'D', 'e');
    number = 0;
    if (text.empty()) return true;  // a coordinate that is left out is 0
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
    if (end == text.data() + text.size() && error != std::errc::invalid_argument) return true;
    refuse(line, "", "a number is due here", "a decimal point, and commas between numbers", text);
    return false;
  }

  void node(const InpLine& line) {
    std::int64_t label = 0;
    Vec3 x = Vec3::Zero();
    if (line.items.size() < 2 || line.items.size() > 7) {
      refuse(line, "*NODE", "a line of a node has a label and up to three coordinates", "label, x, y, z",
             std::to_string(line.items.size()) + " numbers");
      return;
    }
    if (!integer(line, line.items[0], label)) return;
    for (std::size_t i = 1; i < std::min<std::size_t>(4, line.items.size()); ++i)
      if (!real(line, line.items[i], x[static_cast<Eigen::Index>(i) - 1])) return;
    part().node_labels.push_back(label);
    part().nodes.push_back(x);
    if (!named_.empty()) part().sets.back().items.push_back({{}, {}, label, 0});
  }

  /// Its numbers may stand on several lines, each but the last of which ends with a comma.
  void element(const InpLine& line) {
    if (shape_.corners == 0) {
      if (pending_.empty()) ++left_out_[type_];
      pending_.assign(line.continues ? 1 : 0, 0);
      return;
    }
    for (const std::string& item : line.items) {
      std::int64_t number = 0;
      if (!integer(line, item, number)) return pending_.clear();
      pending_.push_back(number);
    }
    at_ = line;
    if (pending_.size() > static_cast<std::size_t>(shape_.nodes) || !line.continues) finish_element();
  }

  void finish_element() {
    if (reading_ != Reading::elements || shape_.corners == 0) return pending_.clear();
    if (pending_.empty()) return;
    if (pending_.size() != static_cast<std::size_t>(shape_.nodes) + 1) {
      refuse(at_, "*ELEMENT", "an element of type " + type_ + " has " + std::to_string(shape_.nodes) + " nodes",
             "label, then its nodes", std::to_string(pending_.size()) + " numbers");
    } else {
      Element made{pending_[0], shape_.corners, {}, at_.line};
      std::copy_n(pending_.begin() + 1, shape_.corners, made.nodes.begin());
      part().elements.push_back(made);
      if (!named_.empty()) part().sets.back().items.push_back({{}, {}, made.label, 0});
    }
    pending_.clear();
  }

  /// A label, the name of a set, or one of an instance: "Part-1-1.Set-2".
  Item item_of(const std::string& text) {
    Item item;
    item.instance = instance_of_items_;
    const auto is_label = [](const std::string& word) {
      return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    };
    std::string word = text;
    if (const std::size_t dot = word.rfind('.'); dot != std::string::npos && dot > 0 && dot + 1 < word.size()) {
      item.instance = word.substr(0, dot);
      word = word.substr(dot + 1);
    }
    if (is_label(word))
      std::from_chars(word.data(), word.data() + word.size(), item.label);
    else
      item.name = word;
    return item;
  }

  void items(const InpLine& line) {
    for (const std::string& text : line.items)
      if (!text.empty()) part().sets.back().items.push_back(item_of(text));
  }

  void range(const InpLine& line) {
    constexpr std::int64_t kLongest = 1'000'000'000;
    std::int64_t first = 0, last = 0, step = 1;
    if (line.items.size() < 2 || !integer(line, line.items[0], first) || !integer(line, line.items[1], last)) return;
    if (line.items.size() > 2 && !line.items[2].empty() && !integer(line, line.items[2], step)) return;
    if (last < first || (last - first) / step > kLongest)
      return refuse(line, "GENERATE", "is no range", "first, last, step", line.items[0] + ", " + line.items[1]);
    for (std::int64_t label = first; label <= last; label += step)
      part().sets.back().items.push_back({instance_of_items_, {}, label, 0});
  }

  void face(const InpLine& line) {
    Item item = item_of(line.items.front());
    const std::string side = line.items.size() > 1 ? lower_case(line.items[1]) : std::string();
    if (part().sets.back().kind == Set::Kind::surface && !side.empty()) {
      const bool numbered = side.size() == 2 && side[0] == 's' && side[1] >= '1' && side[1] <= '4';
      if (!numbered && side != "spos" && side != "sneg")
        return refuse(line, "*SURFACE", "is no face of a tetrahedron or triangle", "S1 to S4, SPOS, SNEG", side);
      if (numbered) item.face = side[1] - '0';
    }
    part().sets.back().items.push_back(item);
  }

  /// First the translation, then a rotation about an axis through two points.
  void placement(const InpLine& line) {
    Instance& instance = model_.instances.back();
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < std::min(numbers.size(), line.items.size()); ++i)
      if (!real(line, line.items[i], numbers[i])) return;
    if (rows_ == 0) {
      instance.shift = Vec3(numbers[0], numbers[1], numbers[2]);
    } else {
      instance.turned = true;
      instance.from = Vec3(numbers[0], numbers[1], numbers[2]);
      instance.to = Vec3(numbers[3], numbers[4], numbers[5]);
      instance.degrees = numbers[6];
    }
    ++rows_;
  }

  std::filesystem::path file_;
  InpLines lines_;
  Model model_;
  std::vector<Problem> problems_;
  std::size_t part_ = 0;
  Reading reading_ = Reading::nothing;
  std::string named_, type_, instance_of_items_;
  Shape shape_;
  bool generate_ = false;
  std::vector<std::int64_t> pending_;
  InpLine at_;
  int rows_ = 0;
  std::map<std::string, std::int64_t> left_out_;
};

}  // namespace

Model parse(const std::filesystem::path& file) { return Parser(file).parse(); }

}  // namespace breccia::inp
