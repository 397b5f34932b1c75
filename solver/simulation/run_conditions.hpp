#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/expression.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// The conditions of a case: [[trigger]], time.stop_when and stage.stop_when. They are evaluated at the lines of the
/// history, whose numbers are the same on all ranks; so are the decisions, without any message.
class RunConditions {
 public:
  enum class Action { frame, checkpoint, extract, stop, end_stage };

  explicit RunConditions(const case_::Case& input);

  struct Fired {
    Action action;
    std::string text;  ///< which condition, when, and the values that it read
  };
  /// Takes a line of the history. @param row  as history_values gives it;  @param stage  of the case
  /// @return  conditions that hold and did not in the line before; those of triggers that fire once, the first time
  [[nodiscard]] std::vector<Fired> take(const std::vector<double>& row, std::size_t stage);

  /// Those that became true, in the order of the case.
  [[nodiscard]] std::vector<ConditionReport> reports() const;

  /// All that is remembered from line to line, and back. @return  false: the numbers are not those of such conditions
  [[nodiscard]] std::vector<double> memory() const;
  [[nodiscard]] bool restore(const std::vector<double>& memory);

 private:
  struct Condition {
    std::string key;
    case_::Expression when;
    Action action;
    bool once = false;
    std::size_t stage = kAnyStage;
    std::vector<double> cells{};  ///< of the expression
    bool was_true = false;        ///< in the last line
    ConditionReport report{};
  };
  static constexpr std::size_t kAnyStage = static_cast<std::size_t>(-1);
  static constexpr std::size_t kNumbers = 6;  ///< that are remembered beside the cells and the values

  void add(Condition condition);
  [[nodiscard]] static bool fires(Condition& condition, const std::vector<double>& row);

  std::vector<Condition> conditions_;
};

}  // namespace breccia
