#include "catalyst/adaptor.hpp"

#include <optional>
#include <utility>

#include "catalyst/animation.hpp"
#include "catalyst/extract_pipeline.hpp"
#include "catalyst/fatal_line.hpp"
#include "catalyst/first_rank_pipeline.hpp"
#include "catalyst/live_pipeline.hpp"
#include "catalyst/messages.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/pipeline_loop.hpp"
#include "catalyst/probe_pipeline.hpp"
#include "catalyst/script_check.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

constexpr std::uint32_t kLiveDefault = bit(BRECCIA_SURFACE) | bit(BRECCIA_FRACTURES) | bit(BRECCIA_DOMAINS);

std::string label(const std::string& pipeline) { return "pipeline " + pipeline; }

/// Whether all that needs ParaView are pictures of our own: a user's script may count on all ranks, and the live link
/// needs their data where they are.
bool draws_own_pictures_alone(const BrecciaConfig& config) {
  bool draws = false;
  for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
    const PipelineChoice choice = choose(config.pipelines[i]);
    if (choice.kind == PipelineKind::live || (choice.kind == PipelineKind::script && !choice.ready)) return false;
    draws = draws || choice.kind == PipelineKind::script;
  }
  return draws;
}

}  // namespace

Adaptor::Adaptor(const BrecciaConfig& config, bool frames_of_others)
    : ranks_(config.communicator, config.patience), folder_(config.folder) {
  capture_messages();
  if (ranks_.size() > 1 && !frames_of_others && draws_own_pictures_alone(config))
    alone_ = std::make_unique<Ranks>(-1, config.patience);
  start_display(config);
  for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
    std::string error;
    std::unique_ptr<Pipeline> work;
    std::unique_ptr<Part> part;
    try {
      const FatalLine line(label(config.pipelines[i].name));
      work = made(config.pipelines[i], config);
      const PipelineChoice choice = choose(config.pipelines[i]);
      // Probes take what they need.
      const bool gathered = alone_ && choice.kind == PipelineKind::script;
      if (gathered || (choice.kind != PipelineKind::probes && !choice.selection.is_all()))
        part = std::make_unique<Part>(choice.selection);
      if (gathered) part->all = std::make_unique<GatheredInstant>(ranks_);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    error = ranks_.agree(error);
    if (!error.empty()) throw PipelineError(std::string(config.pipelines[i].name) + ": " + error);
    pipelines_.push_back({config.pipelines[i].name, std::move(work), std::move(part)});
  }
}

Adaptor::~Adaptor() { end_pipelines(); }

void Adaptor::end_pipelines() {
  if (std::exchange(finished_, true)) return;
  for (Named& pipeline : pipelines_) {
    const FatalLine line(label(pipeline.name));
    pipeline.work->finish();
  }
}

std::string Adaptor::finish() {
  end_pipelines();
  std::string text = notices();
  std::vector<std::filesystem::path> folders;
  for (const Named& pipeline : pipelines_) {
    if (pipeline.work->draws()) folders.push_back(folder_ / std::filesystem::path(pipeline.name).stem());
  }
  return ranks_.is_root() ? text + make_animations(folders) : std::string();
}

void Adaptor::start_display(const BrecciaConfig& config) {
  RunScripts scripts = read_scripts(ranks_, config);
  script_channels_ = std::move(scripts.channels);
  script_draws_ = scripts.draw;
  if (script_draws_ == 0) return;
  std::string error;
  try {
    if (!alone_ || ranks_.is_root()) display_ = std::make_unique<Display>(alone_ ? *alone_ : ranks_);
  } catch (const PipelineError& failure) {
    if (!alone_) throw;
    error = failure.what();
  }
  if (alone_) ranks_.throw_agreed(error);
}

CatalystBackend& Adaptor::backend() {
  if (!backend_) backend_ = std::make_unique<CatalystBackend>(alone_ ? *alone_ : ranks_);
  return *backend_;
}

