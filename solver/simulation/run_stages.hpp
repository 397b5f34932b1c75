#pragma once

#include "case/case.hpp"
#include "case/stage_times.hpp"
#include "output/run_position.hpp"

namespace breccia {

/// The case of a run with the stages as they take place: those after one that has ended before its time come forward by
/// what that saved.
class RunStages {
 public:
  /// @param from  where the run continues; null: at its start.  @pre given outlives this object
  RunStages(const case_::Case& given, const RunPosition* from) : given_(given), now_(given) {
    if (from == nullptr || from->stage < 0 || from->stage >= std::ssize(now_.stages)) return;
    begin(static_cast<std::size_t>(from->stage));
    saved_ = from->saved;
    saved_before_ = from->saved_before;
    now_.stages[stage_] = case_::brought_forward(given_.stages[stage_], saved_before_, saved_);
    bring_later_forward();
  }

  /// Stays where it is; its stages change.
  [[nodiscard]] const case_::Case& now() const { return now_; }
  void begin(std::size_t stage) {
    stage_ = stage;
    saved_before_ = saved_;
  }
  /// The present stage ends at `time`, s, unless it does so before.
  void end_at(double time) {
    if (!(time < now_.stages[stage_].end)) return;
    saved_ = given_.stages[stage_].end - time;
    now_.stages[stage_].end = given_.stages[stage_].end - saved_;
    bring_later_forward();
  }
  void note(RunPosition& position) const {
    position.saved = saved_;
    position.saved_before = saved_before_;
  }

 private:
  void bring_later_forward() {
    for (std::size_t s = stage_ + 1; s < now_.stages.size(); ++s)
      now_.stages[s] = case_::brought_forward(given_.stages[s], saved_, saved_);
  }

  const case_::Case& given_;
  case_::Case now_;
  std::size_t stage_ = 0;
  double saved_ = 0, saved_before_ = 0;  ///< s: by all stages so far, by those before the present one
};

}  // namespace breccia
