#include "case/reader_groups.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "case/schema.hpp"

namespace breccia::case_ {
namespace {

/// The texts of a list of nothing but texts; none of anything else.
std::vector<std::string> names_of(const Node* list) {
  std::vector<std::string> names;
  if (list == nullptr || !list->is(Node::Kind::list)) return names;
  for (const Node& item : list->items) {
    if (!item.is(Node::Kind::text) || item.text.empty()) return {};
    names.push_back(item.text);
  }
  return names;
}

/// Puts a copy of the entry with one name in place of the list for each of the names.
void append_copies(Node entry, std::string_view key, const std::vector<std::string>& names,
                   std::vector<Node>& entries) {
  Node& value = *entry.find(key);
  value.kind = Node::Kind::text;
  value.items = {};
  for (const std::string& name : names) {
    value.text = name;
    entries.push_back(entry);
  }
}

void expand_entries(Node& list, std::string_view key) {
  std::vector<Node> entries;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    Node& entry = list.items[i];
    entry.place = static_cast<int>(i);
    if (const std::vector<std::string> names = names_of(entry.find(key)); !names.empty())
      append_copies(std::move(entry), key, names, entries);
    else
      entries.push_back(std::move(entry));
  }
  list.items = std::move(entries);
}

bool has_text(const Node& entry, std::string_view key, std::string_view text) {
  const Node* node = entry.find(key);
  return node != nullptr && node->is(Node::Kind::text) && node->text == text;
}

Node* list_of(Node& root, std::string_view name) {
  Node* list = root.find(name);
  return list != nullptr && list->is(Node::Kind::list) ? list : nullptr;
}

/// The groups that entries name, each of a list.
std::set<std::string> named_groups(const Node& entries) {
  std::set<std::string> named;
  for (const Node& entry : entries.items) {
    const Node* group = entry.find("group");
    if (group != nullptr && group->is(Node::Kind::text)) named.insert(group->text);
    for (const std::string& name : names_of(group)) named.insert(name);
  }
  return named;
}

void replace_every_group(Node& entries, const std::vector<Node>& groups) {
  for (Node& entry : entries.items) {
    if (groups.empty() || !has_text(entry, "group", every_group)) continue;
    Node& group = *entry.find("group");
    group.kind = Node::Kind::list;
    group.items = groups;
  }
}

/// "*" of material.group becomes the list of the volume groups that no other entry names.
void list_remaining_volumes(Node& root, std::span<const std::string> volumes) {
  Node* materials = list_of(root, "material");
  if (materials == nullptr) return;
  const std::set<std::string> named = named_groups(*materials);
  std::vector<Node> remaining;
  for (const std::string& volume : volumes) {
    if (named.contains(volume)) continue;
    remaining.emplace_back().kind = Node::Kind::text;
    remaining.back().text = volume;
  }
  replace_every_group(*materials, remaining);
}

/// "*" of joint.group becomes the list of the groups with joints that no other entry names, unless a material of "*" is
/// for groups that are not known yet: then it stays.
void list_remaining_groups(Node& root, bool drop_unused) {
  Node *materials = list_of(root, "material"), *joints = list_of(root, "joint");
  if (materials == nullptr || joints == nullptr || named_groups(*materials).contains(every_group)) return;
  std::set<std::string> named = named_groups(*joints);
  std::vector<Node> remaining;
  for (const Node& material : materials->items) {
    const Node* group = material.find("group");
    if (group != nullptr && group->is(Node::Kind::text) && !has_text(material, "joints", "none") &&
        named.insert(group->text).second)
      remaining.push_back(*group);
  }
  replace_every_group(*joints, remaining);
  if (drop_unused)
    std::erase_if(joints->items, [](const Node& joint) { return has_text(joint, "group", every_group); });
}

/// @param pattern  of the key below the table: "constraint[].group"
void expand_below(Node& table, std::string_view pattern) {
  const std::size_t brackets = pattern.find("[].");
  const std::string_view rest = pattern.substr(brackets + 3);
  Node* list = table.find(pattern.substr(0, brackets));
  if (list == nullptr || !list->is(Node::Kind::list)) return;
  if (rest.find("[].") == std::string_view::npos) return expand_entries(*list, rest);
  for (Node& entry : list->items) expand_below(entry, rest);
}

}  // namespace

void expand_groups(Node& root, std::span<const std::string> volumes, bool drop_unused) {
  list_remaining_volumes(root, volumes);
  for (const Key& key : schema()) {  // materials before joints
    if (key.type != ValueType::text_or_list) continue;
    if (key.path == "joint[].group") list_remaining_groups(root, drop_unused && !volumes.empty());
    expand_below(root, key.path);
  }
}

std::string written_path(const Node& root, std::string_view path) {
  std::string written;
  for (const Node* node = &root; !path.empty();) {
    const std::size_t end = std::min(path.find_first_of(".[", 1), path.size());
    std::string step(path.substr(0, end));
    path.remove_prefix(end);
    if (node != nullptr && step.starts_with('[')) {
      std::size_t index = 0;
      std::from_chars(step.data() + 1, step.data() + step.size(), index);
      node = index < node->items.size() ? &node->items[index] : nullptr;
      if (node != nullptr && node->place >= 0) step = "[" + std::to_string(node->place) + "]";
    } else if (node != nullptr) {
      node = node->find(step.starts_with('.') ? std::string_view(step).substr(1) : std::string_view(step));
    }
    written += step;
  }
  return written;
}

}  // namespace breccia::case_
