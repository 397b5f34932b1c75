#include "case/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "base/printable.hpp"
#include "base/trimmed.hpp"
#include "case/nearest.hpp"

namespace breccia::case_ {
namespace {

struct Unit {
  std::string_view name;
  Dimension dimension;
  int exponent;   // power of ten to SI
  double factor;  // what is not a power of ten
  bool takes_prefix;
};

constexpr std::array<Unit, 16> units{{
    {"m", {{1, 0, 0, 0}}, 0, 1.0, true},
    {"g", {{0, 1, 0, 0}}, -3, 1.0, true},
    {"s", {{0, 0, 1, 0}}, 0, 1.0, true},
    {"rad", {{0, 0, 0, 1}}, 0, 1.0, true},
    {"N", {{1, 1, -2, 0}}, 0, 1.0, true},
    {"Pa", {{-1, 1, -2, 0}}, 0, 1.0, true},
    {"J", {{2, 1, -2, 0}}, 0, 1.0, true},
    {"W", {{2, 1, -3, 0}}, 0, 1.0, true},
    {"Hz", {{0, 0, -1, 0}}, 0, 1.0, true},
    {"bar", {{-1, 1, -2, 0}}, 5, 1.0, true},
    {"l", {{3, 0, 0, 0}}, -3, 1.0, true},
    {"t", {{0, 1, 0, 0}}, 3, 1.0, false},
    {"min", {{0, 0, 1, 0}}, 0, 60.0, false},
    {"h", {{0, 0, 1, 0}}, 0, 3600.0, false},
    {"deg", {{0, 0, 0, 1}}, 0, std::numbers::pi / 180.0, false},
    {"%", {{0, 0, 0, 0}}, -2, 1.0, false},
}};

struct Prefix {
  std::string_view name;
  int exponent;
};

constexpr std::array<Prefix, 12> prefixes{{{"p", -12},
                                           {"n", -9},
                                           {"u", -6},
                                           {"\u00b5", -6},
                                           {"\u03bc", -6},
                                           {"m", -3},
                                           {"c", -2},
                                           {"d", -1},
                                           {"k", 3},
                                           {"M", 6},
                                           {"G", 9},
                                           {"T", 12}}};

struct Named {
  std::string_view name;
  Dimension dimension;
  std::string_view examples;
};

constexpr std::array<Named, 19> dimensions{{
    {"plain number", {{0, 0, 0, 0}}, "no unit, %"},
    {"length", {{1, 0, 0, 0}}, "m, mm, um"},
    {"area", {{2, 0, 0, 0}}, "m2, mm2"},
    {"volume", {{3, 0, 0, 0}}, "m3, mm3, l"},
    {"mass", {{0, 1, 0, 0}}, "kg, g, t"},
    {"time", {{0, 0, 1, 0}}, "s, ms, us, min"},
    {"angle", {{0, 0, 0, 1}}, "deg, rad"},
    {"velocity", {{1, 0, -1, 0}}, "m/s, mm/s, km/h"},
    {"acceleration", {{1, 0, -2, 0}}, "m/s2, mm/ms2"},
    {"force", {{1, 1, -2, 0}}, "N, kN"},
    {"pressure", {{-1, 1, -2, 0}}, "Pa, MPa, GPa, bar, N/mm2"},
    {"pressure rate", {{-1, 1, -3, 0}}, "Pa/s, GPa/s"},
    {"energy", {{2, 1, -2, 0}}, "J, kJ"},
    {"power", {{2, 1, -3, 0}}, "W, kW"},
    {"energy an area", {{0, 1, -2, 0}}, "J/m2, N/m, N/mm"},
    {"density", {{-3, 1, 0, 0}}, "kg/m3, g/cm3, t/m3"},
    {"viscosity", {{-1, 1, -1, 0}}, "Pa s, mPa s"},
    {"frequency", {{0, 0, -1, 0}}, "1/s, Hz, kHz"},
    {"angular velocity", {{0, 0, -1, 1}}, "rad/s, deg/s"},
}};

const Named* named(const Dimension& dimension) {
  const auto it =
      std::find_if(dimensions.begin(), dimensions.end(), [&](const Named& n) { return n.dimension == dimension; });
  return it == dimensions.end() ? nullptr : &*it;
}

// A unit resolved to SI.
struct Scale {
  Dimension dimension;
  int exponent = 0;
  double factor = 1.0;

