#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "case/history_columns.hpp"

namespace breccia::case_ {

/// A text that is no condition: what is wrong and what is allowed.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::string allowed_text)
      : std::runtime_error(what), allowed(std::move(allowed_text)) {}
  std::string allowed;
};

/// A condition over columns of the history:
///   condition  = all { "or" all }            all  = lasting { "and" lasting }
///   lasting    = relation [ "for" duration ]  relation = sum [ ("<" | "<=" | ">" | ">=") sum ]
///   sum        = product { ("+" | "-") product }   product = factor { ("*" | "/") factor }
///   factor     = "-" factor | number [unit] | column | ("peak" | "lowest" | "abs") "(" sum ")" | "(" condition ")"
/// Sums are compared that have one dimension; a number without a unit is in SI units and fits any. Columns are named by
/// HistoryColumn::word(), or in single quotes by name() or header(). A unit has no space: "N.m". peak and lowest are
/// those of all rows so far, `for` is true if its condition has been true in all rows for that time.
///
/// What it remembers from row to row are cells, numbers that belong to the caller: kNoCell at first.
class Expression {
 public:
  /// Throws ExpressionError. O(terms x columns)
  Expression(std::string text, std::span<const HistoryColumn> columns);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::size_t num_cells() const { return num_cells_; }

  /// Evaluates a row of the history; to be called for every one. Comparisons with not-a-number do not hold.
  /// @param row    (columns)
  /// @param cells  (num_cells) updated
  [[nodiscard]] bool holds(std::span<const double> row, std::span<double> cells);

  /// A column, peak or lowest value that the condition reads.
  struct Term {
    std::string text, unit;
    double value;
  };
  /// In the row that was evaluated last, each once.
  [[nodiscard]] std::vector<Term> terms() const;

 private:
  friend class ExpressionParser;
  enum class Kind {
    number,
    column,
    negative,
    sum,
    difference,
    product,
    quotient,
    absolute,
    peak,
    lowest,  // numbers
    less,
    less_or_equal,
    greater,
    greater_or_equal,
    both,
    either,
    lasting  // conditions
  };
  struct Node {
    Kind kind;
    std::size_t a = 0, b = 0;    ///< operands, nodes before this one
    double number = 0;           ///< of a number; s, of a duration
    std::size_t place = 0;       ///< of a column, or of a cell
    std::string text{}, unit{};  ///< of a term
  };

  [[nodiscard]] double evaluate(const Node& node, std::span<const double> row, std::span<double> cells) const;

  std::string text_;
  std::vector<Node> nodes_;     ///< operands first, the condition last
  std::vector<double> values_;  ///< (nodes) in the row that was evaluated last; conditions: 1 or 0
  std::size_t num_cells_ = 0;
};

/// Of a cell before the first row.
inline constexpr double kNoCell = std::numeric_limits<double>::quiet_NaN();

}  // namespace breccia::case_
