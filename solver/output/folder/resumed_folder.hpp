#pragma once

#include "output/checkpoint/checkpoint.hpp"
#include "output/folder/run_folder.hpp"

namespace breccia {

/// Whether the summary of the run in a folder reports completion after so many steps.
[[nodiscard]] bool is_complete(const RunFolder& folder, std::int64_t steps);

/// Throws InputError where a checkpoint is of another run than the one in a folder: its history would be continued by
/// rows of another case. A folder without provenance names no run.
void demand_own_run(const RunFolder& folder, const std::filesystem::path& file, const Checkpoint& from);

/// Prepares a folder for a run that continues from a checkpoint. In its own folder later checkpoints, later extracts
/// and the summary are removed and the case is written anew. Another folder gets the history, the status and the frames
/// as they are, and the extracts as far as the checkpoint; in both, sinks cut the first three back when they start. On
/// the root. Throws OutputError with the path; then the run's own folder is unchanged, or the run can be continued from
/// it.
[[nodiscard]] RunFolder prepare_resumed_folder(const RunFolder& run, const std::filesystem::path& root,
                                               const Checkpoint& from, const std::string& resolved_case,
                                               const Provenance& provenance);

}  // namespace breccia
