#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace breccia {

/// What is known of a pipeline that is executed at even distances of simulated time and has a budget of wall time.
struct PaceState {
  double now = 0, begin = 0, end = 0;  ///< s, simulated: the present, of the run's first and last step
  double last = 0;                     ///< s, simulated: of the last execution
  double elapsed = 0;                  ///< s, wall, since `begin`
  double starts = 0;                   ///< s of it in which pipelines were started, once
  double interval = 0;                 ///< s, simulated: between two executions if cost were no matter
  std::int64_t least = 0;              ///< executions over the whole run, regardless of the cost
  double share = 0;                    ///< of the wall time of the whole run, for all that the pipeline costs
  double spent = 0;                    ///< s, wall, so far, its start included
  double cost = 0;                     ///< s, wall, of an execution
  std::int64_t done = 0;               ///< executions so far
};

/// When it is executed next.
struct Spacing {
  double next = 0;         ///< s, simulated; infinite: at the end of the run, where every pipeline is executed
  double distance = 0;     ///< s, simulated
  std::int64_t times = 0;  ///< executions of the whole run, the one at its end included
  double share = 0;        ///< of the wall time of the whole run, that these take
};

/// Wall time of the whole run at its speed so far, starts of pipelines once, s. @pre now > begin
[[nodiscard]] double expected_wall(const PaceState& state);

/// Spaces as many executions as the rest of the budget affords, at most one an interval, evenly over the rest of the
/// run, from the last one on. Planned anew now and then, it follows a run that becomes slower and a pipeline that
/// becomes dearer. @pre now > begin, last < end, cost > 0, interval > 0
[[nodiscard]] Spacing spaced_evenly(const PaceState& state);

/// Divides a budget: each gets an even part; unused parts go to the others.
/// @param asked  >= 0, may be infinite
[[nodiscard]] std::vector<double> parts_of_budget(double budget, const std::vector<double>& asked);

/// "stress: a picture every 4.1 us, 25 in all, for 2 % of the wall time", with the reason if it is more or less than
/// requested.
/// @param thing  "picture", "record"
[[nodiscard]] std::string pace_text(const std::string& name, const char* thing, const Spacing& spacing,
                                    const PaceState& state);

}  // namespace breccia
