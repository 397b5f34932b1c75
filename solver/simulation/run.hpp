#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"
#include "output/checkpoint.hpp"
#include "output/run_folder.hpp"
#include "output/sink.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Set from outside (a signal handler) to end the run after the present step, with everything written.
extern std::atomic<bool> stop_requested;

/// Carries a case through all its stages and tells the sinks. Collective.
/// @param whole  the model built from the case, on the root; null elsewhere
/// @param sinks  of this rank: those that write for all are on the root alone; frames hold the rank's own elements
/// @param folder  of the run, for its control file and the extracts of its pipelines; null: it cannot be controlled,
/// and no pipelines Returns the summary, which the sinks have got too. Throws SimulationError after a last frame and a
/// summary that names the error; OutputError as it comes from a sink.
Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole,
                 const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator = {},
                 const RunFolder* folder = nullptr);

struct ResumeOptions {
  double until = std::numeric_limits<double>::infinity();  ///< s: the run stops there
  bool extended = false;                                   ///< the last stage ends later than when it was begun
};

/// Goes on from a checkpoint of the case, on any number of ranks, as if nothing had happened; files beyond it are cut
/// back to it. Collective. @param from  as read_checkpoint gave it
/// Returns and throws as run_case.
Summary resume_case(const case_::Case& input, Checkpoint from, const ResumeOptions& options,
                    const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                    const RunFolder& folder);

}  // namespace breccia