  void apply(const Scale& other, int power) {
    for (std::size_t i = 0; i < dimension.powers.size(); ++i) dimension.powers[i] += power * other.dimension.powers[i];
    exponent += power * other.exponent;
    for (int i = 0; i < std::abs(power); ++i) factor = power > 0 ? factor * other.factor : factor / other.factor;
  }
};

std::string unknown_unit(std::string_view name) {
  std::vector<std::string> all;
  for (const Unit& u : units) {
    all.emplace_back(u.name);
    if (!u.takes_prefix) continue;
    for (const Prefix& p : prefixes) all.push_back(std::string(p.name) + std::string(u.name));
  }
  // Names are short, so one wrong letter is half of them: only a difference of case or of one letter in three is a
  // hint.
  std::string what = "unknown unit \"" + printable(name) + "\"";
  // Letters of another case: all that are meant perhaps, large units first, as "mpa" is rather MPa than mPa.
  std::vector<std::string> same;
  std::copy_if(all.rbegin(), all.rend(), std::back_inserter(same),
               [&](const std::string& unit) { return edit_distance(name, unit) == 0; });
  if (same.size() > 1) return what + "; did you mean \"" + joined(same, "\" or \"") + "\"?";
  const std::string meant = likely_meant(name, all);
  if (!meant.empty() && (name.size() > 2 || edit_distance(name, meant) == 0))
    what += "; did you mean \"" + meant + "\"?";
  return what;
}

Scale unit_named(std::string_view name) {
  for (const Unit& u : units)
    if (u.name == name) return {u.dimension, u.exponent, u.factor};
  for (const Prefix& p : prefixes) {
    if (!name.starts_with(p.name)) continue;
    for (const Unit& u : units)
      if (u.takes_prefix && name.substr(p.name.size()) == u.name)
        return {u.dimension, u.exponent + p.exponent, u.factor};
  }
  throw UnitError(unknown_unit(name), units_help());
}

constexpr int largest_exponent = 9;
constexpr int deepest_bracket = 8;

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  Scale parse() {
    const Scale scale = product(0);
    if (!rest_.empty()) fail();
    return scale;
  }

 private:
  void skip_spaces() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  [[noreturn]] void fail() const {
    throw UnitError(
        "cannot read the unit at \"" + printable(rest_) + "\"",
        "units multiplied by a space or *, divided by /, with whole exponents, e.g. kg/m3, m/s^2, J/(m2 s)");
  }

  Scale product(int depth) {
    Scale scale;
    skip_spaces();
    int power = take('/') ? -1 : 1;
    while (true) {
      skip_spaces();
      scale.apply(factor(depth), power);
      refuse_absurd(scale);
      skip_spaces();
      if (rest_.empty() || rest_.front() == ')') return scale;
      power = take('/') ? -1 : 1;
      if (power == 1 && !take('*')) take('.');
    }
  }

  Scale factor(int depth) {
    Scale base;
    if (take('(')) {
      if (depth >= deepest_bracket) fail();
      base = product(depth + 1);
      if (!take(')')) fail();
    } else if (take('1')) {
      return base;
    } else {
      base = unit_named(name());
    }
    Scale scale;
    scale.apply(base, power());
    refuse_absurd(scale);
    return scale;
  }

  // Keeps the integer arithmetic of exponents far from overflow for any nesting of the text.
  void refuse_absurd(const Scale& scale) const {
    constexpr int limit = 400;
    const auto absurd = [](int power) { return std::abs(power) > limit; };
    if (absurd(scale.exponent) || std::any_of(scale.dimension.powers.begin(), scale.dimension.powers.end(), absurd))
      fail();
  }

  std::string_view name() {
    std::size_t n = 0;
    const auto in_name = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || (c & 0x80) || c == '%'; };
    while (n < rest_.size() && in_name(rest_[n])) ++n;
    if (n == 0) fail();
    const std::string_view out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }

  int power() {
    const bool written = take('^');
    int value = 1;
    const bool negative = !rest_.empty() && rest_.front() == '-';
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error == std::errc::invalid_argument) {
      if (written || negative) fail();
      return 1;
    }
    if (error != std::errc() || value < -largest_exponent || value > largest_exponent) fail();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  std::string_view rest_;
};

// Length of the number a text begins with; exponent is where its "e..." begins.
struct NumberText {
  std::size_t length = 0;
  std::size_t digits = 0;
  int exponent = 0;
};

