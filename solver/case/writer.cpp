#include "case/writer.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <type_traits>
#include <utility>

#include "case/bindings.hpp"
#include "case/nearest.hpp"

namespace breccia::case_ {
namespace {

std::string toml(double x) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  std::string out(buffer.data(), end);
  // Digits alone would come back as an integer, which TOML limits to 64 bits.
  if (out.find_first_not_of("-0123456789") == std::string::npos) out += ".0";
  return out;
}
std::string toml(bool x) { return x ? "true" : "false"; }
std::string toml(int x) { return std::to_string(x); }
std::string toml(std::int64_t x) { return std::to_string(x); }
std::string toml(std::uint64_t x) { return std::to_string(x); }
std::string toml(const std::string& x) { return toml_text(x); }
std::string toml(const std::filesystem::path& x) { return toml_text(x.string()); }
std::string toml(const TimeFunction& f);

template <class List>
std::string toml_list(const List& list) {
  std::vector<std::string> parts;
  parts.reserve(list.size());
  for (const auto& x : list) parts.push_back(toml(x));
  return "[" + joined(parts) + "]";
}
std::string toml(const std::vector<std::string>& x) { return toml_list(x); }
std::string toml(const Vec3& x) { return toml_list(std::array{x.x(), x.y(), x.z()}); }

std::string toml(const std::map<std::string, double>& x) {
  std::vector<std::string> parts;
  parts.reserve(x.size());
  for (const auto& [name, value] : x) parts.push_back(toml_text(name) + " = " + toml(value));
  return "{" + joined(parts) + "}";
}

std::string toml(const std::map<std::string, Setting>& x) {
  std::vector<std::string> parts;
  parts.reserve(x.size());
  for (const auto& [name, value] : x)
    parts.push_back(toml_text(name) + " = " + (value.text ? toml(*value.text) : toml(value.number.value_or(0))));
  return "{" + joined(parts) + "}";
}

std::string toml(const TimeFunction& f) {
  if (f.linear == 0 && f.sines.empty() && f.table.empty()) return toml(f.constant);
  std::vector<std::string> parts{"constant = " + toml(f.constant), "linear = " + toml(f.linear)};
  std::vector<std::string> sines, points;
  for (const auto& s : f.sines)
    sines.push_back("{amplitude = " + toml(s.amplitude) + ", frequency = " + toml(s.frequency) +
                    ", phase = " + toml(s.phase) + "}");
  for (const auto& p : f.table) points.push_back("[" + toml(p.time) + ", " + toml(p.value) + "]");
  if (!sines.empty()) parts.push_back("sine = [" + joined(sines) + "]");
  if (!points.empty()) parts.push_back("table = [" + joined(points) + "]");
  return "{" + joined(parts) + "}";
}

template <class T, std::size_t N>
std::string toml(const std::array<T, N>& x) {
  return toml_list(x);
}

std::string toml_axes(const std::array<bool, 3>& axes) {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i)
    if (axes[i]) out += "xyz"[i];
  return toml_text(out);
}

// Archive that writes one section: its own keys first, then the sections inside it, as TOML wants them.
class SectionWriter {
 public:
  static constexpr bool reads = false;

  SectionWriter(std::string path, std::string pattern, std::string header)
      : path_(std::move(path)), pattern_(std::move(pattern)), header_(std::move(header)) {}

  void origin(const Origin&) const {}

  template <class T>
  void value(std::string_view name, const T& x) {
    const Key& key = row(name);
    if constexpr (std::is_same_v<T, double>) {
      if (x == 0 && !key.word.empty()) return add(key, toml_text(std::string(key.word)));
      // For keys without a default zero means "not given".
      const bool optional = !key.required && (key.fallback.empty() || key.fallback.starts_with('='));
      if (x == 0 && optional) return;
    }
    if constexpr (std::is_same_v<T, std::array<bool, 3>>)
      add(key, toml_axes(x));
    else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
      add(key, toml(x), static_cast<double>(x));
    else
      add(key, toml(x));
  }

  template <class Choice>
  void choice(std::string_view name, Choice x) {
    add(row(name), toml_text(row(name).choice_list().at(static_cast<std::size_t>(x))));
  }

  void axis_functions(std::string_view name, const std::array<bool, 3>& axes,
                      const std::array<TimeFunction, 3>& functions) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < 3; ++i)
      if (axes[i]) parts.push_back(std::string(1, "xyz"[i]) + " = " + toml(functions[i]));
    add(row(name), "{" + joined(parts) + "}");
  }

  template <class Visitor>
  void section(std::string_view name, Visitor visit) {
    SectionWriter inner(below(path_, name), below(pattern_, name), "[" + below(path_, name) + "]");
    visit(inner);
    inner_.push_back(std::move(inner));
  }

  template <class T>
  void optional_section(std::string_view name, std::optional<T>& x) {
    if (x) section(name, [&](auto& s) { bind(s, *x); });
  }

  template <class T>
  void list(std::string_view name, std::vector<T>& items) {
    for (T& item : items) {
      SectionWriter inner(below(path_, name), below(pattern_, name) + "[]", "[[" + below(path_, name) + "]]");
      bind(inner, item);
      inner_.push_back(std::move(inner));
    }
  }

  [[nodiscard]] std::string text() const {
    std::string out = header_.empty() ? "" : "\n" + header_ + "\n";
    for (const WrittenKey& written : keys_) out += line(written);
    for (const SectionWriter& inner : inner_) out += inner.text();
    return out;
  }

  /// Its own and those of the sections inside it.
  [[nodiscard]] std::vector<WrittenKey> all_keys() && {
    std::vector<WrittenKey> all = std::move(keys_);
    for (SectionWriter& inner : inner_) {
      std::vector<WrittenKey> more = std::move(inner).all_keys();
      std::move(more.begin(), more.end(), std::back_inserter(all));
    }
    return all;
  }

 private:
  static std::string below(const std::string& path, std::string_view name) {
    return path + (path.empty() ? "" : ".") + std::string(name);
  }
  [[nodiscard]] const Key& row(std::string_view name) const { return key_of(below(pattern_, name)); }
  void add(const Key& key, std::string value, std::optional<double> number = std::nullopt) {
    keys_.push_back({&key, std::move(value), number});
  }
  static std::string line(const WrittenKey& written) {
    const Key& key = *written.key;
    return std::string(key.name()) + " = " + written.value + (key.unit == "1" ? "" : "  # " + std::string(key.unit)) +
           "\n";
  }

  std::string path_, pattern_, header_;
  std::vector<WrittenKey> keys_;
  std::vector<SectionWriter> inner_;
};

/// @param entry  a copy, as in write_case()
template <class T>
std::vector<WrittenKey> keys_of_entry(std::string_view list, T entry) {
  SectionWriter writer("", std::string(list) + "[]", "");
  bind(writer, entry);
  return std::move(writer).all_keys();
}

}  // namespace

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(c));
      out += escaped.data();
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string write_case(const Case& c) {
  Case copy = c;  // archives walk members by reference, the reader writes to them
  SectionWriter writer("", "", "");
  bind(writer, copy);
  return "# The case with every default written out, in SI units.\n" + writer.text();
}

std::vector<WrittenKey> written_keys(const Material& material) { return keys_of_entry("material", material); }
std::vector<WrittenKey> written_keys(const Joint& joint) { return keys_of_entry("joint", joint); }
std::vector<WrittenKey> written_keys(const Contact& contact) { return keys_of_entry("contact", contact); }

}  // namespace breccia::case_
