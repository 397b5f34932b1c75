#include "case/parent_case.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "case/joint_entries.hpp"
#include "case/reader.hpp"
#include "case/schema.hpp"
#include "case/writer.hpp"
#include "system/sha256.hpp"

namespace breccia::case_ {
namespace {

/// Lists whose entries stand for a group or a pair of groups, in any order.
constexpr std::array<std::string_view, 3> kByGroups{"material", "joint", "contact"};
/// Sections without influence on a state that is there.
constexpr std::array<std::string_view, 7> kOfTheRun{"start",  "output",     "gauge",  "trigger",
                                                    "insitu", "checkpoint", "domains"};

bool same(const Node& a, const Node& b) {
  const auto is_number = [](const Node& n) { return n.is(Node::Kind::number) || n.is(Node::Kind::integer); };
  if (is_number(a) && is_number(b)) return a.number == b.number && a.integer == b.integer;
  const auto same_entry = [](const auto& p, const auto& q) { return p.first == q.first && same(p.second, q.second); };
  return a.kind == b.kind && a.boolean == b.boolean && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same) &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(), same_entry);
}

/// A value with its key and pattern in the schema.
struct Value {
  const Node* node;
  std::string key, pattern;
};
using Values = std::map<std::string, Value>;  // by the key with groups in place of indices

bool is_table_list(const Node& node) {
  return node.is(Node::Kind::list) && !node.items.empty() && node.items.front().is(Node::Kind::table);
}

/// "glass" or "brick,mortar": the groups that an entry is of, in the order of the alphabet.
std::string groups_of(const Node& entry) {
  if (const Node* group = entry.find("group")) return group->text;
  const Node* between = entry.find("between");
  if (between == nullptr || between->items.size() != 2) return "";
  const auto [first, second] = std::minmax(between->items[0].text, between->items[1].text);
  return first == second ? first : first + "," + second;
}

/// The values that a state fixes.
void collect(const Node& table, const std::string& identity, const std::string& key, const std::string& pattern,
             Values& values) {
  for (const auto& [name, node] : table.entries) {
    const auto below = [&name = name](std::string path) {
      if (!path.empty()) path += '.';
      path += name;
      return path;
    };
    if (is_table_list(node) && find_key(below(pattern) + "[]") != nullptr) {
      const bool by_groups = key.empty() && std::find(kByGroups.begin(), kByGroups.end(), name) != kByGroups.end();
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        const std::string index = std::to_string(i);
        collect(node.items[i], below(identity) + "[" + (by_groups ? groups_of(node.items[i]) : index) + "]",
                below(key) + "[" + index + "]", below(pattern) + "[]", values);
      }
    } else if (const Key* row = find_key(below(pattern)); row != nullptr && row->is_section()) {
      collect(node, below(identity), below(key), below(pattern), values);
    } else if (row != nullptr && !fixed_by_state(row->path).empty()) {
      values[below(identity)] = {&node, below(key), below(pattern)};
    }
  }
}

bool any_interacts(const Case& input) {
  return std::any_of(input.contacts.begin(), input.contacts.end(),
                     [](const Contact& contact) { return contact.interaction == Interaction::contact; });
}

constexpr const char* kCannot = "cannot change where a run starts from the state of another: ";

Problem refused(const std::string& key, const std::string& pattern, const std::string& allowed,
                const std::string& given) {
  return {"", 0, key, kCannot + std::string(fixed_by_state(pattern)), allowed, given};
}

/// Entries of pairs and of "*" may take each other's places, but not give the joints of a pair a law of another kind.
void compare_joint_laws(const ParentCase& parent, const Case& now, std::vector<Problem>& problems) {
  std::set<const Joint*> told;
  for (const Material& a : now.materials) {
    for (const Material& b : now.materials) {
      const Joint* before = joint_entry(parent.input, a.group, b.group).ruling;
      const Joint* joint = joint_entry(now, a.group, b.group).ruling;
      if (before == nullptr || joint == nullptr || before->groups == joint->groups) continue;
      const auto fixed = [](const Joint& j) {
        return std::tuple(j.law, j.rise, j.points, j.weibull_modulus, j.weibull_area, j.weibull_seed);
      };
      if (fixed(*before) == fixed(*joint) || !told.insert(joint).second) continue;
      problems.push_back({"", 0, "joint[" + std::to_string(joint - now.joints.data()) + "]",
                          kCannot + std::string("damage and strengths of the state are of this law"),
                          "law, rise, points and weibull keys of " + before->origin.key + " of that run", ""});
    }
  }
}

