#include "catalyst/catalyst2_adaptor.hpp"

#include <cmath>
#include <utility>

#include "catalyst/animation.hpp"
#include "catalyst/fatal_line.hpp"
#include "catalyst/folders.hpp"
#include "catalyst/pipeline_loop.hpp"
#include "catalyst/script_check.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

const std::string kStart = "start of the in-situ pipelines", kEnd = "end of the in-situ pipelines";

}  // namespace

template <class Call>
int Catalyst2Adaptor::status_of(const std::string& what, Call&& call) {
  const TurnWatch::Turn turn(watch_, what);
  const FatalLine line(what, implementation());
  try {
    return call();
  } catch (const std::exception& error) {
    throw PipelineError(error.what());
  } catch (...) {
    throw PipelineError("it has thrown an object that is no exception");
  }
}

std::string Catalyst2Adaptor::implementation() const {
  return "implementation '" + library_->implementation() + "' of Catalyst 2";
}

Catalyst2Adaptor::Catalyst2Adaptor(const BrecciaConfig& config)
    : ranks_(config.communicator, config.patience), watch_(0.5 * ranks_.patience()), folder_(config.folder) {
  std::string error;
  try {
    library_.emplace();
    static_cast<void>(library_->implementation_file());
  } catch (const PipelineError& failure) {
    error = failure.what();
  }
  ranks_.throw_agreed(error);
  make_pipelines(config);
  if (library_->is_paraview()) {
    std::vector<BridgedScript> scripts;
    for (const Named& pipeline : pipelines_)
      scripts.push_back({pipeline.choice.name, pipeline.choice.file, pipeline.folder, pipeline.choice.parameters});
    bridge_ = std::make_unique<ScriptBridge>(ranks_, watch_, config, scripts);
    for (const Named& pipeline : pipelines_) first_channels_ |= pipeline.channels;
  }
  error.clear();
  try {
    initialize();
  } catch (const PipelineError& failure) {
    error = failure.what();
  }
  ranks_.throw_agreed(error);
}

Catalyst2Adaptor::~Catalyst2Adaptor() { end(); }

void Catalyst2Adaptor::make_pipelines(const BrecciaConfig& config) {
  const RunScripts scripts = read_scripts(ranks_, config);
  start_display(scripts.draw != 0);
  std::string error;
  for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
    try {
      Named made;
      made.choice = choose(config.pipelines[i]);
      made.channels = bit(made.choice.channel);
      if (!made.choice.selection.is_all()) made.part = std::make_unique<SelectedInstant>(made.choice.selection);
      if (made.choice.kind == PipelineKind::history) made.channels = bit(BRECCIA_HISTORY);
      if (made.choice.kind == PipelineKind::script) {
        made.channels = scripts.channels[static_cast<std::size_t>(i)];
        made.folder = folder_ / made.choice.folder;
        make_folder(made.folder);
        made.written_before = bytes_in_folder(made.folder);
      }
      pipelines_.push_back(std::move(made));
    } catch (const std::exception& failure) {
      error = std::string(config.pipelines[i].name) + ": " + failure.what();
    }
  }
  ranks_.throw_agreed(error);
}

/// A ParaView may draw without a display, by EGL or OSMesa: where none can be had it is left to it.
void Catalyst2Adaptor::start_display(bool draws) {
  if (draws && ranks_.agree(display_problem()).empty()) display_ = std::make_unique<Display>(ranks_);
}

void Catalyst2Adaptor::initialize() {
  static bool begun = false;
  if (library_->is_paraview() && std::exchange(begun, true))
    throw PipelineError("ParaView has been started in this process before; it cannot be started twice");
  MPI_Comm communicator = ranks_.communicator();
  if (communicator == MPI_COMM_NULL) {
    if (library_->is_paraview() && !OwnMpi::is_started()) mpi_ = std::make_unique<OwnMpi>();
    communicator = MPI_COMM_SELF;
  }
  const ConduitTree tree(library_->functions());
  tree.functions().set_path_text(tree.root(), "catalyst_load/implementation", library_->implementation().c_str());
  const std::string beside = library_->implementation_file().parent_path().string();
  tree.set("catalyst_load/search_paths", std::vector{beside});
  if (OwnMpi::is_started()) tree.set("catalyst/mpi_comm", std::int64_t{MPI_Comm_c2f(communicator)});
  if (bridge_) {
    const std::string script = (data_folder() / "python/breccia_catalyst2.py").string();
    tree.set("catalyst/scripts/breccia_bridge/filename", script);
    tree.set("catalyst/scripts/breccia_bridge/args", std::vector{ScriptBridge::address()});
  }
  for (const Named& pipeline : pipelines_) {
    if (pipeline.choice.kind != PipelineKind::script) continue;
    const std::string path = "catalyst/scripts/" + pipeline.choice.folder;
    tree.set((path + "/filename").c_str(), pipeline.choice.file.string());
    std::vector<std::string> arguments{"folder=" + pipeline.folder.string()};
    for (const auto& [name, value] : pipeline.choice.parameters)
      arguments.push_back(name + "=" + (value.is_number() ? exact(value.number) : *value.text));
    tree.set((path + "/args").c_str(), arguments);
  }
  const int status = status_of(kStart, [&] { return library_->functions().initialize(tree.root()); });
  if (status != 0)
    throw PipelineError(implementation() + " does not start: catalyst_initialize returns " + words_of_status(status));
  initialized_ = true;
  const ConduitTree about(library_->functions());
  if (status_of(kStart, [&] { return library_->functions().about(about.root()); }) != 0) return;
  const char* const path = "catalyst/implementation";
  if (about.functions().has_path(about.root(), path) == 0) return;
  const std::string started = about.functions().path_as_text(about.root(), path);
  if (started != library_->implementation())
    throw PipelineError(implementation() + " was requested and '" + started +
                        "' started; is CATALYST_IMPLEMENTATION_PREFER_ENV set?");
}

