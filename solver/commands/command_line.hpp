#pragma once

#include <string>

#include "commands/commands.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

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
  bool schema_json = false;
  std::string progress = "auto";
};

/// Adds all sub-commands and their options; parsing fills `arguments`, which must outlive the parsing.
void define_command_line(CLI::App& app, Arguments& arguments);

/// What is wrong with a command line that could not be parsed, in one line.
std::string usage_problem(const CLI::App& app, const CLI::ParseError& error);

/// A first word that is no command, told before anything else of the line is read. @return  empty: all is well
std::string unknown_command(const CLI::App& app, int argc, char** argv);

}  // namespace breccia
