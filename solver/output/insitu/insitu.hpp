#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "output/frames/frame.hpp"
#include "output/insitu/insitu_pace.hpp"
#include "output/insitu/insitu_plugin.hpp"
#include "output/insitu/trigger.hpp"
#include "output/sink.hpp"
#include "parallel/communicator.hpp"
#include "system/atomic_file.hpp"

namespace breccia {

/// Checks whether all pipelines of a case could run: names, parameters, scripts, a display for pictures, the existing
/// folder of the extracts. Not collective. Throws InputError with every problem.
void preflight(const case_::Case& input, const std::filesystem::path& folder, const InSituPlugin& plugin,
               const Communicator& communicator);

/// The pipelines that process the state during the run: when each is due, its budget, and the consequence of its
/// failure. The adaptor executes them (catalyst/insitu_abi.h).
///
/// Triggers by step, simulated time and broken joints are known to all ranks alike and hit the very step; those by wall
/// time are the root's, which sends them to the others as orders, received a step later. A pipeline without triggers,
/// or due by steps or simulated time, is executed twice, so that its cost is known; then the root spaces as many
/// executions as its part of the budget affords evenly over the rest of the run, and does so again after each of them
/// and now and then. Pipelines with other triggers are skipped while their cost exceeds their part of the wall time so
/// far. With nothing due a step costs a few comparisons.
class InSitu {
 public:
  /// Receives messages in words; called on all ranks. The flag is false for a warning.
  using Tell = std::function<void(const std::string& text, bool good)>;

  /// Loads the adaptor, checks all requirements, and starts it. Collective.
  /// @param folder  of the extracts; made when it is not there, as is the index of their steps beside it
  /// Throws InputError with every problem, on all ranks alike.
  InSitu(const case_::Case& input, const std::filesystem::path& folder, const Communicator& communicator, Tell tell);
  InSitu(const InSitu&) = delete;
  InSitu& operator=(const InSitu&) = delete;
  ~InSitu();

  /// Where the run's first step was, from which its limit of steps and the parts of its length count. Before the first
  /// plan. @param broken  joints of which pipelines know
  void start_from(const Moment& first, std::int64_t broken);
  /// Pipelines that are due by wall time, each once, to be sent to all ranks; empty on all but the root.
  [[nodiscard]] std::uint64_t orders();
  /// Whether some trigger needs the number of broken joints.
  [[nodiscard]] bool counts_broken() const;

  /// What is to be done in this step.
  struct Plan {
    std::uint32_t pipelines = 0, channels = 0;  ///< masks; 0: nothing
    std::uint32_t rows = 0;                     ///< those of the pipelines that take the history alone
    explicit operator bool() const { return pipelines != 0; }
  };
  /// @param ordered  mask of pipelines that are due by order; @param all  execute all, regardless of the cost
  /// Collective when something is due; the same on all ranks.
  [[nodiscard]] Plan plan(const Moment& now, std::uint32_t ordered, bool all);
  /// Does it. @param frame  has the parts of the plan's channels
  /// Throws OutputError on all ranks when a pipeline fails and on_error is stop. Collective.
  void execute(const Plan& plan, const Frame& frame, const std::vector<std::string>& columns,
               const std::optional<std::vector<double>>& row);
  /// The same of a plan that had to wait for its row of the history: the wait is no cost of its pipelines.
  void execute_delayed(const Plan& plan, const Frame& frame, const std::vector<std::string>& columns,
                       const std::optional<std::vector<double>>& row);
  /// Requests of the scripts of the last execution to the run; those of the root apply.
  [[nodiscard]] const BrecciaRequests& requests() const { return requests_; }

  /// Whether on_error has ended the run.
  [[nodiscard]] bool failed() const { return failed_; }
  /// Share of the wall time that pipelines have taken on this rank, their start included.
  [[nodiscard]] double share() const;
  /// Leaves the adaptor as it is: other ranks will not come to close it.
  void abandon() { adaptor_ = nullptr; }
  /// Ends all pipelines. Collective.
  [[nodiscard]] std::vector<PipelineReport> finish();

 private:
  struct Pipeline {
    std::string name;
    double every_wall;  ///< s; 0: no
    bool strict;
    Trigger trigger;
    Overhead overhead;
    double next_wall = 0;  ///< s, when wall time makes it due again
    std::int64_t passed_over = 0, failures = 0;
    std::string failure{};  ///< the last one
    bool off = false;
    bool even = false;       ///< spaced evenly over the run
    double interval = 0;     ///< s, simulated: of an even one without triggers; 0: it has triggers
    std::int64_t least = 0;  ///< executions of an evenly spaced one, regardless of the cost
    double last = 0;         ///< s, simulated: of the last execution
    double not_before = 0;   ///< s, simulated: of an even one
    bool told = false;       ///< how often it is executed
  };
  void make_pipelines(const case_::Case& input);
  void open(const case_::Case& input, const std::filesystem::path& folder);
  [[nodiscard]] double elapsed() const;
  [[nodiscard]] std::uint32_t affordable(std::uint32_t due) const;
  [[nodiscard]] bool due(Pipeline& pipeline, const Moment& now);
  void account_idle(std::uint32_t asked);
  [[nodiscard]] double starts() const;
  [[nodiscard]] PaceState pace_state(const Pipeline& pipeline) const;
  [[nodiscard]] std::vector<double> shares() const;
  void space(std::uint32_t pipelines);
  void space_anew(const Moment& now);
  void space_one(Pipeline& pipeline, double share);
  void run_one(std::size_t pipeline, const BrecciaInstant& instant, double shared_cost);
  [[nodiscard]] std::string close();
  void tell_end(const std::string& lines);
  void fail(Pipeline& pipeline, const std::string& why);
  void tell_notices();
  void tell_lines(const std::string& lines);
  void open_index(const std::filesystem::path& file);
  void list_step();

  using Clock = std::chrono::steady_clock;
  InSituPlugin plugin_;
  Communicator communicator_;
  Tell tell_;
  bool stop_on_error_, failed_ = false;
  std::vector<Pipeline> pipelines_;
  void* adaptor_ = nullptr;
  std::optional<LineFile> steps_;  ///< at which pipelines wrote; of the root
  BrecciaRequests requests_{};
  Clock::time_point started_ = Clock::now(), planned_;
  double share_, end_;           ///< insitu.max_overhead; s, simulated
  std::int64_t most_steps_;      ///< 0: no limit
  double next_spacing_ = 0;      ///< s, simulated
  double opening_ = 0;           ///< s, wall: start of the adaptor
  std::optional<double> begin_;  ///< s, simulated: where this process began
  Moment now_;                   ///< of the last plan
  std::int64_t listed_ = -1;     ///< last step in the index
  Moment first_;                 ///< of the run
};

}  // namespace breccia
