#include "case/expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "case/nearest.hpp"
#include "case/units.hpp"

namespace breccia::case_ {
namespace {

constexpr std::size_t kMostNodes = 1000;
constexpr int kDeepest = 50;
/// Times of the history are sums of steps: their round-off must not delay what has lasted long enough.
constexpr double kTimeRoundOff = 1e-9;

constexpr const char* kForm =
    "comparisons such as broken_joints > 100, plate.reaction_z < -5 kN or kinetic < 0.01 * peak(kinetic) for 2 ms, "
    "joined by and, or";

/// Of a sum; nothing: a number that fits any.
using Measure = std::optional<Dimension>;

bool in_word(char c) {
  const auto sign = static_cast<unsigned char>(c);
  return std::isalnum(sign) != 0 || c == '_' || c == '.' || sign >= 0x80;
}
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::size_t length_of_number(std::string_view text) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t first = i;
    while (i < text.size() && is_digit(text[i])) ++i;
    return i > first;
  };
  bool any = digits();
  if (i < text.size() && text[i] == '.') {
    ++i;
    any = digits() || any;
  }
  if (!any) return 0;
  const std::size_t mantissa = i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    if (!digits()) i = mantissa;
  }
  return i;
}

/// A unit without spaces: "kN", "m/s^2", "N.m", "%".
std::size_t length_of_unit(std::string_view text) {
  const auto begins = [&](std::size_t i) {
    if (i >= text.size()) return false;
    const auto sign = static_cast<unsigned char>(text[i]);
    return std::isalpha(sign) != 0 || text[i] == '%' || sign >= 0x80;
  };
  if (!begins(0)) return 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const bool joins = (text[i] == '/' || text[i] == '.' || text[i] == '*') && begins(i + 1);
    const bool power = text[i] == '^' || (text[i] == '-' && text[i - 1] == '^');
    if (!joins && !power && !begins(i) && !is_digit(text[i])) break;
    ++i;
  }
  return i;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return "\"" + printable(text.substr(0, kShown)) + (text.size() > kShown ? "..." : "") + "\"";
}

/// The names near one that there is not, those with its last part first: of "bar.force_x" it is "force_x".
std::string names_near(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kNamed = 12;
  std::vector<std::string> near = nearest_first(name, known);
  const std::string last = name.substr(name.rfind('.') + 1);
  std::stable_partition(near.begin(), near.end(),
                        [&](const std::string& word) { return word.find(last) != std::string::npos; });
  if (near.size() <= kNamed) return joined(near);
  return joined(std::span(near).first(kNamed)) + " and " + std::to_string(near.size() - kNamed) + " more";
}

std::string name_of_measure(const Measure& unit) { return unit ? name_of(*unit) : "plain number"; }

}  // namespace

/// Reads a text from left to right, by recursive descent.
class ExpressionParser {
 public:
  ExpressionParser(Expression& made, std::span<const HistoryColumn> columns)
      : made_(made), columns_(columns), rest_(made.text_) {}

  void parse() {
    const Operand all = condition();
    skip_spaces();
    if (!rest_.empty()) fail("an operator or the end");
    if (!all.is_condition) throw ExpressionError("is a number, not a condition", kForm);
  }

 private:
  using Kind = Expression::Kind;
  using Node = Expression::Node;
  struct Operand {
    std::size_t node = 0;
    bool is_condition = false;
    Measure unit{};
  };

