#include "case/reader_keys.hpp"

#include <algorithm>
#include <charconv>

namespace breccia::case_ {
namespace {

void check_table(const Node& table, const std::string& path, const std::string& pattern, ValueReader& values);

void check_list(const Node& list, const Key& key, const std::string& path, ValueReader& values) {
  const bool of_tables =
      list.is(Node::Kind::list) &&
      std::all_of(list.items.begin(), list.items.end(), [](const Node& item) { return item.is(Node::Kind::table); });
  if (!of_tables) return values.problem(list, path, "is " + std::string(list.kind_name()), allowed_text(key), "");
  for (std::size_t i = 0; i < list.items.size(); ++i)
    check_table(list.items[i], path + "[" + std::to_string(i) + "]", std::string(key.path), values);
}

void check_table(const Node& table, const std::string& path, const std::string& pattern, ValueReader& values) {
  for (const auto& [name, node] : table.entries) {
    const std::string own = path.empty() ? name : path + "." + name;
    const std::string own_pattern = pattern.empty() ? name : pattern + "." + name;
    const Key* key = find_key(own_pattern);
    if (const Key* list = find_key(own_pattern + "[]")) {
      check_list(node, *list, own, values);
    } else if (key == nullptr || key->type == ValueType::notation || key->type == ValueType::section_list) {
      values.unknown_key(node, own, own_pattern);
    } else if (key->type == ValueType::section) {
      if (node.is(Node::Kind::table))
        check_table(node, own, own_pattern, values);
      else
        values.problem(node, own, "is " + std::string(node.kind_name()), allowed_text(*key), node.shown());
    }
  }
}

}  // namespace

void check_keys(const Node& table, ValueReader& values) { check_table(table, "", "", values); }

const Node& deepest_on_path(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (!path.empty()) {
    if (path.front() == '.') path.remove_prefix(1);
    const std::size_t n = std::min(path.find_first_of(".["), path.size());
    const Node* next = nullptr;
    if (n > 0) {
      next = node->find(path.substr(0, n));
      path.remove_prefix(n);
    } else {
      std::size_t index = 0;
      std::from_chars(path.data() + 1, path.data() + path.size(), index);
      if (index < node->items.size()) next = &node->items[index];
      path.remove_prefix(std::min(path.find(']'), path.size() - 1) + 1);
    }
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

}  // namespace breccia::case_
