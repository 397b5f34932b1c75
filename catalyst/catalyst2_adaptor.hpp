#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalyst/catalyst2_library.hpp"
#include "catalyst/display.hpp"
#include "catalyst/grid_to_blueprint.hpp"
#include "catalyst/own_mpi.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/script_bridge.hpp"
#include "catalyst/selection.hpp"
#include "catalyst/turn_watch.hpp"

namespace breccia::insitu {

/// The pipelines of a run over an implementation of Catalyst 2. Each execution of a pipeline is one catalyst_execute
/// with its channels. With ParaView's implementation, which runs all scripts each time and keeps their errors, a bridge
/// in Python lets only the one run whose turn it is (script_bridge.hpp); that one is given the other scripts' channels
/// too, without cells, so that nothing reads memory of an execution that has passed. Members are collective.
class Catalyst2Adaptor {
 public:
  /// Starts libcatalyst and its implementation. Throws PipelineError, on all ranks.
  explicit Catalyst2Adaptor(const BrecciaConfig& config);
  Catalyst2Adaptor(const Catalyst2Adaptor&) = delete;
  Catalyst2Adaptor& operator=(const Catalyst2Adaptor&) = delete;
  ~Catalyst2Adaptor();

  /// Channels that a pipeline wants: at the first execution those of all scripts, which ParaView reads at once.
  [[nodiscard]] std::uint32_t channels(int pipeline, std::int64_t step, double time) const;
  std::uint32_t execute(std::uint32_t pipelines, const BrecciaInstant& instant, BrecciaRequests& requests,
                        std::string& text);
  /// See Adaptor::notices.
  [[nodiscard]] std::string notices();
  /// Ends the implementation and makes animations of pictures. @return  lines about them, on the first rank
  [[nodiscard]] std::string finish();
  [[nodiscard]] std::int64_t bytes_written(int pipeline) const;  ///< not collective

 private:
  struct Named {
    PipelineChoice choice;
    std::filesystem::path folder;  ///< empty: it has none
    std::uint32_t channels = 0;
    std::int64_t written_before = 0;
    std::unique_ptr<SelectedInstant> part;  ///< null: it gets all
  };

  void make_pipelines(const BrecciaConfig& config);
  void start_display(bool draws);
  void initialize();
  [[nodiscard]] std::unique_ptr<ConduitTree> started_tree(std::int64_t step, double time, const std::string& pipeline);
  void run(Named& pipeline, std::uint32_t mask, const BrecciaInstant& instant, BrecciaRequests& requests);
  void fill_channels(const ConduitTree& tree, std::uint32_t mask, const BrecciaInstant& instant);
  void forget_instant();
  void call_execute(std::unique_ptr<ConduitTree> tree, const std::string& what);
  /// What the implementation returns from a call that is watched. Throws PipelineError with what it throws.
  template <class Call>
  int status_of(const std::string& what, Call&& call);
  [[nodiscard]] std::string implementation() const;
  void end();

  Ranks ranks_;
  TurnWatch watch_;
  std::filesystem::path folder_;
  std::unique_ptr<OwnMpi> mpi_;
  std::optional<Catalyst2Library> library_;
  std::unique_ptr<Display> display_;
  std::vector<Named> pipelines_;
  std::uint32_t first_channels_ = 0;  ///< of the first execution; 0: it has been
  std::unique_ptr<ScriptBridge> bridge_;
  GridToBlueprint blueprint_;
  std::array<std::unique_ptr<EmptyGrid>, BRECCIA_NUM_CHANNELS> seen_;  ///< by channel; null: not seen yet
  std::unique_ptr<ConduitTree> last_;  ///< implementations may keep pointers to its nodes until the next execution
  std::int64_t step_ = 0;
  double time_ = 0;
  bool initialized_ = false;
};

}  // namespace breccia::insitu
