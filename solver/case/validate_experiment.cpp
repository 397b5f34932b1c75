#include "case/validate_experiment.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <utility>

#include "case/expression.hpp"
#include "case/problem_at.hpp"

namespace breccia::case_ {
namespace {

constexpr std::size_t kMostTriggers = 100;
constexpr std::size_t kMostColumns = 100000;  // a line of the history is written as a whole

class ExperimentValidator {
 public:
  explicit ExperimentValidator(const Case& c) : c_(c) {}

  std::vector<Problem> run() {
    for (const Gauge& gauge : c_.gauges) this->gauge(gauge);
    if (columns_.size() > kMostColumns)
      problem(c_.gauges.front().origin, "", "the gauges have too many columns",
              "at most " + std::to_string(kMostColumns), std::to_string(columns_.size()));
    conditions();
    if (c_.triggers.size() > kMostTriggers)
      problem(c_.triggers[kMostTriggers].origin, "", "is one trigger too many",
              "at most " + std::to_string(kMostTriggers), std::to_string(c_.triggers.size()));
    return std::move(problems_);
  }

 private:
  void problem(const Origin& origin, const std::string& name, const std::string& what, const std::string& allowed = {},
               const std::string& given = {}) {
    problems_.push_back(problem_at(c_, origin, name, what, allowed, given));
  }

  void gauge(const Gauge& gauge) {
    if (gauge.name.empty()) return;  // reported by the reader
    const auto is_allowed = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string(" ._-").find(c) != std::string::npos;
    };
    if (!std::all_of(gauge.name.begin(), gauge.name.end(), is_allowed))
      problem(gauge.origin, "name", "has other signs than names of columns", "letters, digits, spaces and . _ -",
              gauge.name);
    const std::vector<std::string>& groups = c_.output.gauges;
    if (std::find(groups.begin(), groups.end(), gauge.name) != groups.end())
      problem(gauge.origin, "name", "output.gauges records a group of this name", "another name", gauge.name);
    bool reported = false;
    for (const HistoryColumn& column : columns_of(gauge)) {
      if (columns_.insert(column.gauge + "\n" + column.quantity).second || std::exchange(reported, true)) continue;
      problem(gauge.origin, "name", "another gauge has a column of this name", "different names", column.name());
    }
    const bool has_two = gauge.kind == GaugeKind::line || gauge.kind == GaugeKind::extensometer;
    if (has_two && gauge.from == gauge.to) problem(gauge.origin, "to", "is the point from", "two different points");
  }

  void conditions() {
    for (const Trigger& trigger : c_.triggers) {
      condition(trigger.origin, "when", trigger.when);
      if (trigger.action == TriggerAction::extract && !c_.insitu.asked_for())
        problem(trigger.origin, "action", "the case has no pipelines to execute",
                "an [insitu] with pipelines, or another action", "extract");
      if (trigger.action == TriggerAction::checkpoint && c_.checkpoint.keep == 0)
        problem(trigger.origin, "action", "the run writes no checkpoints", "checkpoint.keep > 0, or another action",
                "checkpoint");
    }
    condition(c_.time.origin, "stop_when", c_.time.stop_when);
    for (const Stage& stage : c_.stages) condition(stage.origin, "stop_when", stage.stop_when);
  }

  void condition(const Origin& origin, const std::string& key, const std::string& text) {
    if (text.empty()) return;
    if (known_.empty()) known_ = history_columns(c_.output.gauges, c_.gauges);
    try {
      Expression(text, known_);
    } catch (const ExpressionError& error) {
      problem(origin, key, error.what(), error.allowed, text);
    }
  }

  const Case& c_;
  std::set<std::string> columns_;     ///< of gauges
  std::vector<HistoryColumn> known_;  ///< of the history, where a condition needs them
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> validate_experiment(const Case& c) { return ExperimentValidator(c).run(); }

}  // namespace breccia::case_
