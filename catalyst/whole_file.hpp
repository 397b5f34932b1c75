#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace breccia::insitu {

enum class Sync { yes, no };  ///< whether content is on the disk, for a crash of the machine too, before its name is

/// Replaces a file at once: a temporary beside it is written, synced and renamed, so that a kill leaves the old or the
/// new content. Returns the bytes written. Throws PipelineError "path: what: reason"; then the temporary is removed.
std::int64_t replace_file(const std::filesystem::path& path, std::string_view content, Sync sync = Sync::yes);

/// Appends at the end of a file, which is made when it is not there. Throws PipelineError; then nothing is appended.
std::int64_t append_to_file(const std::filesystem::path& path, std::string_view content);

/// Content of a file; empty when there is none. Throws PipelineError when it cannot be read.
[[nodiscard]] std::string file_content(const std::filesystem::path& path);

/// Makes a folder and those above it. Throws PipelineError.
void make_folder(const std::filesystem::path& path);

/// The shortest decimal that reads back as the same double.
[[nodiscard]] std::string exact(double value);

/// A text in one line: line ends and control characters become spaces, runs of them one.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace breccia::insitu
