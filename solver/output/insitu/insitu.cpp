#include "output/insitu/insitu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <system_error>
#include <utility>

#include "output/folder/run_folder.hpp"
#include "output/insitu/channels.hpp"
#include "output/insitu/extracts_cut.hpp"
#include "output/insitu/insitu_config.hpp"
#include "system/atomic_file.hpp"

namespace breccia {
namespace {

/// A pipeline that has failed so often is not tried again.
constexpr std::int64_t kMostFailures = 3;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::uint32_t bit(std::size_t i) { return std::uint32_t{1} << i; }

}  // namespace

void preflight(const case_::Case& input, const std::filesystem::path& folder, const InSituPlugin& plugin,
               const Communicator& communicator) {
  const InSituConfig config(input, std::filesystem::absolute(folder), communicator);
  std::int32_t result = 0;
  const std::string text =
      answer_of([&](char* words, std::size_t size) { result = plugin.api().preflight(&config.get(), words, size); });
  if (result != 0) throw InputError(insitu_problems(input.file, text));
}

InSitu::InSitu(const case_::Case& input, const std::filesystem::path& folder, const Communicator& communicator,
               Tell tell)
    : plugin_(input.insitu.backend),
      communicator_(communicator),
      tell_(std::move(tell)),
      stop_on_error_(input.insitu.on_error == case_::OnError::stop),
      share_(input.insitu.max_overhead),
      end_(input.stages.back().end),
      most_steps_(input.time.max_steps) {
  make_pipelines(input);
  open(input, folder);
  opening_ = elapsed();
}

void InSitu::make_pipelines(const case_::Case& input) {
  const double end = input.stages.back().end;
  std::size_t paced = 0;
  for (const case_::Pipeline& p : input.insitu.pipelines) paced += p.strict ? 0 : 1;
  // Shared evenly, so that a cheap pipeline leaves a dear one its part.
  const double share = input.insitu.max_overhead / static_cast<double>(std::max<std::size_t>(paced, 1));
  for (const case_::Pipeline& p : input.insitu.pipelines) {
    Pipeline made{p.name, p.every_wall, p.strict, Trigger(p, end), Overhead(share)};
    made.even = !p.strict && p.every_wall == 0 && made.trigger.is_regular();
    made.interval = p.has_trigger() ? 0 : end / Trigger::kTimes;
    made.least = p.least;
    pipelines_.push_back(std::move(made));
  }
  if (!input.insitu.live) return;
  case_::Pipeline by_wall;
  by_wall.every_wall = std::max(input.insitu.live->interval, 1e-9);
  pipelines_.push_back(
      {"live", by_wall.every_wall, false, Trigger(by_wall, end), Overhead(input.insitu.live->max_overhead)});
}

void InSitu::start_from(const Moment& first, std::int64_t broken) {
  first_ = first;
  for (Pipeline& p : pipelines_) {
    if (p.interval > 0) p.interval = (end_ - first.time) / Trigger::kTimes;
    p.trigger.start_from(first, end_, broken);
  }
}

void InSitu::open(const case_::Case& input, const std::filesystem::path& folder) {
  communicator_.agree([&] {
    if (communicator_.is_root()) create_folder(folder);
  });
  communicator_.agree([&] {
    if (communicator_.is_root()) open_index(RunFolder{folder.parent_path()}.extract_steps());
  });
  communicator_.agree([&] { preflight(input, folder, plugin_, communicator_); });
  const InSituConfig config(input, std::filesystem::absolute(folder), communicator_);
  const std::string text =
      answer_of([&](char* words, std::size_t size) { adaptor_ = plugin_.api().open(&config.get(), words, size); });
  communicator_.agree([&] {
    if (adaptor_ == nullptr)
      throw InputError(insitu_problems(input.file, "the in-situ adaptor does not start: " + text));
  });
}

/// A resumed run appends to the existing file.
void InSitu::open_index(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t before = std::filesystem::file_size(file, error);
  steps_.emplace(file, error ? 0 : static_cast<std::size_t>(before));
  if (steps_->size() == 0) steps_->append_line(kExtractsHeader);
}

InSitu::~InSitu() {
  if (adaptor_ != nullptr) static_cast<void>(close());
}

std::string InSitu::close() {
  return answer_of(
      [&](char* words, std::size_t size) { plugin_.api().close(std::exchange(adaptor_, nullptr), words, size); });
}

double InSitu::elapsed() const { return seconds_since(started_); }

std::uint64_t InSitu::orders() {
  std::uint64_t due = 0;
  for (std::size_t i = 0; i < pipelines_.size() && communicator_.is_root(); ++i) {
    Pipeline& p = pipelines_[i];
    const double now = elapsed();
    if (!(p.every_wall > 0) || p.off || now < p.next_wall || !(p.strict || p.overhead.allows(now))) continue;
    p.next_wall = now + p.every_wall;
    due |= bit(i);
  }
  return due;
}

bool InSitu::counts_broken() const {
  return std::any_of(pipelines_.begin(), pipelines_.end(),
                     [](const Pipeline& p) { return !p.off && p.trigger.counts_broken(); });
}

std::uint32_t InSitu::affordable(std::uint32_t due) const {
  std::uint32_t go = 0;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    const Pipeline& p = pipelines_[i];
    if ((due & bit(i)) != 0 && (p.strict || p.even || p.overhead.allows(elapsed()))) go |= bit(i);
  }
  return go;
}