  void skip_spaces() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) rest_.remove_prefix(1);
  }
  [[noreturn]] void fail(const std::string& wanted) const {
    throw ExpressionError("is not a condition: " + wanted + " is missing " +
                              (rest_.empty() ? "at its end" : "before " + in_quotes(rest_)),
                          kForm);
  }
  bool take(std::string_view sign) {
    skip_spaces();
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }
  [[nodiscard]] std::string_view next_word() {
    skip_spaces();
    return rest_.substr(
        0, static_cast<std::size_t>(std::find_if_not(rest_.begin(), rest_.end(), in_word) - rest_.begin()));
  }
  bool take_word(std::string_view word) { return next_word() == word && take(word); }

  std::size_t add(Node node) {
    if (made_.nodes_.size() >= kMostNodes)
      throw ExpressionError("is too long", "at most " + std::to_string(kMostNodes) + " names, numbers and operators");
    made_.nodes_.push_back(std::move(node));
    return made_.nodes_.size() - 1;
  }
  /// Both operands must be conditions, or numbers.
  void demand(const Operand& operand, bool is_condition, const std::string& by) const {
    if (operand.is_condition == is_condition) return;
    throw ExpressionError(by + (is_condition ? " joins conditions, not numbers" : " takes numbers, not conditions"),
                          kForm);
  }

  Operand condition() {
    Operand left = all();
    while (take_word("or")) left = joined_by(Kind::either, "or", left, all());
    return left;
  }
  Operand all() {
    Operand left = lasting();
    while (take_word("and")) left = joined_by(Kind::both, "and", left, lasting());
    return left;
  }
  Operand joined_by(Kind kind, const std::string& word, const Operand& left, const Operand& right) {
    demand(left, true, word);
    demand(right, true, word);
    return {add({kind, left.node, right.node}), true};
  }

  Operand lasting() {
    Operand held = relation();
    while (take_word("for")) {
      demand(held, true, "for");
      skip_spaces();
      const auto [value, unit] = quantity();
      if (unit && *unit != dimension_of("s"))
        throw ExpressionError("the duration behind for is of dimension " + name_of_measure(unit),
                              "a time, such as 2 ms");
      held.node = add({Kind::lasting, held.node, 0, value, made_.num_cells_++});
    }
    return held;
  }

  Operand relation() {
    const Operand left = sum();
    constexpr std::array<std::pair<const char*, Kind>, 4> kSigns{
        {{"<=", Kind::less_or_equal}, {">=", Kind::greater_or_equal}, {"<", Kind::less}, {">", Kind::greater}}};
    for (const auto& [sign, kind] : kSigns) {
      if (!take(sign)) continue;
      const Operand right = sum();
      (void)common_unit(left, right, sign);  // they must have one
      return {add({kind, left.node, right.node}), true};
    }
    return left;
  }

  /// Of two numbers that are added or compared.
  Measure common_unit(const Operand& left, const Operand& right, const std::string& sign) const {
    demand(left, false, sign);
    demand(right, false, sign);
    if (left.unit && right.unit && *left.unit != *right.unit)
      throw ExpressionError("has two dimensions on the two sides of " + sign + ": " + name_of_measure(left.unit) +
                                " and " + name_of_measure(right.unit),
                            "two of one dimension; a number without a unit fits any");
    return left.unit ? left.unit : right.unit;
  }

  Operand sum() {
    Operand left = product();
    while (true) {
      const bool plus = take("+");
      if (!plus && !take("-")) return left;
      const Operand right = product();
      const Measure unit = common_unit(left, right, plus ? "+" : "-");
      left = {add({plus ? Kind::sum : Kind::difference, left.node, right.node}), false, unit};
    }
  }

  Operand product() {
    Operand left = factor();
    while (true) {
      const bool times = take("*");
      if (!times && !take("/")) return left;
      const Operand right = factor();
      demand(left, false, times ? "*" : "/");
      demand(right, false, times ? "*" : "/");
      left = {add({times ? Kind::product : Kind::quotient, left.node, right.node}), false,
              unit_of_product(left.unit, right.unit, times ? 1 : -1)};
    }
  }
  /// A number without a unit is a factor.
  static Measure unit_of_product(const Measure& left, const Measure& right, int power) {
    if (!left && !right) return {};
    Dimension unit = left.value_or(Dimension{});
    for (std::size_t i = 0; right && i < unit.powers.size(); ++i) unit.powers[i] += power * right->powers[i];
    return unit;
  }

  Operand factor() {
    if (++depth_ > kDeepest) throw ExpressionError("has too many brackets", "at most " + std::to_string(kDeepest));
    const Operand made = factor_at_depth();
    --depth_;
    return made;
  }
  Operand factor_at_depth() {
    skip_spaces();
    if (take("-")) {
      const Operand of = factor();
      demand(of, false, "-");
      return {add({Kind::negative, of.node}), false, of.unit};
    }
    if (take("(")) {
      const Operand inner = condition();
      if (!take(")")) fail("\")\"");
      return inner;
    }
    if (length_of_number(rest_) > 0) {
      const auto [value, unit] = quantity();
      return {add({Kind::number, 0, 0, value}), false, unit};
    }
    const std::string_view word = next_word();
    for (const auto& [name, kind] :
         {std::pair{"peak", Kind::peak}, {"lowest", Kind::lowest}, {"abs", Kind::absolute}}) {
      if (word == name) return function(name, kind);
    }
    return column();
  }

  Operand function(const std::string& name, Kind kind) {
    const std::string_view from = rest_;
    take(name);
    if (!take("(")) fail("\"(\" behind " + name);
    const Operand of = sum();
    if (!take(")")) fail("\")\"");
    demand(of, false, name + "()");
    Node node{kind, of.node};
    if (kind != Kind::absolute) {
      node.place = made_.num_cells_++;
      node.text = std::string(from.substr(0, from.size() - rest_.size()));
      node.unit = made_.nodes_[of.node].unit;
    }
    return {add(node), false, of.unit};
  }

  /// A number and its unit, in SI.
  std::pair<double, Measure> quantity() {
    const std::size_t number = length_of_number(rest_);
    if (number == 0) fail("a number");
    std::string text(rest_.substr(0, number));
    rest_.remove_prefix(number);
    const std::string_view word = next_word();
    const bool ends = word == "and" || word == "or" || word == "for";
    if (const std::size_t unit = ends ? 0 : length_of_unit(rest_); unit > 0) {
      text += " " + std::string(rest_.substr(0, unit));
      rest_.remove_prefix(unit);
    }
    try {
      const Quantity read = parse_quantity(text);
      return {read.value, read.has_unit ? Measure(read.dimension) : Measure()};
    } catch (const UnitError& error) {
      throw ExpressionError(in_quotes(text) + ": " + error.what(), error.allowed);
    }
  }

  Operand column() {
    const std::string_view from = rest_;
    if (take("'")) {
      const std::size_t end = rest_.find('\'');
      if (end == std::string_view::npos) fail("the second of two quotes");
      const std::string name(rest_.substr(0, end));
      rest_.remove_prefix(end + 1);
      return column_named(
          name, from.substr(0, end + 2), [&](const HistoryColumn& c) { return c.name() == name || c.header() == name; },
          [](const HistoryColumn& c) { return "'" + c.name() + "'"; });
    }
    const std::string word(next_word());
    if (word.empty()) fail("a column, a number or \"(\"");
    take(word);
    return column_named(
        word, word, [&](const HistoryColumn& c) { return c.word() == word; },
        [](const HistoryColumn& c) { return c.word(); });
  }

  template <class Matches, class NameOf>
  Operand column_named(const std::string& name, std::string_view written, Matches&& matches, NameOf&& shown) {
    const auto found = std::find_if(columns_.begin(), columns_.end(), matches);
    if (found == columns_.end()) {
      std::vector<std::string> known;
      for (const HistoryColumn& c : columns_) known.push_back(shown(c));
      throw ExpressionError("the history of this case has no column " + in_quotes(name), names_near(name, known));
    }
    if (const auto other = std::find_if(found + 1, columns_.end(), matches); other != columns_.end())
      throw ExpressionError("two columns are meant by " + in_quotes(name),
                            "'" + found->name() + "' or '" + other->name() + "', in single quotes");
    Node node{Kind::column};
    node.place = static_cast<std::size_t>(found - columns_.begin());
    node.text = std::string(written);
    node.unit = found->unit;
    return {add(node), false, dimension_of(found->unit.empty() ? "1" : found->unit)};
  }

  Expression& made_;
  std::span<const HistoryColumn> columns_;
  std::string_view rest_;
  int depth_ = 0;
};

