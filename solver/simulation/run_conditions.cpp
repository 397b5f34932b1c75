#include "simulation/run_conditions.hpp"

#include <utility>

#include "base/number_text.hpp"
#include "base/printable.hpp"
#include "case/history_columns.hpp"

namespace breccia {
namespace {

RunConditions::Action action_of(case_::TriggerAction action) {
  switch (action) {
    case case_::TriggerAction::frame:
      return RunConditions::Action::frame;
    case case_::TriggerAction::checkpoint:
      return RunConditions::Action::checkpoint;
    case case_::TriggerAction::extract:
      return RunConditions::Action::extract;
    case case_::TriggerAction::stop:
      break;
  }
  return RunConditions::Action::stop;
}

const char* word_of(RunConditions::Action action) {
  switch (action) {
    case RunConditions::Action::frame:
      return "frame";
    case RunConditions::Action::checkpoint:
      return "checkpoint";
    case RunConditions::Action::extract:
      return "extract";
    case RunConditions::Action::stop:
      return "end of the run";
    case RunConditions::Action::end_stage:
      break;
  }
  return "end of the stage";
}

std::string text_of(const ConditionReport& report, const std::vector<case_::Expression::Term>& terms) {
  constexpr int kDigits = 6;
  std::string text =
      report.key + " = \"" + report.when + "\" is true at " + number_text(report.last_time, kDigits) + " s";
  for (std::size_t i = 0; i < terms.size(); ++i) {
    text += (i == 0 ? " (" : ", ") + terms[i].text + " = " + number_text(terms[i].value, kDigits);
    if (!terms[i].unit.empty()) text += " " + terms[i].unit;
  }
  return text + (terms.empty() ? ": " : "): ") + report.action;
}

}  // namespace

RunConditions::RunConditions(const case_::Case& input) {
  std::vector<case_::HistoryColumn> columns;
  const auto add_condition = [&](const std::string& key, const std::string& when, Action action, bool once,
                                 std::size_t stage) {
    if (when.empty()) return;
    if (columns.empty()) columns = case_::history_columns(input.output.gauges, input.gauges);
    add({key, case_::Expression(when, columns), action, once, stage});
  };
  for (std::size_t i = 0; i < input.triggers.size(); ++i) {
    const case_::Trigger& trigger = input.triggers[i];
    add_condition("trigger[" + std::to_string(i) + "].when", trigger.when, action_of(trigger.action), trigger.once,
                  kAnyStage);
  }
  for (std::size_t s = 0; s < input.stages.size(); ++s) {
    const Action action = s + 1 == input.stages.size() ? Action::stop : Action::end_stage;
    add_condition("stage[" + std::to_string(s) + "].stop_when", input.stages[s].stop_when, action, false, s);
  }
  add_condition("time.stop_when", input.time.stop_when, Action::stop, false, kAnyStage);
}

void RunConditions::add(Condition condition) {
  condition.cells.assign(condition.when.num_cells(), case_::kNoCell);
  condition.report.key = condition.key;
  condition.report.when = printable(condition.when.text());
  condition.report.action = word_of(condition.action);
  for (const case_::Expression::Term& term : condition.when.terms()) condition.report.values.emplace_back(term.text, 0);
  conditions_.push_back(std::move(condition));
}

bool RunConditions::fires(Condition& condition, const std::vector<double>& row) {
  const bool holds = condition.when.holds(row, condition.cells);
  const bool before = std::exchange(condition.was_true, holds);
  return holds && !before && !(condition.once && condition.report.times > 0);
}

std::vector<RunConditions::Fired> RunConditions::take(const std::vector<double>& row, std::size_t stage) {
  std::vector<Fired> fired;
  for (Condition& condition : conditions_) {
    if (condition.stage != kAnyStage && condition.stage != stage) continue;
    if (!fires(condition, row)) continue;
    ConditionReport& report = condition.report;
    report.last_step = static_cast<std::int64_t>(row.front());
    report.last_time = row[case_::kTimeColumn];
    if (report.times++ == 0) report.first_step = report.last_step, report.first_time = report.last_time;
    const std::vector<case_::Expression::Term> terms = condition.when.terms();
    for (std::size_t i = 0; i < terms.size(); ++i) report.values[i].second = terms[i].value;
    fired.push_back({condition.action, text_of(report, terms)});
  }
  return fired;
}

std::vector<ConditionReport> RunConditions::reports() const {
  std::vector<ConditionReport> reports;
  for (const Condition& condition : conditions_)
    if (condition.report.times > 0) reports.push_back(condition.report);
  return reports;
}

std::vector<double> RunConditions::memory() const {
  std::vector<double> memory;
  for (const Condition& condition : conditions_) {
    const ConditionReport& r = condition.report;
    memory.insert(memory.end(),
                  {condition.was_true ? 1.0 : 0.0, static_cast<double>(r.times), static_cast<double>(r.first_step),
                   r.first_time, static_cast<double>(r.last_step), r.last_time});
    for (const auto& value : r.values) memory.push_back(value.second);
    memory.insert(memory.end(), condition.cells.begin(), condition.cells.end());
  }
  return memory;
}

bool RunConditions::restore(const std::vector<double>& memory) {
  std::size_t length = 0;
  for (const Condition& c : conditions_) length += kNumbers + c.report.values.size() + c.cells.size();
  if (memory.size() != length) return false;
  constexpr double kMostCount = 9e15;  // doubles count exactly up to 2^53
  const auto is_count = [](double number) { return 0 <= number && number <= kMostCount; };
  const double* m = memory.data();
  for (Condition& condition : conditions_) {
    ConditionReport& r = condition.report;
    if (!is_count(m[1]) || !is_count(m[2]) || !is_count(m[4])) return false;
    condition.was_true = m[0] != 0;
    r.times = static_cast<std::int64_t>(m[1]);
    r.first_step = static_cast<std::int64_t>(m[2]), r.first_time = m[3];
    r.last_step = static_cast<std::int64_t>(m[4]), r.last_time = m[5];
    m += kNumbers;
    for (auto& value : r.values) value.second = *m++;
    for (double& cell : condition.cells) cell = *m++;
  }
  return true;
}

}  // namespace breccia
