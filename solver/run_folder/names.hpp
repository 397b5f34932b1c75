#pragma once

#include <string_view>

/// Reads what a run writes into its folder, for the solver, the desktop, the ParaView plug-in and the in-situ adaptor
/// alike. Header only, without MPI, HDF5, Qt and VTK; status.hpp and series.hpp need nlohmann/json.hpp, the others the
/// standard library alone. Files may grow while they are read, end in the middle of a line, and come from others: only
/// regular files are opened (system/open_regular.hpp), and what is not whole is left out and reported.
namespace breccia::run_folder {

// Names in a run's folder.
inline constexpr const char* kFrames = "frames";
inline constexpr const char* kCaseFile = "case.toml";
inline constexpr const char* kProvenance = "provenance.json";
inline constexpr const char* kHistory = "history.csv";
inline constexpr const char* kBodies = "bodies.csv";
inline constexpr const char* kStatus = "status.jsonl";
inline constexpr const char* kSummary = "summary.json";
inline constexpr const char* kCheckpoints = "checkpoints";

/// Ending of an index of frames, in frames/: elements.hdf.series, joints.hdf.series, ...
inline constexpr std::string_view kSeriesEnding = ".hdf.series";

}  // namespace breccia::run_folder