Expression::Expression(std::string text, std::span<const HistoryColumn> columns) : text_(std::move(text)) {
  ExpressionParser(*this, columns).parse();
  values_.resize(nodes_.size());
}

double Expression::evaluate(const Node& node, std::span<const double> row, std::span<double> cells) const {
  const double a = values_[node.a], b = values_[node.b];
  switch (node.kind) {
    case Kind::number:
      return node.number;
    case Kind::column:
      return row[node.place];
    case Kind::negative:
      return -a;
    case Kind::sum:
      return a + b;
    case Kind::difference:
      return a - b;
    case Kind::product:
      return a * b;
    case Kind::quotient:
      return a / b;
    case Kind::absolute:
      return std::abs(a);
    case Kind::peak:
      return cells[node.place] = std::fmax(cells[node.place], a);  // of a number and not-a-number: the number
    case Kind::lowest:
      return cells[node.place] = std::fmin(cells[node.place], a);
    case Kind::less:
      return a < b ? 1 : 0;
    case Kind::less_or_equal:
      return a <= b ? 1 : 0;
    case Kind::greater:
      return a > b ? 1 : 0;
    case Kind::greater_or_equal:
      return a >= b ? 1 : 0;
    case Kind::both:
      return a != 0 && b != 0 ? 1 : 0;
    case Kind::either:
      return a != 0 || b != 0 ? 1 : 0;
    case Kind::lasting: {
      const double now = row[kTimeColumn];
      double& since = cells[node.place];
      if (a == 0) since = kNoCell;
      if (a != 0 && std::isnan(since)) since = now;
      return now - since >= node.number * (1 - kTimeRoundOff) ? 1 : 0;
    }
  }
  return 0;
}

bool Expression::holds(std::span<const double> row, std::span<double> cells) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) values_[i] = evaluate(nodes_[i], row, cells);
  return values_.back() != 0;
}

std::vector<Expression::Term> Expression::terms() const {
  std::vector<Term> terms;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const std::string& text = nodes_[i].text;
    const auto is_same = [&](const Term& term) { return term.text == text; };
    if (!text.empty() && std::none_of(terms.begin(), terms.end(), is_same))
      terms.push_back({text, nodes_[i].unit, values_[i]});
  }
  return terms;
}

}  // namespace breccia::case_
