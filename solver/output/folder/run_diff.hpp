#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// In what two runs differ, in lines: keys of the resolved cases, inputs by their hashes, versions and machines
/// (provenance.json), results (summary.json), and the first line of history.csv where they differ, with the differing
/// columns. Durations of a run are ignored.
/// Throws OutputError for a folder that is no run of breccia's.
[[nodiscard]] std::string diff_runs(const std::filesystem::path& first, const std::filesystem::path& second);

}  // namespace breccia
