#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "output/folder/energy_terms.hpp"
#include "state/energy_budget.hpp"
#include "state/field_table.hpp"

namespace breccia {

/// How far the files of a run have come.
struct OutputMarks {
  std::int64_t history_bytes = 0, status_bytes = 0;  ///< of whole lines
  std::int64_t frames = 0;                           ///< in the indices of frames
};

/// What the triggers of pipelines know of broken joints.
struct BrokenCount {
  std::int64_t at_start = 0, known = 0;  ///< at the run's first step; as last counted
  bool due = false, due_next = false;    ///< counted anew before the next step; before the one after it
};

/// Where a run is besides its state: in its stages, its schedules and its files. Alike on all ranks, but for the marks,
/// which are the root's.
struct RunPosition {
  std::int64_t stage = 0;                                      ///< of the case, begun
  std::int64_t until_look = 0, since_look = 0, growth = 0;     ///< StepSchedule
  double motion = 0;                                           ///< m, largest of a node in a step
  double wall = 0;                                             ///< s, that the run has taken so far
  std::array<double, 4> histories{}, frames{}, checkpoints{};  ///< Schedule::numbers
  std::int64_t frame_number = 0;                               ///< of the next one
  std::int64_t fragments = 0;                                  ///< as last counted
  std::int64_t broken_joints = 0;                              ///< when the position was taken
  std::array<double, kEnergyTerms.size() + 1> energy{};        ///< J, last sample, then the relative residual
  std::int64_t worst_element = -1;                             ///< of that sample
  double start_time = 0;                                       ///< s, of the state that the run started from
  std::int64_t start_step = 0;                                 ///< likewise
  BrokenCount broken_count;
  double saved = 0, saved_before = 0;     ///< s, by which stages have ended early: all so far, those before the present
  bool extract_due = false;               ///< a trigger has fired
  std::vector<double> conditions, peaks;  ///< RunConditions::memory, Peaks::memory
  OutputMarks marks;
};
template <>
struct FieldTable<RunPosition> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"stage", "1", kNotHashed, [](auto& r) -> auto& { return r.stage; }},
      FieldRow{"steps_until_stable_step_is_looked_at", "1", kNotHashed, [](auto& r) -> auto& { return r.until_look; }},
      FieldRow{"steps_since_stable_step_was_looked_at", "1", kNotHashed, [](auto& r) -> auto& { return r.since_look; }},
      FieldRow{"steps_in_which_the_step_could_grow_by_half", "1", kNotHashed,
               [](auto& r) -> auto& { return r.growth; }},
      FieldRow{"largest_motion", "m", kNotHashed, [](auto& r) -> auto& { return r.motion; }},
      FieldRow{"wall_time", "s", kNotHashed, [](auto& r) -> auto& { return r.wall; }},
      FieldRow{"schedule_of_history", "s, 1, 1, 1", kNotHashed, [](auto& r) -> auto& { return r.histories; }},
      FieldRow{"schedule_of_frames", "s, 1, 1, 1", kNotHashed, [](auto& r) -> auto& { return r.frames; }},
      FieldRow{"schedule_of_checkpoints", "s, 1, 1, 1", kNotHashed, [](auto& r) -> auto& { return r.checkpoints; }},
      FieldRow{"next_frame", "1", kNotHashed, [](auto& r) -> auto& { return r.frame_number; }},
      FieldRow{"fragments", "1", kNotHashed, [](auto& r) -> auto& { return r.fragments; }},
      FieldRow{"broken_joints", "1", kNotHashed, [](auto& r) -> auto& { return r.broken_joints; }},
      FieldRow{"energies_of_last_sample", "J", kNotHashed, [](auto& r) -> auto& { return r.energy; }},
      FieldRow{"densest_element", "1", kNotHashed, [](auto& r) -> auto& { return r.worst_element; }},
      FieldRow{"start_time", "s", kNotHashed, [](auto& r) -> auto& { return r.start_time; }},
      FieldRow{"start_step", "1", kNotHashed, [](auto& r) -> auto& { return r.start_step; }},
      FieldRow{"joints_broken_at_start", "1", kNotHashed, [](auto& r) -> auto& { return r.broken_count.at_start; }},
      FieldRow{"joints_known_to_be_broken", "1", kNotHashed, [](auto& r) -> auto& { return r.broken_count.known; }},
      FieldRow{"broken_count_due", "1", kNotHashed, [](auto& r) -> auto& { return r.broken_count.due; }},
      FieldRow{"broken_count_due_next", "1", kNotHashed, [](auto& r) -> auto& { return r.broken_count.due_next; }},
      FieldRow{"time_saved_by_stages", "s", kNotHashed, [](auto& r) -> auto& { return r.saved; }},
      FieldRow{"time_saved_before_stage", "s", kNotHashed, [](auto& r) -> auto& { return r.saved_before; }},
      FieldRow{"extract_due", "1", kNotHashed, [](auto& r) -> auto& { return r.extract_due; }},
      FieldRow{"memory_of_conditions", "1", kNotHashed, [](auto& r) -> auto& { return r.conditions; }},
      FieldRow{"peaks_of_gauges", "1", kNotHashed, [](auto& r) -> auto& { return r.peaks; }},
      FieldRow{"history_bytes", "1", kNotHashed, [](auto& r) -> auto& { return r.marks.history_bytes; }},
      FieldRow{"status_bytes", "1", kNotHashed, [](auto& r) -> auto& { return r.marks.status_bytes; }},
      FieldRow{"frames", "1", kNotHashed, [](auto& r) -> auto& { return r.marks.frames; }},
  };
// clang-format on
}
;

/// The energies of a sample as the numbers of a position, and back.
inline void set_energy(const EnergyBudget& budget, RunPosition& position) {
  for (std::size_t i = 0; i < kEnergyTerms.size(); ++i) position.energy[i] = budget.*kEnergyTerms[i].value;
  position.energy.back() = budget.residual_relative;
}
[[nodiscard]] inline EnergyBudget energy_of(const RunPosition& position) {
  EnergyBudget budget;
  for (std::size_t i = 0; i < kEnergyTerms.size(); ++i) budget.*kEnergyTerms[i].value = position.energy[i];
  budget.residual_relative = position.energy.back();
  return budget;
}

}  // namespace breccia
