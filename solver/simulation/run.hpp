#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "output/sink.hpp"
#include "simulation/model.hpp"

namespace breccia {

/// Set from outside (a signal handler) to end the run after the present step, with everything written.
extern std::atomic<bool> stop_requested;

/// Carries a case through all its stages and tells the sinks.
/// @param model  built from the case
/// Returns the summary, which the sinks have got too. Throws SimulationError after a last frame and a summary that names the
/// error; OutputError as it comes from a sink.
Summary run_case(const case_::Case& input, const Model& model, const std::vector<std::unique_ptr<Sink>>& sinks);

}  // namespace breccia
