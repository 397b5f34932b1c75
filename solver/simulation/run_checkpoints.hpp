#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "domains/partition.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/checkpoint/surviving_checkpoint.hpp"
#include "output/folder/run_folder.hpp"
#include "output/frames/frame.hpp"
#include "output/schedule.hpp"

namespace breccia {

/// Set from outside (a signal handler) to request a checkpoint during the run.
extern std::atomic<bool> checkpoint_requested;

/// Schedule and results of the checkpoints of a run. The steps wait while the state is copied; it is written while they
/// continue. A failed checkpoint is a warning, and the run continues.
class RunCheckpoints {
 public:
  /// Receives in words what became of a checkpoint; called on all ranks. The flag is false for a failure.
  using Tell = std::function<void(const std::string& text, bool good)>;

  /// @pre input and partition outlive this object
  RunCheckpoints(const case_::Case& input, const Partition& partition, const RunFolder& folder, Tell tell);

  /// Adds the signals of this rank to the others at the end of a step.
  void add_signals(StepSignals& signals);
  /// To be called after every step; advances. The same on all ranks.
  [[nodiscard]] bool due();
  /// Begins one of the present state, between two steps. Collective. @param position  but for what is known here
  /// @param last  of the run: it survives the run, for mpiexec kills its ranks a second after Ctrl-C
  void begin(RunPosition position, bool last = false);
  /// After every step: lets one appear that all ranks have written. Collective when there is one.
  void look();
  /// Waits for the one that is being written. Collective. @param steps_wait  steps are to follow: it counts as a pause
  void finish(bool steps_wait = false);
  /// True where begin() was called for the present step already.
  [[nodiscard]] bool is_of_now() const { return begun_at_ == partition_.state().clock.steps; }

  /// The states until this step are sound: of the checkpoints before a fault the last stays, however old.
  void confirm(std::int64_t step) { sound_step_ = step; }
  [[nodiscard]] const RunFolder& folder() const { return folder_; }

  /// Continues as recorded in a checkpoint.
  void restore(const RunPosition& position);
  [[nodiscard]] const CheckpointReport& report() const { return report_; }

 private:
  void begin_writer();
  void begin_surviving();
  void create_checkpoint_folder() const;
  [[nodiscard]] std::filesystem::path file() const;
  [[nodiscard]] std::vector<std::filesystem::path> companions() const;
  [[nodiscard]] Checkpoint content(Snapshot now, State model) const;
  void complete_earlier(CheckpointWriter& earlier);
  [[nodiscard]] std::uint64_t finish_file();
  void complete(std::optional<std::chrono::steady_clock::time_point> waiting);
  template <class Work>
  void attempt(Work&& work);

  const case_::Case& input_;
  const Partition& partition_;
  RunFolder folder_;
  Tell tell_;
  Schedule times_;
  std::unique_ptr<CheckpointWriter> writer_;
  std::unique_ptr<SurvivingCheckpoint> surviving_;
  std::int64_t begun_at_ = -1;  ///< step of the last one
  RunPosition position_;        ///< there
  std::int64_t sound_step_ = -1;
  double pause_ = 0;  ///< s, of the one that is being written
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  CheckpointReport report_;
};

}  // namespace breccia
