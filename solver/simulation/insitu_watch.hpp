#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "domains/partition.hpp"
#include "observe/observe.hpp"
#include "output/folder/control.hpp"
#include "output/insitu/insitu.hpp"

namespace breccia {

/// The pipelines of a run, between its steps: gives them the frames they are due and takes the commands of their
/// scripts.
class InSituWatch {
 public:
  /// Starts the adaptor. Collective. @pre input and partition outlive this object. Throws as InSitu does.
  InSituWatch(const case_::Case& input, const std::filesystem::path& extracts, Partition& partition, InSitu::Tell tell);

  /// Before the first call of look(). Collective.
  /// @param first  where the run's first step was; @param from  where it continues; null: at its first step
  void start_from(Moment first, const RunPosition* from);
  /// For a checkpoint. Collective.
  [[nodiscard]] BrokenCount broken_count() const;
  /// Adds the signals of this rank to the others at the end of a step.
  void add_signals(StepSignals& signals);
  /// A row of the history is known.
  void take_row(const HistoryRow& row);
  /// Whether pipelines that record the history wait for the row of the present state, which the next step finds.
  [[nodiscard]] bool waits_for_row() const { return delayed_.has_value(); }
  /// Executes them, with the last row. Collective.
  void execute_delayed();
  [[nodiscard]] double share_of_time() const { return insitu_.share(); }

  /// Executes the pipelines that are due on the present state; those that take the history alone are left to
  /// execute_delayed(). Collective. @param all  every one of them, regardless of the cost
  /// @return  requests of their scripts to the run, as control commands, the same on all ranks
  [[nodiscard]] std::vector<Command> look(Observer& observer, bool all);

  [[nodiscard]] bool failed() const { return insitu_.failed(); }
  void abandon() { insitu_.abandon(); }
  [[nodiscard]] std::vector<PipelineReport> finish();

 private:
  void count_broken();
  [[nodiscard]] std::vector<Command> asked_by_scripts() const;

  /// What waits for its row of the history.
  struct Delayed {
    InSitu::Plan plan;
    Frame frame;
  };
  Partition& partition_;
  InSitu insitu_;
  std::optional<Delayed> delayed_;
  std::int64_t row_step_ = -1, given_step_ = -1;          ///< of the last row; of the last one that pipelines got
  std::vector<std::string> columns_;                      ///< of the history
  std::optional<std::vector<double>> last_row_;           ///< of the history, on the root
  std::int64_t broken_here_ = 0, broken_everywhere_ = 0;  ///< joints, when they were last counted
  std::int64_t broken_at_start_ = 0;                      ///< likewise, of the run
  std::int64_t count_at_ = -1;                            ///< step before which they are to be counted; -1: none
};

}  // namespace breccia