std::unique_ptr<Pipeline> Adaptor::made(const BrecciaPipeline& pipeline, const BrecciaConfig& config) {
  const PipelineChoice choice = choose(pipeline);
  const std::filesystem::path folder = std::filesystem::path(config.folder) / choice.folder;
  switch (choice.kind) {
    case PipelineKind::extract:
      return std::make_unique<ExtractPipeline>(ranks_, choice.channel, folder);
    case PipelineKind::history:
      return std::make_unique<HistoryPipeline>(ranks_, folder);
    case PipelineKind::probes:
      return std::make_unique<ProbePipeline>(ranks_, choice.probes, choice.selection.fields, folder);
    case PipelineKind::live: {
      const std::uint32_t channels = choice.channels == 0 ? kLiveDefault : choice.channels & kAllChannels;
      return std::make_unique<LivePipeline>((backend(), ranks_), config.live_host, config.live_port, channels,
                                            config.run,
                                            [ends = config.run_ends] { return ends != nullptr && ends() != 0; });
    }
    case PipelineKind::script:
      break;
  }
  if (alone_ && !ranks_.is_root()) return std::make_unique<FirstRankPipeline>(ranks_, nullptr);
  make_folder(folder);
  const auto index = static_cast<std::size_t>(&pipeline - config.pipelines);
  const Display* display = (script_draws_ >> index & 1U) != 0 ? display_.get() : nullptr;
  const python::About about{config.title, config.end, config.strength};
  auto script =
      backend().script({choice.name, choice.file, folder, script_channels_[index], choice.parameters, about, display});
  if (alone_) return std::make_unique<FirstRankPipeline>(ranks_, std::move(script));
  return script;
}

std::uint32_t Adaptor::channels(int pipeline, std::int64_t step, double time) {
  const FatalLine line(label(name(pipeline)));
  const Named& asked = pipelines_.at(static_cast<std::size_t>(pipeline));
  const std::uint32_t channels = asked.work->channels(step, time);
  return channels != 0 && asked.part && asked.part->instant.has_points() ? channels | BRECCIA_POINT_VALUES : channels;
}

std::string Adaptor::notices() {
  std::string text;
  for (const Named& pipeline : pipelines_) text += with_name(pipeline.name, pipeline.work->notice());
  return text;
}

std::uint32_t Adaptor::execute(std::uint32_t pipelines, const BrecciaInstant& instant, BrecciaRequests& requests,
                               std::string& text) {
  std::string error;
  std::vector<Frame> frames;
  try {
    frames = frames_of(pipelines, instant);
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  error = ranks_.agree(error);
  if (error.empty()) return execute(pipelines, frames, requests, text);
  std::uint32_t failed = 0;
  for (int i = 0; i < num_pipelines(); ++i) {
    if ((pipelines & bit(i)) == 0) continue;
    failed |= bit(i);
    text += name(i) + ": " + one_line(error) + '\n';
  }
  return failed;
}

/// By pipeline.
std::vector<Frame> Adaptor::frames_of(std::uint32_t pipelines, const BrecciaInstant& instant) {
  std::vector<Frame> frames(pipelines_.size());
  std::optional<Frame> whole;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Part* const part = pipelines_[i].part.get();
    if ((pipelines & bit(static_cast<int>(i))) == 0) continue;
    if (part == nullptr && !whole) whole = frames_.wrap(whole_.of(instant));
    frames[i] = part == nullptr ? *whole : part->of(instant);
  }
  return frames;
}

std::uint32_t Adaptor::execute(std::uint32_t pipelines, const Frame& frame, BrecciaRequests& requests,
                               std::string& text) {
  return execute(pipelines, std::vector<Frame>(pipelines_.size(), frame), requests, text);
}

std::uint32_t Adaptor::execute(std::uint32_t pipelines, const std::vector<Frame>& frames, BrecciaRequests& requests,
                               std::string& text) {
  return execute_each(
      ranks_, pipelines, num_pipelines(), [this](int i) { return name(i); }, text,
      [&](int i) {
        const FatalLine line(label(name(i)));
        pipelines_[static_cast<std::size_t>(i)].work->execute(frames[static_cast<std::size_t>(i)], requests);
      });
}

}  // namespace breccia::insitu