InSitu::Plan InSitu::plan(const Moment& now, std::uint32_t ordered, bool all) {
  std::uint32_t due = 0;
  if (!begin_) begin_ = now.time;
  space_anew(now);
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    Pipeline& p = pipelines_[i];
    const bool is_due = this->due(p, now);  // called in any case: its trigger advances
    if (!p.off && (is_due || all || (ordered & bit(i)) != 0)) due |= bit(i);
  }
  if (due == 0) return {};
  now_ = now;
  planned_ = Clock::now();
  const auto told = static_cast<std::uint32_t>(
      communicator_.max(static_cast<std::int64_t>(communicator_.is_root() ? affordable(due) : 0)));
  const std::uint32_t go = all ? due : told;
  Plan plan;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    if ((due & bit(i)) == 0) continue;
    if ((go & bit(i)) == 0) {
      ++pipelines_[i].passed_over;
      continue;
    }
    const std::uint32_t channels = plugin_.api().channels(adaptor_, static_cast<std::int32_t>(i), now.step, now.time);
    if (channels == 0 && pipelines_[i].failures > 0) {  // a script that failed when it was read: it is not read again
      pipelines_[i].off = true;
      tell_("pipeline " + pipelines_[i].name + ": switched off, as it requests nothing after its failure", false);
    }
    if (channels == 0) continue;
    plan.channels |= channels;
    plan.pipelines |= bit(i);
    if (channels == std::uint32_t{1} << BRECCIA_HISTORY) plan.rows |= bit(i);
  }
  if (!plan) {
    account_idle(due);
    tell_notices();
  }
  return plan;
}

bool InSitu::due(Pipeline& p, const Moment& now) {
  const bool triggered = p.trigger.due(now);
  if (!p.even) return triggered;
  const bool is_time = now.time + 0.5 * now.dt >= p.not_before;
  if (p.interval > 0) return is_time;
  if (triggered && !is_time && !p.off) ++p.passed_over;
  return triggered && is_time;
}

/// Accounts the cost of queries after which nothing is executed.
void InSitu::account_idle(std::uint32_t asked) {
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    if ((asked & bit(i)) != 0) pipelines_[i].overhead.account_idle(seconds_since(planned_) / std::popcount(asked));
  }
}

void InSitu::execute(const Plan& plan, const Frame& frame, const std::vector<std::string>& columns,
                     const std::optional<std::vector<double>>& row) {
  const Channels channels(frame, plan.channels, columns, row);
  const double shared_cost = seconds_since(planned_) / std::popcount(plan.pipelines);  // making the frame
  requests_ = {};
  list_step();
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    if ((plan.pipelines & bit(i)) == 0) continue;
    run_one(i, channels.instant(), shared_cost);
    pipelines_[i].last = now_.time;
  }
  space(plan.pipelines);
  tell_notices();
}

void InSitu::execute_delayed(const Plan& plan, const Frame& frame, const std::vector<std::string>& columns,
                             const std::optional<std::vector<double>>& row) {
  planned_ = Clock::now();
  execute(plan, frame, columns, row);
}

