#pragma once

#include <cstdint>
#include <filesystem>

namespace breccia {

/// Takes back what in-situ pipelines wrote from a step on, before a run goes on from there: files and folders whose
/// names end in the step (`fractures_000000120.pvtu`, `stress_000000120.png`), what lists of times (.pvd) say of them,
/// and the lines of a history.csv and of probes. Files without a step in their names stay. No folder: nothing is done.
/// @param step  done so far: extracts of this step are made again
/// Throws OutputError that names the file.
void cut_extracts_back(const std::filesystem::path& extracts, std::int64_t step);

}  // namespace breccia
