#include "case/reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <set>
#include <tuple>

#include "case/bindings.hpp"
#include "case/joint_entries.hpp"
#include "case/nearest.hpp"
#include "case/parent_case.hpp"
#include "case/reader_groups.hpp"
#include "case/reader_keys.hpp"
#include "case/reader_overrides.hpp"
#include "case/units.hpp"
#include "case/validate.hpp"
#include "case/writer.hpp"

namespace breccia::case_ {
namespace {

/// Adds the places of what stands in a table. @param before  of the names: "displacement."
void add_places(const Node& table, const std::string& before, std::map<std::string, KeyPlace>& places) {
  for (const auto& [name, node] : table.entries) {
    places[before + name] = {node.file, node.line};
    if (node.is(Node::Kind::table)) add_places(node, before + name + ".", places);
  }
}

// Archive that fills one section of a case from one table of the file. What the table lacks is read from the schema.
class SectionReader {
 public:
  static constexpr bool reads = true;

  SectionReader(ValueReader& values, const Case& model, const Node& table, std::string path, bool written)
      : values_(values),
        model_(model),
        table_(table),
        path_(std::move(path)),
        pattern_(pattern_of(path_)),
        written_(written) {}

  [[nodiscard]] bool has(std::string_view name) const { return table_.find(name) != nullptr; }

  void origin(Origin& out) const {
    out = {table_.line, path_};
    add_places(table_, "", out.keys);
  }

  template <class T>
  void value(std::string_view name, T& out) {
    with_node(name, [&](const Key& key, const Node& node) { values_.read(key, node, at(name), out); });
  }

  template <class Choice>
  void choice(std::string_view name, Choice& out) {
    with_node(name, [&](const Key& key, const Node& node) {
      if (const auto index = values_.read_choice(key, node, at(name))) out = static_cast<Choice>(*index);
    });
  }

  void axis_functions(std::string_view name, std::array<bool, 3>& axes, std::array<TimeFunction, 3>& out) {
    with_node(name, [&](const Key& key, const Node& node) { values_.read_axes(key, node, at(name), axes, out); });
  }

  template <class Visitor>
  void section(std::string_view name, Visitor visit) {
    const Key& key = key_of(pattern(name));
    const Node* node = table_.find(name);
    if (node == nullptr && key.required && written_) values_.missing_key(key, table_, at(name));
    const bool is_table = node != nullptr && node->is(Node::Kind::table);
    Node empty;
    empty.file = table_.file;
    SectionReader inner(values_, model_, is_table ? *node : empty, at(name), is_table);
    visit(inner);
  }

  template <class T>
  void optional_section(std::string_view name, std::optional<T>& out) {
    if (const Node* node = table_.find(name); node != nullptr && node->is(Node::Kind::table))
      section(name, [&](auto& s) { bind(s, *(out = T{})); });
  }

  template <class T>
  void list(std::string_view name, std::vector<T>& out) {
    const Key& key = key_of(pattern(name) + "[]");
    const Node* node = table_.find(name);
    if (key.required && (node == nullptr || (node->is(Node::Kind::list) && node->items.empty())))
      values_.missing_key(key, node == nullptr ? table_ : *node, at(name));
    if (node == nullptr || !node->is(Node::Kind::list)) return;
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const Node& entry = node->items[i];
      if (!entry.is(Node::Kind::table)) continue;
      const std::string index = std::to_string(entry.place < 0 ? static_cast<int>(i) : entry.place);
      SectionReader inner(values_, model_, entry, at(name) + "[" + index + "]", true);
      bind(inner, out.emplace_back());
    }
  }

  void exactly_one(std::initializer_list<std::string_view> names) {
    if (!written_) return;
    if (std::none_of(names.begin(), names.end(), [&](std::string_view n) { return has(n); }))
      values_.problem(table_, path_, "lacks a key", "exactly one of " + words(names), "");
    at_most_one(names);
  }

  void at_most_one(std::initializer_list<std::string_view> names) {
    std::vector<std::string> given;
    for (const std::string_view n : names)
      if (has(n)) given.emplace_back(n);
    if (given.size() > 1)
      values_.problem(*table_.find(given.back()), at(given.back()), "excludes another key of its section",
                      "only one of " + words(names), joined(given, " and "));
  }