/// Before anything is written, so that a run resumed from an earlier step knows it. Without the line, extracts of this
/// step stay where such a run ends before it.
void InSitu::list_step() {
  if (std::exchange(listed_, now_.step) == now_.step) return;
  try {
    communicator_.agree([&] {
      if (steps_) steps_->append_line(fmt::format("{},{:.17g}", now_.step, now_.time));
    });
  } catch (const OutputError& error) {  // the same on all ranks
    tell_(error.what(), false);
  }
}

void InSitu::tell_notices() {
  tell_lines(answer_of([&](char* words, std::size_t size) { plugin_.api().notices(adaptor_, words, size); }));
}

/// Notices as the adaptor words them.
void InSitu::tell_lines(const std::string& lines) {
  for_each_notice(lines, [this](const std::string& line, bool warns) { tell_(line, !warns); });
}

void InSitu::run_one(std::size_t i, const BrecciaInstant& instant, double shared_cost) {
  Pipeline& p = pipelines_[i];
  const auto start = Clock::now();
  BrecciaRequests asked{};
  std::int64_t failed = 0;
  const std::string text = answer_of([&](char* words, std::size_t size) {
    failed = plugin_.api().execute(adaptor_, bit(i), &instant, &asked, words, size);
  });
  p.overhead.account(shared_cost + std::max(seconds_since(start) - asked.waited, 0.0));
  p.next_wall = elapsed() + p.every_wall;
  requests_.stop |= asked.stop;
  requests_.pause |= asked.pause;
  requests_.extract |= asked.extract;
  if (asked.frame_interval > 0) requests_.frame_interval = asked.frame_interval;
  if (failed < 0) throw InternalError("pipeline " + text);
  if (failed != 0) fail(p, text);
}

void InSitu::fail(Pipeline& pipeline, const std::string& why) {
  ++pipeline.failures;
  const std::string text = "pipeline " + (why.empty() ? pipeline.name + ": failed" : why);
  if (stop_on_error_) {
    failed_ = true;
    communicator_.agree([&] {
      Problem problem;
      problem.key = "insitu";
      problem.what = text;
      throw OutputError(problem);
    });
  }
  pipeline.off = pipeline.failures >= kMostFailures;
  const bool is_known = std::exchange(pipeline.failure, text) == text;  // a reason is reported once
  if (is_known && !pipeline.off) return;
  const std::string what = is_known ? "pipeline " + pipeline.name + ": " : text + "; ";
  tell_(pipeline.off ? what + "switched off after " + std::to_string(kMostFailures) + " failures" : text, false);
}

double InSitu::starts() const {
  double seconds = opening_;
  for (const Pipeline& p : pipelines_) seconds += p.overhead.start();
  return seconds;
}

double InSitu::share() const {
  double seconds = starts();
  for (const Pipeline& p : pipelines_) seconds += p.overhead.spent();
  return elapsed() > 0 ? seconds / elapsed() : 0.0;
}

/// @param lines  the root's, of which the others know nothing
void InSitu::tell_end(const std::string& lines) {
  std::vector<std::byte> bytes(lines.size());
  std::transform(lines.begin(), lines.end(), bytes.begin(), [](char c) { return std::byte(c); });
  communicator_.broadcast(bytes);
  std::string text(bytes.size(), ' ');
  std::transform(bytes.begin(), bytes.end(), text.begin(), [](std::byte b) { return static_cast<char>(b); });
  tell_lines(text);
}

std::vector<PipelineReport> InSitu::finish() {
  std::vector<PipelineReport> reports;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    Pipeline& p = pipelines_[i];
    if (p.even && p.interval > 0 && begin_) {
      const std::int64_t asked = std::llround((now_.time - *begin_) / p.interval) + 1;
      p.passed_over = std::max<std::int64_t>(asked - p.overhead.times(), 0);
    }
    PipelineReport report{p.name,
                          p.overhead.times(),
                          p.passed_over,
                          p.failures,
                          communicator_.max(p.overhead.start()),
                          communicator_.max(p.overhead.spent()),
                          0};
    report.bytes = communicator_.sum(plugin_.api().bytes_written(adaptor_, static_cast<std::int32_t>(i)));
    reports.push_back(std::move(report));
  }
  tell_end(close());
  return reports;
}

}  // namespace breccia
