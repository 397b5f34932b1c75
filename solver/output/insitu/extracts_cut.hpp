#pragma once

#include <cstdint>
#include <filesystem>

namespace breccia {

/// First line of the index of extracts; a line "step,time" for each step at which pipelines wrote follows.
inline constexpr const char* kExtractsHeader = "step,time [s]";

/// Removes the extracts of in-situ pipelines from a step on, before a run continues from there: files and folders whose
/// names end in such a step of the index (`fractures_000000120.pvtu`, `stress_000000120.png`), their entries in lists
/// of times (.pvd), the lines of a history.csv and of probes, and those of the index. Everything else stays: files
/// without a step in their names, or with a number that is no step of the run. Links are neither followed nor removed.
/// No folder: nothing is done.
/// @param index  extracts.csv of the run; none there: no file is removed
/// @param step   done so far: extracts of this step are made again
/// Throws OutputError that names the file.
void cut_extracts_back(const std::filesystem::path& extracts, const std::filesystem::path& index, std::int64_t step);

/// Takes back all that pipelines wrote, before another run in the same folder: as above from the first step on, the
/// tables, lists of times and logs of scripts as a whole, and folders that are empty then. Throws OutputError that
/// names the file.
void remove_extracts(const std::filesystem::path& extracts, const std::filesystem::path& index);

}  // namespace breccia
