#pragma once

#include <memory>
#include <vector>

#include "case/case.hpp"
#include "output/folder/run_folder.hpp"
#include "output/folder/status_sink.hpp"
#include "output/sink.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// What receives the results of a run on this rank: frames are written by all ranks together, everything else by the
/// root. @pre the folder is ready. Collective; throws OutputError on all ranks.
[[nodiscard]] std::vector<std::unique_ptr<Sink>> run_sinks(const case_::Case& input, const RunFolder& folder,
                                                           ProgressMode progress, const Communicator& world);

/// Final report of a run on the terminal.
void print_results(const Summary& summary, const RunFolder& folder, ProgressMode progress, const Communicator& world);

}  // namespace breccia
