#include "output/insitu.hpp"

#include <algorithm>
#include <bit>
#include <system_error>

#include "output/atomic_file.hpp"
#include "output/channels.hpp"
#include "output/insitu_config.hpp"

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
  const InSituConfig config(input.insitu, input.title, std::filesystem::absolute(folder), communicator);
  std::int32_t result = 0;
  const std::string text =
      words_of([&](char* words, std::size_t size) { result = plugin.api().preflight(&config.get(), words, size); });
  if (result != 0) throw InputError(insitu_problems(input.file, text));
}

InSitu::InSitu(const case_::Case& input, const std::filesystem::path& folder, const Communicator& communicator,
               Tell tell)
    : communicator_(communicator),
      tell_(std::move(tell)),
      stop_on_error_(input.insitu.on_error == case_::OnError::stop) {
  make_pipelines(input);
  open(input, folder);
  started_ = Clock::now();
}

void InSitu::make_pipelines(const case_::Case& input) {
  const double end = input.stages.back().end;
  std::size_t paced = 0;
  for (const case_::Pipeline& p : input.insitu.pipelines) paced += p.strict ? 0 : 1;
  // Shared evenly, so that a cheap pipeline leaves a dear one its part.
  const double share = input.insitu.max_overhead / static_cast<double>(std::max<std::size_t>(paced, 1));
  for (const case_::Pipeline& p : input.insitu.pipelines) {
    pipelines_.push_back({p.name, p.every_wall, p.strict, Trigger(p, end), Overhead(share)});
  }
  if (!input.insitu.live) return;
  case_::Pipeline by_wall;
  by_wall.every_wall = std::max(input.insitu.live->interval, 1e-9);
  pipelines_.push_back(
      {"live", by_wall.every_wall, false, Trigger(by_wall, end), Overhead(input.insitu.live->max_overhead)});
}

void InSitu::open(const case_::Case& input, const std::filesystem::path& folder) {
  communicator_.agree([&] {
    if (!communicator_.is_root()) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw output_error(folder, "cannot create this folder", error.value());
  });
  communicator_.agree([&] { preflight(input, folder, plugin_, communicator_); });
  const InSituConfig config(input.insitu, input.title, std::filesystem::absolute(folder), communicator_);
  const std::string text =
      words_of([&](char* words, std::size_t size) { adaptor_ = plugin_.api().open(&config.get(), words, size); });
  communicator_.agree([&] {
    if (adaptor_ == nullptr)
      throw InputError(insitu_problems(input.file, "the in-situ adaptor does not start: " + text));
  });
}

InSitu::~InSitu() {
  if (adaptor_ != nullptr) plugin_.api().close(adaptor_);
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
    if ((due & bit(i)) != 0 && (pipelines_[i].strict || pipelines_[i].overhead.allows(elapsed()))) go |= bit(i);
  }
  return go;
}

InSitu::Plan InSitu::plan(const Moment& now, std::uint32_t ordered, bool all) {
  std::uint32_t due = 0;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    Pipeline& p = pipelines_[i];
    const bool triggered = p.trigger.due(now);  // asked in any event: it moves on
    if (!p.off && (triggered || all || (ordered & bit(i)) != 0)) due |= bit(i);
  }
  if (due == 0) return {};
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
      tell_("pipeline " + pipelines_[i].name + ": switched off, it asks for nothing since it failed", false);
    }
    if (channels == 0) continue;
    plan.channels |= channels;
    plan.pipelines |= bit(i);
  }
  return plan;
}

void InSitu::execute(const Plan& plan, const Frame& frame, const std::vector<std::string>& columns,
                     const std::optional<std::vector<double>>& row) {
  const Channels channels(frame, plan.channels, columns, row);
  const double shared_cost = seconds_since(planned_) / std::popcount(plan.pipelines);  // making the frame
  requests_ = {};
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    if ((plan.pipelines & bit(i)) != 0) run_one(i, channels.instant(), shared_cost);
  }
}

void InSitu::run_one(std::size_t i, const BrecciaInstant& instant, double shared_cost) {
  Pipeline& p = pipelines_[i];
  const auto start = Clock::now();
  BrecciaRequests asked{};
  std::int64_t failed = 0;
  const std::string text = words_of([&](char* words, std::size_t size) {
    failed = plugin_.api().execute(adaptor_, bit(i), &instant, &asked, words, size);
  });
  p.overhead.book(shared_cost + std::max(seconds_since(start) - asked.waited, 0.0));
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
  tell_(text + (pipeline.off ? "; switched off after " + std::to_string(kMostFailures) + " failures" : ""), false);
}

double InSitu::share() const {
  double seconds = 0;
  for (const Pipeline& p : pipelines_) seconds += p.overhead.spent();
  return elapsed() > 0 ? seconds / elapsed() : 0.0;
}

std::vector<PipelineReport> InSitu::finish() {
  std::vector<PipelineReport> reports;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    const Pipeline& p = pipelines_[i];
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
  plugin_.api().close(adaptor_);
  adaptor_ = nullptr;
  return reports;
}

}  // namespace breccia
