#include "simulation/run_checkpoints.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "domains/model_fields.hpp"
#include "domains/piece_mesh.hpp"
#include "output/folder/run_lock.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {

std::atomic<bool> checkpoint_requested{false};

namespace {

using Wall = std::chrono::steady_clock;

double seconds_since(Wall::time_point start) { return std::chrono::duration<double>(Wall::now() - start).count(); }

std::string report_text(const CheckpointWriter& writer, double pause) {
  char text[96];
  std::snprintf(text, sizeof text, ": %.1f MB, the steps waited %.3f s for it", 1e-6 * double(writer.bytes()), pause);
  return "checkpoint " + writer.file().filename().string() + text;
}

}  // namespace

RunCheckpoints::RunCheckpoints(const case_::Case& input, const Partition& partition, const RunFolder& folder, Tell tell)
    : input_(input), partition_(partition), folder_(folder), tell_(std::move(tell)), times_(input.checkpoint.interval) {
  const Clock& clock = partition.state().clock;
  (void)times_.due(clock.time, clock.dt, clock.steps);  // none at the start
}

void RunCheckpoints::add_signals(StepSignals& signals) {
  const double interval = input_.checkpoint.wall_interval;
  const bool by_wall = partition_.communicator().is_root() && interval > 0 && seconds_since(last_) >= interval;
  signals.checkpoint = checkpoint_requested.exchange(false) || (by_wall && !writer_);
  signals.writing = writer_ && writer_->writing();
  if (by_wall) last_ = Wall::now();
}

bool RunCheckpoints::due() {
  if (input_.checkpoint.keep == 0) return false;
  const State& state = partition_.state();
  const Clock& clock = state.clock;
  const bool by_steps = input_.checkpoint.steps > 0 && clock.steps % input_.checkpoint.steps == 0;
  const bool by_time = times_.due(clock.time, clock.dt, clock.steps);
  return by_steps || by_time || state.signals.received.checkpoint;
}

/// Both the run and its files go on whatever becomes of a checkpoint.
template <class Work>
void RunCheckpoints::attempt(Work&& work) {
  try {
    work();
  } catch (const OutputError& error) {
    writer_.reset();
    ++report_.failed;
    tell_(std::string("no checkpoint: ") + error.what(), false);
  }
}

void RunCheckpoints::begin(RunPosition position) {
  if (input_.checkpoint.keep == 0) return;
  const auto started = Wall::now();
  const bool urgent = partition_.state().signals.received.stop;  // whoever asked for the end may kill the run
  std::unique_ptr<CheckpointWriter> earlier = urgent ? std::move(writer_) : nullptr;
  if (writer_) complete(started);
  last_ = Wall::now();
  begun_at_ = partition_.state().clock.steps;
  attempt([&] {
    const Communicator& communicator = partition_.communicator();
    communicator.agree([&] {
      if (communicator.is_root()) create_folder(folder_.checkpoints());
    });
    position.checkpoints = times_.numbers();
    Checkpoint now = content(position);
    std::vector<std::filesystem::path> companions;
    if (communicator.is_root()) companions = {folder_.history(), folder_.status()};
    writer_ = std::make_unique<CheckpointWriter>(checkpoint_file(folder_.checkpoints(), begun_at_), std::move(now),
                                                 communicator, std::move(companions),
                                                 urgent ? std::optional(survival()) : std::nullopt);
  });
  pause_ = seconds_since(last_);
  if (!earlier) return;
  try {  // the state that counts is safe now
    earlier->finish();
    ++report_.written;
  } catch (const OutputError&) {
    ++report_.failed;
  }
}

Survival RunCheckpoints::survival() const {
  if (!partition_.communicator().is_root()) return {};
  return {folder_.status(), folder_.lock ? folder_.lock->descriptor() : -1};
}

Checkpoint RunCheckpoints::content(const RunPosition& position) const {
  Snapshot now = partition_.copy();
  Checkpoint checkpoint;
  checkpoint.model = whole_fields(partition_.communicator(), now.state.state);
  checkpoint.mine = std::move(now.mine);
  checkpoint.position = position;
  checkpoint.position.motion = now.motion;
  checkpoint.position.stage = static_cast<std::int64_t>(now.stage);
  checkpoint.position.worst_element = now.state.sample.worst_element;
  set_energy(now.state.sample.budget, checkpoint.position);
  if (!partition_.communicator().is_root()) return checkpoint;
  checkpoint.whole_model = pack(now.whole);
  checkpoint.case_text = input_.resolved;
  checkpoint.provenance = regular_content(folder_.provenance()).value_or("");
  return checkpoint;
}

/// A rank that has written signals it at the end of a step; all receive that in the next.
void RunCheckpoints::look() {
  const State& state = partition_.state();
  if (writer_ && state.clock.steps >= begun_at_ + 2 && !state.signals.received.writing) complete(Wall::now());
}

void RunCheckpoints::finish(bool steps_wait) {
  if (writer_) complete(steps_wait ? std::optional(Wall::now()) : std::nullopt);
}

/// @param waiting  since when steps wait for it; none do at the end of a run or in a pause
void RunCheckpoints::complete(std::optional<Wall::time_point> waiting) {
  attempt([&] {
    writer_->finish();
    if (partition_.communicator().is_root())
      remove_old_checkpoints(folder_.checkpoints(), input_.checkpoint.keep, sound_step_);
  });
  if (!writer_) return;
  if (waiting) pause_ += seconds_since(*waiting);
  ++report_.written;
  report_.pause_s += pause_;
  report_.longest_pause_s = std::max(report_.longest_pause_s, pause_);
  report_.bytes = writer_->bytes();
  const std::string text = report_text(*writer_, pause_);
  writer_.reset();  // before the status, which may be what cannot be written
  tell_(text, true);
}

void RunCheckpoints::restore(const RunPosition& position) {
  if (input_.checkpoint.interval > 0 && position.checkpoints[0] == input_.checkpoint.interval)
    times_ = Schedule::from_numbers(position.checkpoints);
}

}  // namespace breccia
