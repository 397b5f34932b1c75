#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "commands/race.hpp"
#include "output/folder/status_sink.hpp"
#include "parallel/communicator.hpp"

/// The sub-commands of the program; main.cpp reads their arguments. Each returns the exit code of success or throws.
namespace breccia {

struct RunCommand {
  std::filesystem::path case_file;
  std::filesystem::path folder;        ///< empty: runs/<folder of the case>
  std::vector<std::string> overrides;  ///< key=value
  bool trust_geometry = false;         ///< the mesh may run programs and write files
  bool overwrite = false;
  ProgressMode progress = ProgressMode::log;
  std::vector<std::string> command_line;
};
/// Collective over the world; the others are the work of one rank.
int run_command(const RunCommand& asked, const Communicator& world);

struct ResumeCommand {
  std::filesystem::path run;                               ///< its folder, or a checkpoint in it
  std::filesystem::path folder;                            ///< of the results; empty: the run's own
  std::vector<std::string> overrides;                      ///< key=value
  double until = std::numeric_limits<double>::infinity();  ///< s, simulated
  bool without_insitu = false;                             ///< pipelines and live view of the case are left out
  ProgressMode progress = ProgressMode::log;
  std::vector<std::string> command_line;
};
/// Collective over the world.
int resume_command(const ResumeCommand& asked, const Communicator& world);

struct ControlCommand {
  std::filesystem::path folder;  ///< of the run
  std::string command;
  double patience = 60;  ///< s
};
int control_command(const ControlCommand& asked);

struct LiveCommand {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
};
/// Becomes ParaView with a prepared view, which listens at the address of the case, or localhost:22222 without one;
/// returns only by throwing.
int live_command(const LiveCommand& asked);

struct ReplayCommand {
  std::filesystem::path run;            ///< folder of a run with recorded extracts
  std::vector<std::string> pipelines;   ///< names, or scripts
  std::filesystem::path folder;         ///< of what they write; empty: replay in the folder of the run
  std::vector<std::string> parameters;  ///< of all of them: NAME=VALUE
};
/// Collective over the world.
int replay_command(const ReplayCommand& asked, const Communicator& world);

/// What the in-situ adaptor is, or what is missing.
int insitu_info_command();

struct RaceCommand {
  std::filesystem::path case_file;
  std::filesystem::path folder;  ///< of race.csv; empty: nothing is written
  std::vector<std::string> overrides;
  bool trust_geometry = false;  ///< the mesh may run programs and write files
  RaceSettings settings;
  ProgressMode progress = ProgressMode::log;
};
/// Collective over the world.
int race_command(const RaceCommand& asked, const Communicator& world);

struct CheckCommand {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
  bool trust_geometry = false;  ///< the mesh may run programs and write files
  int ranks = 0;                ///< > 0: only how the model is divided among so many
  bool joints = false;          ///< only the curves of the joint laws, as JSON
  bool all = false;             ///< all advice
  bool json = false;
};
/// @param launched  ranks that the launcher has started
int check_command(const CheckCommand& asked, int launched);

struct MeshCommand {
  std::filesystem::path case_file;
  std::vector<std::string> overrides;
  bool trust_geometry = false;   ///< the mesh may run programs and write files
  std::filesystem::path folder;  ///< empty: report only
  bool json = false;
  bool parameters = false;  ///< only what the geometry lets the case set
};
int mesh_command(const MeshCommand& asked);

struct DiffCommand {
  std::filesystem::path first, second;  ///< folders of runs
};
int diff_command(const DiffCommand& asked);

struct ReportCommand {
  std::filesystem::path run;   ///< folder of the run
  std::filesystem::path file;  ///< of the page; empty: report.html in the folder of the run
  bool no_pictures = false;    ///< nor statistics of the frames, both by ParaView
  int time_limit = 600;        ///< s, for ParaView
};
int report_command(const ReportCommand& asked);

struct GuideCommand {
  std::string topic;          ///< a section, a key, or words of a page's name; empty: the first page
  bool address_only = false;  ///< print the address, open nothing
};
/// Prints the address of a page of the guide and opens it in the browser, where there is a display.
/// Throws OutputError where the guide is not installed.
int guide_command(const GuideCommand& asked);

int explain_command(const std::string& key, bool all);

/// The table of all keys: a line a key, or JSON.
int schema_command(bool json);

}  // namespace breccia
