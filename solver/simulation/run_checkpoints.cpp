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

std::string report_text(const std::filesystem::path& file, std::uint64_t bytes, double pause) {
  char text[96];
  std::snprintf(text, sizeof text, ": %.1f MB, the steps waited %.3f s for it", 1e-6 * double(bytes), pause);
  return "checkpoint " + file.filename().string() + text;
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

/// The run and its files continue also after a failed checkpoint.
template <class Work>
void RunCheckpoints::attempt(Work&& work) {
  try {
    work();
  } catch (const OutputError& error) {
    writer_.reset();
    surviving_.reset();
    ++report_.failed;
    tell_(std::string("no checkpoint: ") + error.what(), false);
  }
}

void RunCheckpoints::begin(RunPosition position, bool last) {
  if (input_.checkpoint.keep == 0) return;
  const auto started = Wall::now();
  if (writer_ && !last) complete(started);  // the last one does not wait for it
  last_ = Wall::now();
  begun_at_ = partition_.state().clock.steps;
  position.checkpoints = times_.numbers();
  position_ = position;
  if (last) {
    const std::unique_ptr<CheckpointWriter> earlier = std::move(writer_);
    attempt([&] { begin_surviving(); });
    if (earlier) complete_earlier(*earlier);
  } else {
    attempt([&] { begin_writer(); });
  }
  pause_ = seconds_since(last_);
}

void RunCheckpoints::begin_writer() {
  const Communicator& communicator = partition_.communicator();
  create_checkpoint_folder();
  Snapshot now = partition_.copy();
  State model = whole_fields(communicator, now.state.state);
  writer_ =
      std::make_unique<CheckpointWriter>(file(), content(std::move(now), std::move(model)), communicator, companions());
}

/// As little as possible comes before the copies are made: the kill may be near.
void RunCheckpoints::begin_surviving() {
  const Communicator& communicator = partition_.communicator();
  create_checkpoint_folder();
  partition_.domain().exchange.agree_on_failure();
  const State model = whole_fields(communicator, closed_fields(partition_.domain()));
  SurvivingCheckpoint::Place place{file(), folder_.status(), folder_.lock ? folder_.lock->descriptor() : -1,
                                   companions()};
  surviving_ = std::make_unique<SurvivingCheckpoint>(
      std::move(place), model.clock, [&] { return content(partition_.copy_of_rank(), model); }, communicator);
}

void RunCheckpoints::create_checkpoint_folder() const {
  partition_.communicator().agree([&] {
    if (partition_.communicator().is_root()) create_folder(folder_.checkpoints());
  });
}

std::filesystem::path RunCheckpoints::file() const { return checkpoint_file(folder_.checkpoints(), begun_at_); }

std::vector<std::filesystem::path> RunCheckpoints::companions() const {
  if (!partition_.communicator().is_root()) return {};
  return {folder_.history(), folder_.status()};
}

Checkpoint RunCheckpoints::content(Snapshot now, State model) const {
  Checkpoint checkpoint;
  checkpoint.model = std::move(model);
  checkpoint.mine = std::move(now.mine);
  checkpoint.position = position_;
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

/// That was still being written when the last one began, which is safe by now.
void RunCheckpoints::complete_earlier(CheckpointWriter& earlier) {
  try {
    earlier.finish();
    ++report_.written;
  } catch (const OutputError&) {
    ++report_.failed;
  }
}

/// A rank that has written signals it at the end of a step; all receive that in the next.
void RunCheckpoints::look() {
  const State& state = partition_.state();
  if (writer_ && state.clock.steps >= begun_at_ + 2 && !state.signals.received.writing) complete(Wall::now());
}

void RunCheckpoints::finish(bool steps_wait) {
  if (writer_ || surviving_) complete(steps_wait ? std::optional(Wall::now()) : std::nullopt);
}

/// @param waiting  since when steps wait for it; none do at the end of a run or in a pause
void RunCheckpoints::complete(std::optional<Wall::time_point> waiting) {
  std::uint64_t bytes = 0;
  attempt([&] {
    bytes = finish_file();
    if (partition_.communicator().is_root())
      remove_old_checkpoints(folder_.checkpoints(), input_.checkpoint.keep, sound_step_);
  });
  if (!writer_ && !surviving_) return;
  if (waiting) pause_ += seconds_since(*waiting);
  ++report_.written;
  report_.pause_s += pause_;
  report_.longest_pause_s = std::max(report_.longest_pause_s, pause_);
  report_.bytes = bytes;
  const std::string text = report_text(file(), bytes, pause_);
  writer_.reset();  // before the status, which may be what cannot be written
  surviving_.reset();
  tell_(text, true);
}

/// @return  its bytes, on the root
std::uint64_t RunCheckpoints::finish_file() {
  if (surviving_) {
    if (const std::optional<std::uint64_t> bytes = surviving_->finish()) return *bytes;
    surviving_.reset();
    begin_writer();
  }
  writer_->finish();
  return writer_->bytes();
}

void RunCheckpoints::restore(const RunPosition& position) {
  if (input_.checkpoint.interval > 0 && position.checkpoints[0] == input_.checkpoint.interval)
    times_ = Schedule::from_numbers(position.checkpoints);
}

}  // namespace breccia
