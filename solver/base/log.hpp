#pragma once

#include <filesystem>
#include <string_view>

/// Messages to the person who runs the program: one line each on stderr, and in a file when one is opened. Progress and
/// results are not messages; they have their own sinks. Safe to call from several threads.
namespace breccia::log {

enum class Level { info, warning, error };

/// Messages below `level` are dropped, on stderr and in the file. Default: info.
void set_level(Level level);

/// From now on every message also goes to `file`, with its time; the file is emptied first, its folder created.
/// A second call changes to the new file. Throws OutputError when it cannot be written.
void open_file(const std::filesystem::path& file);

void info(std::string_view message);
void warning(std::string_view message);
void error(std::string_view message);

}  // namespace breccia::log
