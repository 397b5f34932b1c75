#pragma once

#include <filesystem>

#include "output/folder/run_folder.hpp"

namespace breccia {

/// Throws OutputError that names the first thing under a name of a run's files that is a link, a pipe, a device or a
/// socket; or a link in place of one of its folders. Called before anything of a run's folder is read or written, so
/// that every command gives the same line; what is opened later is checked again as it is opened.
/// No folder: nothing is done.
void demand_plain_folder(const RunFolder& run);

/// Likewise for everything below a folder of a run into which pipelines write by names that others can foresee.
void demand_plain_tree(const std::filesystem::path& folder);

/// Throws OutputError where `folder` is `above` or lies in it, however the two are written.
void refuse_inside(const std::filesystem::path& folder, const std::filesystem::path& above, const char* what);

/// Frames, their indices and what a kill may have left of either.
[[nodiscard]] bool is_frame_file(const std::string& name);

}  // namespace breccia