  void needed(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
      if (written_ && !has(name)) values_.missing_key(key_of(pattern(name)), table_, at(name));
  }

  /// Keys of the section that have no effect under a condition.
  void only(std::initializer_list<std::string_view> names, const std::string& condition) {
    for (const auto& [name, node] : table_.entries) {
      if (std::find(names.begin(), names.end(), name) != names.end() || find_key(pattern(name)) == nullptr) continue;
      values_.problem(node, at(name), "has no effect beside " + condition, "only " + words(names), node.shown());
    }
  }

  // A script is named relative to the case file.
  void resolve_script(std::string& name) const {
    if (is_script(name)) name = (model_.file.parent_path() / name).lexically_normal().string();
  }

  // 0 when a material is missing, which validate() reports.
  [[nodiscard]] double smallest_young(const std::array<std::string, 2>& groups) const {
    return case_::smallest_young(model_, groups);
  }

 private:
  [[nodiscard]] std::string at(std::string_view name) const {
    return path_ + (path_.empty() ? "" : ".") + std::string(name);
  }
  [[nodiscard]] std::string pattern(std::string_view name) const {
    return pattern_ + (pattern_.empty() ? "" : ".") + std::string(name);
  }
  static std::string words(std::initializer_list<std::string_view> names) {
    return joined(std::vector<std::string>(names.begin(), names.end()));
  }

  // Calls read with the value of the file, else with the default of the schema.
  template <class Read>
  void with_node(std::string_view name, Read read) {
    const Key& key = key_of(pattern(name));
    if (const Node* node = table_.find(name)) {
      read(key, *node);
    } else if (key.required) {
      if (written_) values_.missing_key(key, table_, at(name));
    } else if (!key.fallback.empty() && !key.fallback.starts_with('=')) {
      read(key, parse_toml_value(key.fallback, "schema"));
    }
  }

  ValueReader& values_;
  const Case& model_;
  const Node& table_;
  std::string path_;
  std::string pattern_;
  bool written_;  // false: the whole section is absent or malformed, and its keys are not missed one by one
};

// Unbreakable joints need no more than a penalty, so the schema's default law does for groups without an entry.
void add_default_joints(Case& c, ValueReader& values) {
  for (std::size_t i = 0; i < c.materials.size(); ++i) {
    const Material& m = c.materials[i];
    const bool present = std::any_of(c.joints.begin(), c.joints.end(), [&](const Joint& j) {
      return j.inside() && (j.inside_any || j.groups[0] == m.group);
    });
    if (m.joints != JointPlacement::unbreakable || present) continue;
    Node table, group;
    group.kind = Node::Kind::text;
    group.text = m.group;
    table.entries.emplace_back("group", group);
    SectionReader reader(values, c, table, "joint[" + std::to_string(c.joints.size()) + "]", true);
    Joint joint;
    bind(reader, joint);
    joint.origin = m.origin;
    c.joints.push_back(std::move(joint));
  }
}

/// mesh.parameters are in the unit of length of the geometry; what the case gives with a unit has been read in metres.
void convert_lengths_to_the_unit_of_the_file(ValueReader& values, MeshSource& mesh) {
  for (const auto& [name, power] : values.lengths_in("mesh.parameters"))
    mesh.parameters[name] /= std::pow(mesh.scale, power);
}

bool stands_below(std::string_view key, std::string_view section) {
  return key.size() > section.size() && key.starts_with(section) &&
         (key[section.size()] == '.' || key[section.size()] == '[');
}

// True if what is allowed at a key depends on another one beside it: "at most friction_angle".
bool depends_on(const Problem& problem, const std::string& other) {
  const std::size_t section = other.rfind('.') + 1;
  if (problem.key.rfind('.') + 1 != section || !problem.key.starts_with(other.substr(0, section))) return false;
  const std::string name = other.substr(section);
  const std::size_t at = problem.allowed.find(name);
  if (at == std::string::npos) return false;
  const auto in_word = [&](std::size_t i) {
    const char c = i < problem.allowed.size() ? problem.allowed[i] : ' ';
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  return (at == 0 || !in_word(at - 1)) && !in_word(at + name.size());
}

// True if some problem already stands at the key, around it, below it or at one that it depends on: a second one is
// likely to be its consequence.
bool told_already(std::span<const Problem> problems, const Problem& problem) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
    const std::string& key = problem.key;
    return key == p.key ||
           (!p.key.empty() && (stands_below(key, p.key) || stands_below(p.key, key) || depends_on(problem, p.key)));
  });
}

