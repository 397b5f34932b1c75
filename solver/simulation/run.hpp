#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/folder/run_folder.hpp"
#include "output/sink.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Set from outside (a signal handler) to end the run after the present step, with everything written.
extern std::atomic<bool> stop_requested;

/// Runs all stages of a case and informs the sinks. Collective.
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

/// Continues from a checkpoint of the case, on any number of ranks, with bitwise identical results; files beyond it are
/// cut back to it. Collective. @param from  as read_checkpoint gave it
/// Returns and throws as run_case.
Summary resume_case(const case_::Case& input, Checkpoint from, const ResumeOptions& options,
                    const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                    const RunFolder& folder);

struct StartOptions {
  std::string words;             ///< where the state is from, for the status
  bool new_laws = false;         ///< materials, joints or contacts have other laws than in the run that left the state
  std::vector<std::string> cut;  ///< surfaces that either run breaks, where this one breaks others; empty: it does not
};

/// Runs all stages of a case from the state of another one, bitwise identical on any number of ranks. Time, steps and
/// accounted works continue. With the same laws the energy residual does as well; with new ones the energies of the
/// first sample are the initial energy, and the residual is counted from there. Collective.
/// @param from  as read_checkpoint gave it;  @pre input changes nothing that the state fixes (parent_case.hpp)
/// Returns and throws as run_case.
Summary start_case(const case_::Case& input, Checkpoint from, const StartOptions& options,
                   const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                   const RunFolder& folder);

}  // namespace breccia
