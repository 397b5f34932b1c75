#include "case/reader_overrides.hpp"

#include <algorithm>
#include <charconv>

#include "case/nearest.hpp"
#include "case/schema.hpp"

namespace breccia::case_ {
namespace {

constexpr const char* kSource = "--set";

std::string name_of_entry(const Node& entry) {
  for (const char* key : {"name", "group", "surface"})
    if (const Node* n = entry.find(key); n != nullptr && n->is(Node::Kind::text)) return n->text;
  return {};
}

std::string quoted_or_none(const std::vector<std::string>& names) { return names.empty() ? "none" : joined(names); }

// Walks one path down the tree, making tables the schema knows, and puts the value at its end.
class Setter {
 public:
  Setter(const std::string& override_text, std::vector<Problem>& problems)
      : text_(override_text), problems_(problems) {}

  void set(Node& root, std::string_view path, Node value) {
    rest_ = path;
    Node* node = &root;
    std::string pattern;
    bool inside_value = false;  // below a value, names are the user's or are checked when the value is read
    while (true) {
      const std::string_view name = take_name();
      if (name.empty() || name.starts_with('<')) return problem("is no key", "a dotted path such as material[0].young");
      node = inside_value ? child(*node, name, Node::Kind::table) : known_child(*node, name, pattern, inside_value);
      while (node != nullptr && rest_.starts_with('[')) node = indexed(*node);
      if (node == nullptr) return;
      if (rest_.empty()) break;
      if (!rest_.starts_with('.')) return problem("cannot be read at \"" + std::string(rest_) + "\"", "a dotted path");
      rest_.remove_prefix(1);
    }
    *node = std::move(value);
  }

 private:
  static bool takes_names(const Key& key) {
    return key.type == ValueType::parameters || key.type == ValueType::settings ||
           key.type == ValueType::axis_functions || key.type == ValueType::function ||
           key.type == ValueType::function_vector;
  }

  void problem(const std::string& what, const std::string& allowed) {
    problems_.push_back({kSource, 0, text_.substr(0, text_.find('=')), what, allowed, text_});
  }

  // The child that the schema knows under this name; the name is appended to the pattern.
  Node* known_child(Node& table, std::string_view name, std::string& pattern, bool& is_value) {
    pattern += (pattern.empty() ? "" : ".") + std::string(name);
    const bool is_list = find_key(pattern + "[]") != nullptr;
    const Key* key = find_key(pattern);
    if (!is_list && key == nullptr) return unknown(pattern);
    Node* node = child(table, name, is_list ? Node::Kind::list : Node::Kind::table);
    if (node != nullptr && is_list && !rest_.empty()) {
      pattern += "[]";
      return entry(*node);
    }
    is_value = !is_list && !key->is_section();
    if (is_value && rest_.starts_with('.') && !takes_names(*key)) {
      problem("has no keys below it", allowed_text(*key));
      return nullptr;
    }
    return node;
  }

  std::string_view take_name() {
    const std::size_t n = std::min(rest_.find_first_of(".["), rest_.size());
    const std::string_view name = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return name;
  }

  Node* unknown(const std::string& pattern) {
    const std::vector<std::string> similar = similar_keys(pattern, 3);
    const std::size_t dot = pattern.rfind('.');
    const std::string section = dot == std::string::npos ? "" : pattern.substr(0, dot);
    problem(similar.empty() ? "unknown key" : "unknown key; did you mean " + joined(similar, " or ") + "?",
            "keys of " + (section.empty() ? "a case" : section) + ": " + joined(names_in(section)));
    return nullptr;
  }

  Node* child(Node& table, std::string_view name, Node::Kind made) {
    if (!table.is(Node::Kind::table)) {
      problem("is below " + std::string(table.kind_name()) + ", which has no keys", "");
      return nullptr;
    }
    if (Node* existing = table.find(name)) return existing;
    Node fresh;
    fresh.kind = made;
    fresh.file = kSource;
    return &table.entries.emplace_back(std::string(name), std::move(fresh)).second;
  }

  Node* indexed(Node& list) {
    std::size_t index = 0;
    const char* begin = rest_.data() + 1;
    const auto [end, error] = std::from_chars(begin, rest_.data() + rest_.size(), index);
    if (error != std::errc() || end == rest_.data() + rest_.size() || *end != ']') {
      problem("has no whole number in its brackets", "an index from 0, e.g. material[0]");
      return nullptr;
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()) + 1);
    if (!list.is(Node::Kind::list) || index >= list.items.size()) {
      const std::size_t size = list.is(Node::Kind::list) ? list.items.size() : 0;
      problem("index " + std::to_string(index) + " is past the end",
              size == 0 ? "the list has no entries" : "0 to " + std::to_string(size - 1));
      return nullptr;
    }
    return &list.items[index];
  }

  Node* entry(Node& list) {
    if (rest_.starts_with('[')) return indexed(list);
    rest_.remove_prefix(1);
    Node* found = nullptr;
    std::size_t length = 0, matches = 0;
    std::vector<std::string> names;
    for (Node& item : list.items) {
      const std::string name = name_of_entry(item);
      if (name.empty()) continue;
      names.push_back(name);
      const bool fits = rest_ == name || rest_.starts_with(name + ".") || rest_.starts_with(name + "[");
      if (!fits || name.size() < length) continue;
      matches = name.size() > length ? 1 : matches + 1;
      length = name.size();
      found = &item;
    }
    if (matches != 1) {
      problem(matches == 0 ? "no entry of the list has this name"
                           : "several entries of the list have this name, use an index",
              "an index in brackets, or a name: " + quoted_or_none(names));
      return nullptr;
    }
    rest_.remove_prefix(length);
    return found;
  }

  const std::string& text_;
  std::vector<Problem>& problems_;
  std::string_view rest_;
};

}  // namespace

void apply_overrides(Node& root, std::span<const std::string> overrides, std::vector<Problem>& problems) {
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      problems.push_back({kSource, 0, "", "no \"=\" in an override", "key=value", text});
      continue;
    }
    std::string path = text.substr(0, equals);
    while (path.ends_with(' ')) path.pop_back();
    try {
      Node changed = root;  // a path that fails half-way leaves no tables behind
      const std::size_t before = problems.size();
      Setter(text, problems).set(changed, path, parse_toml_value(std::string_view(text).substr(equals + 1), kSource));
      if (problems.size() == before) root = std::move(changed);
    } catch (const InputError& e) {
      for (Problem p : e.problems()) {
        p.key = path;
        problems.push_back(std::move(p));
      }
    }
  }
}

}  // namespace breccia::case_
