#pragma once

#include <string>

#include "commands/commands.hpp"

namespace breccia {

/// What one invocation asked for.
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
  std::string answer;   ///< the help or the version that it asks for
};
[[nodiscard]] CommandLine read_command_line(int argc, char** argv);

}  // namespace breccia