std::uint32_t Catalyst2Adaptor::channels(int pipeline, std::int64_t, double) const {
  return pipelines_.at(static_cast<std::size_t>(pipeline)).channels | first_channels_;
}

std::uint32_t Catalyst2Adaptor::execute(std::uint32_t pipelines, const BrecciaInstant& instant,
                                        BrecciaRequests& requests, std::string& text) {
  return execute_each(
      ranks_, pipelines, static_cast<int>(pipelines_.size()),
      [this](int i) { return pipelines_[static_cast<std::size_t>(i)].choice.name; }, text,
      [&](int i) {
        Named& pipeline = pipelines_[static_cast<std::size_t>(i)];
        run(pipeline, pipeline.channels | std::exchange(first_channels_, 0), instant, requests);
      });
}

std::unique_ptr<ConduitTree> Catalyst2Adaptor::started_tree(std::int64_t step, double time,
                                                            const std::string& pipeline) {
  auto tree = std::make_unique<ConduitTree>(library_->functions());
  tree->set("catalyst/state/timestep", step);
  tree->set("catalyst/state/cycle", step);
  tree->set("catalyst/state/time", time);
  if (!pipeline.empty()) tree->set("catalyst/state/parameters", std::vector{"pipeline=" + pipeline});
  step_ = step;
  time_ = time;
  return tree;
}

void Catalyst2Adaptor::run(Named& pipeline, std::uint32_t mask, const BrecciaInstant& instant,
                           BrecciaRequests& requests) {
  std::string error;
  std::unique_ptr<ConduitTree> tree;
  try {
    tree = started_tree(instant.step, instant.time, pipeline.choice.name);
    fill_channels(*tree, mask, pipeline.part ? pipeline.part->of(instant) : instant);
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  ranks_.throw_agreed(error);  // or others would wait within the implementation
  if (bridge_) bridge_->set_turn(pipeline.choice.file);
  call_execute(std::move(tree), "pipeline " + pipeline.choice.name);
  if (bridge_) bridge_->take_result(requests);
}

void Catalyst2Adaptor::fill_channels(const ConduitTree& tree, std::uint32_t mask, const BrecciaInstant& instant) {
  // All room for corners first: it must not move once it is pointed to.
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    if ((mask & bit(channel)) != 0 && instant.channels[channel] != nullptr)
      blueprint_.reserve(*instant.channels[channel]);
  }
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    const auto index = static_cast<std::size_t>(channel);
    const BrecciaGrid* const given = (mask & bit(channel)) != 0 ? instant.channels[channel] : nullptr;
    if (given == nullptr && (!bridge_ || !seen_[index])) continue;
    const BrecciaGrid grid = given != nullptr ? *given : seen_[index]->grid();
    if (given != nullptr && !seen_[index]) seen_[index] = std::make_unique<EmptyGrid>(grid);
    const std::string path = std::string("catalyst/channels/") + kChannelNames[index];
    const ConduitFunctions& conduit = tree.functions();
    ConduitNode* const node = conduit.fetch(tree.root(), path.c_str());
    conduit.set_path_text(node, "type", "mesh");
    try {
      blueprint_.fill(conduit, conduit.fetch(node, "data"), grid, ranks_.rank(), instant.step, instant.time);
    } catch (const PipelineError& error) {
      throw PipelineError(std::string("channel ") + kChannelNames[index] + " " + error.what());
    }
  }
}

void Catalyst2Adaptor::call_execute(std::unique_ptr<ConduitTree> tree, const std::string& what) {
  const std::unique_ptr<ConduitTree> before = std::exchange(last_, std::move(tree));
  const int status = status_of(what, [&] { return library_->functions().execute(last_->root()); });
  if (status != 0) throw PipelineError("catalyst_execute returns " + words_of_status(status));
}

/// What a script does in its end must not read what the last execution pointed to.
void Catalyst2Adaptor::forget_instant() {
  bridge_->set_turn({});
  auto tree = started_tree(step_, time_, {});
  BrecciaInstant nothing{};
  nothing.step = step_;
  nothing.time = time_;
  fill_channels(*tree, 0, nothing);
  call_execute(std::move(tree), kEnd);
}

void Catalyst2Adaptor::end() {
  if (!std::exchange(initialized_, false)) return;
  try {
    if (bridge_ && last_) forget_instant();
    const ConduitTree tree(library_->functions());
    status_of(kEnd, [&] { return library_->functions().finalize(tree.root()); });
  } catch (const std::exception&) {
    // Nothing is left to do with what has failed to end.
  }
  last_.reset();
}

std::string Catalyst2Adaptor::notices() {
  return bridge_ ? agreed_notices(ranks_, bridge_->take_notices()) : std::string();
}

std::string Catalyst2Adaptor::finish() {
  end();
  const std::string text = notices();
  std::vector<std::filesystem::path> folders;
  for (const Named& pipeline : pipelines_) {
    if (!pipeline.folder.empty()) folders.push_back(pipeline.folder);
  }
  return ranks_.is_root() ? text + make_animations(folders) : std::string();
}

std::int64_t Catalyst2Adaptor::bytes_written(int pipeline) const {
  const Named& asked = pipelines_.at(static_cast<std::size_t>(pipeline));
  if (!ranks_.is_root() || asked.folder.empty()) return 0;
  return bytes_in_folder(asked.folder) - asked.written_before;
}

}  // namespace breccia::insitu
