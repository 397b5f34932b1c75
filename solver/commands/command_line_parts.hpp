#pragma once

#include <CLI/CLI.hpp>

#include "base/printable.hpp"
#include "commands/command_line.hpp"

/// What the definitions of several sub-commands share.
namespace breccia {

inline constexpr const char* kCaseHelp = "case file (TOML); `breccia explain` lists its keys";
inline constexpr const char* kSetHelp =
    "override a key of the case: material.glass.young=\"70 GPa\", time.safety=0.5; may be given several times";

inline constexpr const char* kProgressHelp =
    "bar, log (a line every few seconds), json (JSON lines on stdout), none; default auto: a bar on a terminal";

inline constexpr const char* kTrustHelp =
    "let the geometry use all functions of gmsh: run programs, write files; without, a confined process reads it";

/// An override names a key and a value.
inline CLI::Validator override_text() {
  const auto check = [](const std::string& text) -> std::string {
    if (text.find('=') != std::string::npos && text.front() != '=') return {};
    return "no override; allowed: key=value, such as time.safety=0.5; given: \"" + printable(text) + "\"";
  };
  return {check, ""};
}

/// A name of a file or folder is not empty: an empty one is a variable of a script that was not set.
inline CLI::Validator some_name() {
  const auto check = [](const std::string& text) -> std::string {
    return text.empty() ? "is empty; allowed: a name" : "";
  };
  return {check, ""};
}

void define_run(CLI::App& app, Arguments& arguments);
void define_resume(CLI::App& app, Arguments& arguments);
void define_race(CLI::App& app, Arguments& arguments);

}  // namespace breccia
