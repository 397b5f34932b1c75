#include "case/explain.hpp"

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "case/nearest.hpp"
#include "case/schema.hpp"
#include "case/topics.hpp"
#include "case/units.hpp"

namespace breccia::case_ {
namespace {

constexpr std::size_t name_width = 20;
constexpr std::size_t default_width = 19;
constexpr std::size_t text_width = 112;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text + " ";
}

std::string default_text(const Key& key) {
  if (key.required) return "required";
  if (key.fallback.empty()) return "optional";
  if (key.fallback.starts_with('=')) return "as " + std::string(key.fallback.substr(2));
  return std::string(key.fallback);
}

std::string unit_text(const Key& key) {
  if (key.unit == "1") return "";
  return key.unit.starts_with('*') ? "(unit of the value)" + std::string(key.unit.substr(1)) : std::string(key.unit);
}

std::string wrapped(const std::string& text, const std::string& indent) {
  std::string out, line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > text_width) {
      out += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return line.empty() ? out : out + indent + line + "\n";
}

std::string first_sentence(std::string_view help) {
  const std::size_t end = help.find(". ");
  return std::string(end == std::string_view::npos ? help : help.substr(0, end + 1));
}

std::string line_of(const Key& key) {
  const std::string unit = key.unit == "1" || key.unit.starts_with('*') ? "" : " [" + std::string(key.unit) + "]";
  const std::string columns =
      "  " + padded(std::string(key.name()), name_width) + padded(default_text(key), default_width);
  const std::string meaning = wrapped(first_sentence(key.help) + unit, std::string(columns.size(), ' '));
  return columns + meaning.substr(columns.size());
}

/// The keys and sections of a section, "" for the top: those that any user needs first.
std::string lines_of(const Key* section, bool all) {
  const std::string_view path = section != nullptr ? section->path : "";
  std::string basic, expert;
  std::vector<std::string> names;
  const bool none_basic = section != nullptr && level_of(*section) == Level::expert;
  for (const Key& key : schema()) {
    if (key.section() != path || (section == nullptr && key.is_section())) continue;
    const bool first = none_basic || key.required || level_of(key) == Level::basic;
    (first ? basic : expert) += key.is_section() ? "  " + header_of(key) + "\n" : line_of(key);
    if (!first) names.push_back(key.is_section() ? header_of(key) : std::string(key.name()));
  }
  if (all || names.empty()) return basic + expert;
  return basic + wrapped("expert (--all): " + joined(names), "  ");
}

std::string section_text(const Key& section, bool all) {
  std::string out = header_of(section) + "\n" + wrapped(std::string(section.help), "  ");
  if (!section.fixed_by_state.empty()) out += wrapped("With [start]: " + start_rule(section) + ".", "  ");
  return out + lines_of(&section, all);
}

std::string key_text(const Key& key) {
  std::string out = plain_path(key.path) + "\n" + wrapped(std::string(key.help), "  ");
  const auto field = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) out += "  " + padded(name, 8) + text + "\n";
  };
  std::string allowed = allowed_text(key);
  if (const std::size_t star = allowed.find(" in *"); star != std::string::npos)
    allowed.replace(star, 4 + key.unit.size(), " in " + unit_text(key));
  if (key.level == Level::expert) field("level", "expert");
  field("start", start_rule(key));
  field("default", default_text(key));
  field("unit", unit_text(key));
  field("choices", joined(key.choice_list()));
  field("range", key.range.text());
  field("allowed", allowed);
  field("example", std::string(key.name()) + " = " + std::string(key.example));
  return out;
}

std::string text_of(const Key& key, bool all) { return key.is_section() ? section_text(key, all) : key_text(key); }

std::string topic_text(std::string_view word, const Topic& topic) {
  std::string keys(topic.keys);
  for (std::size_t at = keys.find('|'); at != std::string::npos; at = keys.find('|', at)) keys.replace(at, 1, ", ");
  return std::string(word) + "\n" + wrapped(std::string(topic.answer), "  ") + "  " + padded("keys", 8) + keys + "\n";
}

