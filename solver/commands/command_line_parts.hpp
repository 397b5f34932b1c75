#pragma once

#include <CLI/CLI.hpp>

#include "commands/command_line.hpp"

/// What the definitions of several sub-commands share.
namespace breccia {

inline constexpr const char* kCaseHelp = "case file (TOML); `breccia explain` lists its keys";
inline constexpr const char* kSetHelp =
    "override a key of the case: material.glass.young=\"70 GPa\", time.safety=0.5; may be given several times";

inline constexpr const char* kProgressHelp =
    "bar, log (a line every few seconds), json (JSON lines on stdout), none; default auto: a bar on a terminal";

inline constexpr const char* kTrustHelp =
    "the geometry may do what gmsh lets it: run programs, write files; without, it is read by a process that cannot";

void define_run(CLI::App& app, Arguments& arguments);
void define_resume(CLI::App& app, Arguments& arguments);
void define_race(CLI::App& app, Arguments& arguments);

}  // namespace breccia
