#pragma once

#include <string>

#include "base/types.hpp"
#include "case/origin.hpp"

namespace breccia::case_ {

// What is measured in a run, and what it does when a condition holds: the entries of [[gauge]] and [[trigger]], how
// they are read and written. Their help and ranges: case/schema_run_keys.hpp; their rules: validate_experiment.hpp.

enum class GaugeKind { point, line, extensometer, cracks };

/// [[gauge]]: columns of the history beside those of output.gauges. Places are those at rest.
struct Gauge {
  std::string name;
  GaugeKind kind = GaugeKind::point;
  Vec3 at{0, 0, 0};               ///< m, of a point
  Vec3 from{0, 0, 0}, to = from;  ///< m, of a line and an extensometer
  int points = 2;                 ///< of a line, both ends included
  std::string group;              ///< that cracks reach
  Origin origin;
  friend bool operator==(const Gauge&, const Gauge&) = default;
};

template <class A>
void bind(A& a, Gauge& gauge) {
  a.origin(gauge.origin);
  a.value("name", gauge.name);
  a.choice("kind", gauge.kind);
  switch (gauge.kind) {
    case GaugeKind::point:
      if constexpr (A::reads) a.only({"name", "kind", "at"}, "kind = \"point\"");
      if constexpr (A::reads) a.needed({"at"});
      return a.value("at", gauge.at);
    case GaugeKind::line:
      if constexpr (A::reads) a.only({"name", "kind", "from", "to", "points"}, "kind = \"line\"");
      if constexpr (A::reads) a.needed({"from", "to"});
      a.value("points", gauge.points);
      break;
    case GaugeKind::extensometer:
      if constexpr (A::reads) a.only({"name", "kind", "from", "to"}, "kind = \"extensometer\"");
      if constexpr (A::reads) a.needed({"from", "to"});
      break;
    case GaugeKind::cracks:
      if constexpr (A::reads) a.only({"name", "kind", "group"}, "kind = \"cracks\"");
      if constexpr (A::reads) a.needed({"group"});
      return a.value("group", gauge.group);
  }
  a.value("from", gauge.from);
  a.value("to", gauge.to);
}

enum class TriggerAction { frame, checkpoint, extract, stop };

/// [[trigger]]
struct Trigger {
  std::string when;  ///< a condition (case/expression.hpp)
  TriggerAction action = TriggerAction::frame;
  bool once = true;  ///< false: each time that the condition becomes true
  Origin origin;
  friend bool operator==(const Trigger&, const Trigger&) = default;
};

template <class A>
void bind(A& a, Trigger& trigger) {
  a.origin(trigger.origin);
  a.value("when", trigger.when);
  a.choice("action", trigger.action);
  a.value("once", trigger.once);
}

}  // namespace breccia::case_
