#pragma once

#include <string>

#include "commands/commands.hpp"

namespace breccia {

/// Parsed command line.
struct Arguments {
  RunCommand run;
  ResumeCommand resume;
  RaceCommand race;
  CheckCommand check;
  MeshCommand mesh;
  ControlCommand control;
  LiveCommand live;
  ReplayCommand replay;
  DiffCommand diff;
  ReportCommand report;
  std::string key;
  bool explain_all = false;
  GuideCommand guide;
  bool schema_json = false;
  std::string progress = "auto";
};

/// A command line as it was read.
struct CommandLine {
  std::string command;  ///< "run", "insitu replay", ...; empty: there is nothing to do but to print
  Arguments arguments;
  std::string problem;  ///< what is wrong with it, in one line; empty: nothing
  std::string answer;   ///< text of --help or --version, if given
};
[[nodiscard]] CommandLine read_command_line(int argc, char** argv);

}  // namespace breccia