/// A word as names of keys are written: "Strain rate" is strain_rate.
std::string as_name(std::string_view word) {
  std::string name(word);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(c)); });
  return name;
}

/// Keys in whose name a word stands, then those whose help has it; of many the first, and how many more there are.
std::vector<std::string> keys_that_say(const std::string& word) {
  constexpr std::size_t kShortest = 4, kMost = 8;
  std::vector<std::string> names, helps;
  if (word.size() < kShortest) return names;
  for (const Key& row : schema()) {
    if (row.name().find(word) != std::string_view::npos)
      names.push_back(plain_path(row.path));
    else if (std::string_view(row.help).find(word) != std::string_view::npos)
      helps.push_back(plain_path(row.path));
  }
  names.insert(names.end(), helps.begin(), helps.end());
  if (names.size() > kMost) {
    const std::size_t more = names.size() - kMost;
    names.resize(kMost);
    names.push_back("and " + std::to_string(more) + " more");
  }
  return names;
}

}  // namespace

std::string explain_all(bool experts) {
  std::string out =
      "Keys of a case file (TOML): name, default, meaning [SI unit]. Numbers are SI; texts may carry a unit, "
      "\"26.6 GPa\".\n" +
      wrapped(units_help(), "") +
      "`breccia explain KEY` describes one key; `breccia explain notch` finds the keys for a term of the field.\n\n";
  out += lines_of(nullptr, experts);
  std::vector<std::string> others;
  for (const Key& key : schema()) {
    if (!key.is_section()) continue;
    if (experts || level_of(key) == Level::basic)
      out += "\n" + section_text(key, experts);
    else
      others.push_back(header_of(key));
  }
  if (!others.empty())
    out += "\n" + wrapped("Sections for experts: " + joined(others) + ". `breccia explain --all` lists all keys.", "");
  return out;
}

std::string explain(std::string_view key, bool experts) {
  const std::string wanted = plain_path(key);
  std::string by_name;
  for (const Key& row : schema()) {
    if (plain_path(row.path) == wanted) return text_of(row, experts);
    if (row.name() == wanted) by_name += (by_name.empty() ? "" : "\n") + text_of(row, experts);
  }
  if (!by_name.empty()) return by_name;

  // material.glass.joints, as --set takes it: the name of an entry of a list, which the schema does not know.
  const std::size_t first = wanted.find('.'), second = wanted.find('.', first == std::string::npos ? first : first + 1);
  if (second != std::string::npos) {
    const std::string section = wanted.substr(0, first), rest = wanted.substr(second);
    for (const Key& row : schema())
      if (row.path.starts_with(section + "[]") && plain_path(row.path) == section + rest) return text_of(row, experts);
  }

  if (const Topic* topic = topic_of(key)) return topic_text(key, *topic);
  for (const Key& row : schema())
    if (row.name() == as_name(key)) by_name += (by_name.empty() ? "" : "\n") + text_of(row, experts);
  if (!by_name.empty()) return by_name;

  std::vector<std::string> paths;
  for (const std::string& path : similar_keys(pattern_of(key), 3)) paths.push_back(plain_path(path));
  const std::vector<std::string> speaking = paths.empty() ? keys_that_say(wanted) : std::vector<std::string>{};
  std::vector<std::string> sections;
  for (const Key& row : schema())
    if (row.section().empty()) sections.push_back(plain_path(row.path));
  throw InputError({"", 0, std::string(key),
                    !paths.empty()      ? "unknown key; did you mean " + joined(paths, " or ") + "?"
                    : !speaking.empty() ? "unknown key; the word stands in " + joined(speaking)
                                        : "unknown key",
                    "sections and keys of a case: " + joined(sections), ""});
}

}  // namespace breccia::case_