NumberText number_at_start(std::string_view text) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
  };
  std::size_t i = !text.empty() && text[0] == '-' ? 1 : 0;
  bool any = false;
  for (; is_digit(i); ++i) any = true;
  if (i < text.size() && text[i] == '.')
    for (++i; is_digit(i); ++i) any = true;
  if (!any) return {};
  NumberText out{i, i, 0};
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t start = i + 1;
    if (start < text.size() && text[start] == '+') ++start;
    const auto [end, error] = std::from_chars(text.data() + start, text.data() + text.size(), out.exponent);
    if (error == std::errc()) out.length = static_cast<std::size_t>(end - text.data());
    if (error == std::errc::result_out_of_range) return {};
  }
  return out;
}

/// Signs that resemble others, as in text from a web page or a word processor: spaces (U+00A0, U+2009, U+202F), and a
/// raised 2 or 3 behind a unit.
std::string with_plain_signs(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSigns{
      {{"\u00a0", " "}, {"\u2009", " "}, {"\u202f", " "}, {"\u00b2", "2"}, {"\u00b3", "3"}}};
  std::string plain(text);
  for (const auto& [sign, meant] : kSigns) {
    for (std::size_t at = plain.find(sign); at != std::string::npos; at = plain.find(sign, at + 1)) {
      const bool behind_unit = at > 0 && std::isalpha(static_cast<unsigned char>(plain[at - 1])) != 0;
      if (meant == " " || behind_unit) plain.replace(at, sign.size(), meant);
    }
  }
  return plain;
}

/// Whether a number continues with a comma: "0,2".
bool has_comma(std::string_view behind_digits) {
  return behind_digits.size() > 1 && behind_digits[0] == ',' &&
         std::isdigit(static_cast<unsigned char>(behind_digits[1])) != 0;
}

std::string units_of(std::string_view unit) {
  const Named* n = named(dimension_of(unit));
  const std::string own(unit);
  if (n == nullptr) return "a number in " + own + " or text with such a unit";
  if (n->dimension == Dimension{}) return "a number without a unit, or in %";
  return "a number in " + own + " or text with a unit of " + std::string(n->name) + ", e.g. " +
         std::string(n->examples);
}

}  // namespace

std::string name_of(const Dimension& dimension) {
  if (const Named* n = named(dimension)) return std::string(n->name);
  constexpr std::array<std::string_view, 4> base{"m", "kg", "s", "rad"};
  std::string out;
  for (std::size_t i = 0; i < base.size(); ++i) {
    if (dimension.powers[i] == 0) continue;
    if (!out.empty()) out += ' ';
    out += base[i];
    if (dimension.powers[i] != 1) out += std::to_string(dimension.powers[i]);
  }
  return out;
}

Quantity parse_quantity(std::string_view given) {
  const std::string plain = with_plain_signs(given);
  std::string_view text = trimmed(plain);
  if (text.starts_with('+')) text.remove_prefix(1);
  const NumberText number = number_at_start(text);
  if (number.length == 0) throw UnitError("does not begin with a number", "a number and a unit, e.g. \"26.6 GPa\"");
  if (has_comma(text.substr(number.length))) throw UnitError("has a comma in its number", kDecimalPoint);
  const std::string_view unit = trimmed(text.substr(number.length));
  const Scale scale = unit.empty() ? Scale{} : UnitParser(unit).parse();

  const int exponent = std::clamp(number.exponent, -100000, 100000) + scale.exponent;
  const std::string decimal = std::string(text.substr(0, number.digits)) + "e" + std::to_string(exponent);
  double value = 0;
  const auto [end, error] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  value *= scale.factor;
  const bool lost = value != 0 && std::abs(value) < smallest_magnitude;
  if (error != std::errc() || !std::isfinite(value) || lost)
    throw UnitError("is a number outside the range of double precision", magnitudes_help());
  return {value, scale.dimension, !unit.empty()};
}

Dimension dimension_of(std::string_view unit) { return UnitParser(unit).parse().dimension; }

double to_si(std::string_view text, std::string_view unit) {
  const Quantity q = parse_quantity(text);
  const Dimension wanted = dimension_of(unit);
  if (q.dimension == wanted) return q.value;
  if (!q.has_unit && q.value == 0) return 0;
  if (!q.has_unit) throw UnitError("the unit is missing", units_of(unit));
  const std::string given = q.dimension == Dimension{} ? "has no dimension" : "is of dimension " + name_of(q.dimension);
  throw UnitError(given + ", not " + name_of(wanted), units_of(unit));
}

std::string magnitudes_help() { return "0, and magnitudes between 1e-307 and 1e308"; }

std::string units_help() {
  std::string out = "units";
  for (const Unit& u : units) out += " " + std::string(u.name);
  out += ", those up to l with a prefix p n u m c d k M G T";
  return out;
}

}  // namespace breccia::case_