/// Reports common problems of the groups of one entry once.
void tell_once(std::vector<Problem>& problems) {
  std::set<std::tuple<std::string, std::string, std::string>> told;
  std::erase_if(problems,
                [&](const Problem& p) { return !p.key.empty() && !told.emplace(p.key, p.what, p.allowed).second; });
}

/// What a case is read against.
struct Surroundings {
  MeshFile mesh = MeshFile::must_be_there;
  const ParentCase* parent = nullptr;
  std::vector<std::string> volumes{};  ///< groups of the mesh; empty: not known
};

Case case_of(Node root, const std::filesystem::path& file, std::span<const std::string> overrides,
             const Surroundings& around) {
  std::vector<Problem> problems;
  std::vector<std::string> inherited;
  if (around.parent != nullptr) inherited = inherit_sections(*around.parent, root);
  apply_overrides(root, overrides, problems);

  Case c;
  c.file = std::filesystem::absolute(file).lexically_normal();
  ValueReader values(problems, c.file.parent_path());
  check_keys(root, values);
  const Node written = root;
  // The "*" of a parent's text may be a default that its reader added.
  expand_groups(root, around.volumes, around.parent == nullptr);
  SectionReader reader(values, c, root, "", true);
  bind(reader, c);
  c.data = values.data_files();
  convert_lengths_to_the_unit_of_the_file(values, c.mesh);
  add_default_joints(c, values);

  const auto add = [&](std::vector<Problem> found) {
    const std::vector<Problem> before = problems;
    for (Problem& p : found) {
      if (told_already(before, p)) continue;
      const Node& node = deepest_on_path(written, p.key);
      p.file = node.file.empty() ? c.file.string() : node.file;
      p.line = node.line;
      problems.push_back(std::move(p));
    }
    tell_once(problems);
  };
  add(validate(c, around.parent == nullptr && around.mesh == MeshFile::must_be_there));
  if (!problems.empty()) throw InputError(std::move(problems));
  c.resolved = write_case(c);
  if (around.parent != nullptr) {
    std::vector<Problem> refused = refused_changes(*around.parent, c, inherited);
    for (Problem& p : refused) p.key = written_path(root, p.key);
    add(std::move(refused));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return c;
}

}  // namespace

Case read_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return case_of(parse_toml_file(file), file, overrides, {});
}

std::optional<Start> read_start(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Node root = parse_toml_file(file);
  std::vector<Problem> of_others, problems;
  apply_overrides(root, overrides, of_others);
  Case c;
  ValueReader values(problems, std::filesystem::absolute(file).lexically_normal().parent_path());
  SectionReader reader(values, c, root, "", true);
  reader.optional_section("start", c.start);
  if (!problems.empty()) throw InputError(std::move(problems));
  return c.start;
}

Case read_started_case(const std::filesystem::path& file, std::span<const std::string> overrides,
                       const ParentCase& parent) {
  return case_of(parse_toml_file(file), file, overrides, {MeshFile::may_be_gone, &parent, parent.volumes});
}

Case read_case_text(std::string_view text, const std::filesystem::path& file, std::span<const std::string> overrides,
                    MeshFile mesh) {
  return case_of(parse_toml_text(text, file.string()), file, overrides, {mesh, nullptr});
}

Case read_case_tree(Node root, const std::filesystem::path& file, MeshFile mesh,
                    const std::vector<std::string>& volumes) {
  return case_of(std::move(root), file, {}, {mesh, nullptr, volumes});
}

Setting read_setting(const std::string& text) {
  Setting setting;
  setting.text = text;
  try {
    setting.number = parse_quantity(text).value;
  } catch (const UnitError&) {
    // it is no quantity
  }
  return setting;
}

}  // namespace breccia::case_