/// Another name is allowed, another content is not.
void compare_mesh_files(const ParentCase& parent, const Case& now, std::vector<Problem>& problems) {
  const std::filesystem::path &before = parent.input.mesh.file, &file = now.mesh.file;
  const auto known = parent.files.find(before.string());
  const std::string hash = file.empty() ? "" : sha256_of_file(file);
  const bool same_content = known != parent.files.end() && !hash.empty() && hash == known->second;
  if (same_content || (file == before && (hash.empty() || known == parent.files.end()))) return;
  problems.push_back(refused("mesh.file", "mesh.file",
                             "a file with the content that " + before.string() + " had then, or no [mesh]",
                             file.string()));
}

}  // namespace

ParentCase parent_case(const std::string& text, const std::filesystem::path& source,
                       std::map<std::string, std::string> files, std::vector<std::string> volumes) {
  Node root = parse_toml_text(text, source.string());
  std::erase_if(root.entries, [](const auto& entry) {
    return std::find(kOfTheRun.begin(), kOfTheRun.end(), entry.first) != kOfTheRun.end();
  });
  ParentCase parent;
  parent.input = read_case_tree(std::move(root), source, MeshFile::may_be_gone, volumes);
  parent.tree = parse_toml_text(parent.input.resolved, source.string());
  parent.files = std::move(files);
  parent.volumes = std::move(volumes);
  return parent;
}

std::vector<std::string> inherit_sections(const ParentCase& parent, Node& root) {
  std::vector<std::string> inherited;
  for (const Key& key : schema()) {
    if (!key.section().empty() || key.fixed_by_state.empty()) continue;
    const std::string name(key.name());
    const Node* section = parent.tree.find(name);
    if (section == nullptr || root.find(name) != nullptr) continue;
    root.entries.emplace_back(name, *section);
    inherited.push_back(name);
  }
  return inherited;
}

std::vector<Problem> refused_changes(const ParentCase& parent, const Case& now,
                                     const std::vector<std::string>& inherited) {
  const Node tree = parse_toml_text(now.resolved, now.file.string());
  Values before, after;
  collect(parent.tree, "", "", "", before);
  collect(tree, "", "", "", after);
  std::vector<Problem> problems;
  const auto by_groups = [](const std::string& identity) {
    return std::any_of(kByGroups.begin(), kByGroups.end(),
                       [&](std::string_view list) { return identity.starts_with(std::string(list) + "["); });
  };
  for (const auto& [identity, value] : after) {
    const auto other = before.find(identity);
    if (value.pattern == "mesh.file" || (other != before.end() && same(*other->second.node, *value.node))) continue;
    if (other == before.end() && by_groups(identity)) continue;  // entries of pairs that "*" stood for
    problems.push_back(refused(value.key, value.pattern, other == before.end() ? "none" : other->second.node->shown(),
                               value.node->shown()));
  }
  for (const auto& [identity, value] : before) {
    if (after.contains(identity) || by_groups(identity) || value.pattern == "mesh.file") continue;
    problems.push_back(refused(value.key, value.pattern, value.node->shown(), "none"));
  }
  compare_joint_laws(parent, now, problems);
  const bool own_mesh = std::find(inherited.begin(), inherited.end(), "mesh") == inherited.end();
  if (own_mesh && !parent.input.mesh.file.empty()) compare_mesh_files(parent, now, problems);
  const bool touched = any_interacts(parent.input);
  if (touched != any_interacts(now)) {
    problems.push_back({"", 0, "contact", kCannot + std::string("which points may touch is part of the state"),
                        touched ? "a [[contact]]" : "no [[contact]] but with interaction = \"none\"", ""});
  }
  return problems;
}

bool laws_differ(const Case& a, const Case& b) {
  const auto of_group = [](const Material& m) { return m.group; };
  const auto of_groups = [](const auto& entry) { return entry.groups; };
  const auto differ = [](auto p, auto q, auto groups) {
    std::ranges::sort(p, {}, groups);
    std::ranges::sort(q, {}, groups);
    return p != q;
  };
  return differ(a.materials, b.materials, of_group) || differ(a.joints, b.joints, of_groups) ||
         differ(a.contacts, b.contacts, of_groups) || a.sphere != b.sphere;
}

}  // namespace breccia::case_
