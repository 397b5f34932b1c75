#include "commands/command_line.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "base/version.hpp"
#include "case/nearest.hpp"
#include "commands/command_line_parts.hpp"

namespace breccia {
namespace {

const char* kControlFooter =
    R"(Commands:
  pause, resume               wait between two steps; continue
  stop                        end after the present step, with everything written
  extract                     execute all in-situ pipelines on the present state
  frame                       write a frame
  frame_interval TIME         from now on a frame every so much simulated time, such as "2 us"
  checkpoint                  write the whole state, from which `breccia resume` continues
The answer comes when it is done. A line with a command in the file `control` of the run's folder does the same.)";

void define_control(CLI::App& app, Arguments& a) {
  CLI::App* control = app.add_subcommand("control", "Control a run in progress: pause, resume, stop, extract, ...");
  control->add_option("run", a.control.folder, "folder of the run")->required();
  const auto join = [&a](const std::vector<std::string>& words) {
    for (const std::string& word : words) a.control.command += (a.control.command.empty() ? "" : " ") + word;
  };
  control->add_option_function<std::vector<std::string>>("command", join, "see below")->required();
  control->add_option("--patience", a.control.patience, "seconds to wait for the answer; default 60")
      ->check(CLI::PositiveNumber);
  control->footer(kControlFooter);
}

void define_insitu(CLI::App& app, Arguments& a) {
  CLI::App* live =
      app.add_subcommand("live", "Start ParaView so that it sees a run of this case that is started with --live");
  live->add_option("case", a.live.case_file, kCaseHelp)->required();
  live->add_option("--set", a.live.overrides, kSetHelp)->allow_extra_args(false)->take_all()->check(override_text());

  CLI::App* insitu =
      app.add_subcommand("insitu", "In-situ pipelines, executed during a run: test them, or list their requirements");
  insitu->require_subcommand(1);
  insitu->add_subcommand("info", "describe the in-situ adaptor, or its missing parts");
  CLI::App* replay = insitu->add_subcommand(
      "replay", "Execute pipelines on recorded data of a run (pipelines volume, surface, fractures, ...)");
  replay->add_option("run", a.replay.run, "folder of the run")->required();
  replay->add_option("pipelines", a.replay.pipelines, "scripts exported from ParaView, or names of pipelines")
      ->required();
  replay
      ->add_option("-o,--output", a.replay.folder, "folder of their results; default: replay in the folder of the run")
      ->check(some_name());
  replay
      ->add_option("-p,--parameter", a.replay.parameters,
                   "NAME=VALUE, a parameter of the pipelines: a number, one with a unit, or a text; repeatable")
      ->allow_extra_args(false)
      ->take_all()
      ->check(override_text());
}

void define_report(CLI::App& app, Arguments& a) {
  CLI::App* report = app.add_subcommand("report", "Write one HTML page of a run, to read, print and send on");
  report->add_option("run", a.report.run, "folder of the run, which may also be in progress or killed")->required();
  report->add_option("-o,--output", a.report.file, "file of the page; default: report.html in the folder of the run")
      ->check(some_name());
  report->add_flag("--no-pictures", a.report.no_pictures, "omit pictures and statistics of the frames by ParaView");
  const char* limit = "time limit of ParaView, s; parts finished by then are shown; default 600";
  report->add_option("--time-limit", a.report.time_limit, limit)->check(CLI::Range(1, 1000000));
}

/// Adds all sub-commands and their options; parsing fills `arguments`, which must outlive the parsing.
void define_command_line(CLI::App& app, Arguments& a) {
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("breccia ") + program_version());
  app.footer(
      "Exit codes: 0 success, 1 usage, 2 case, mesh or output refused, 3 failure of the simulation, 4 error in the "
      "program, 128 + N ended by signal N: 130 Ctrl-C, 143 SIGTERM.");

  define_run(app, a);
  define_resume(app, a);
  define_control(app, a);
  define_insitu(app, a);
  define_race(app, a);

  CLI::App* check = app.add_subcommand("check", "Check a case without running it: time step, memory, run time, advice");
  check->add_option("case", a.check.case_file, kCaseHelp)->required();
  check->add_option("--set", a.check.overrides, kSetHelp)->allow_extra_args(false)->take_all()->check(override_text());
  check->add_flag("--trust-geometry", a.check.trust_geometry, kTrustHelp);

  check->add_option("--ranks", a.check.ranks, "report only the division of the model over so many ranks (mpiexec -n)")
      ->check(CLI::Range(1, 1000000));

  check->add_flag("--joints", a.check.joints,
                  "report only, as JSON, the traction curves and strengths of the joint laws");
  check->add_flag("--all", a.check.all, "all advice, not only the five that matter most");
  check->add_flag("--json", a.check.json, "as JSON, problems of the case too");

  CLI::App* mesh =
      app.add_subcommand("mesh", "Read or generate the mesh of a case and report its bodies, groups and quality");
  mesh->add_option("case", a.mesh.case_file, "case file (TOML), or a mesh or geometry that has none yet")->required();
  mesh->add_option("--set", a.mesh.overrides, kSetHelp)->allow_extra_args(false)->take_all()->check(override_text());
  mesh->add_flag("--trust-geometry", a.mesh.trust_geometry, kTrustHelp);
  mesh->add_option("-o,--output", a.mesh.folder, "write the elements for ParaView into this folder")
      ->check(some_name());
  mesh->add_flag("--json", a.mesh.json, "as JSON, problems of the case too");
  mesh->add_flag("--parameters", a.mesh.parameters,
                 "report only, as JSON, the numbers of the .geo of the case, or of a given one, that mesh.parameters "
                 "can set");

  CLI::App* diff =
      app.add_subcommand("diff", "In which keys, inputs, versions and results two runs differ, and where they part");
  diff->add_option("first", a.diff.first, "folder of a run")->required();
  diff->add_option("second", a.diff.second, "folder of another")->required();

  define_report(app, a);

  CLI::App* guide = app.add_subcommand("guide", "Open the guide in the browser, at a topic");
  guide->add_option("topic", a.guide.topic, "a section, a key, or words such as ranks; otherwise the search for them");
  guide->add_flag("--address", a.guide.address_only, "print the address of the page, open nothing");

  CLI::App* explain =
      app.add_subcommand("explain",
                         "Describe a key of the case file: unit, default, range; without one, the keys that most cases "
                         "need");
  explain->add_option("key", a.key, "such as material.young, the name of a section, or a word such as notch");
  explain->add_flag("--all", a.explain_all, "every key, also those for experts");

  CLI::App* schema = app.add_subcommand("schema", "The table of all keys of a case file, a line a key");
  schema->add_flag("--json", a.schema_json, "as JSON, with units, defaults, ranges, choices and help");
}

/// What is wrong with a command line that could not be parsed, in one line.
std::string usage_problem(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = "breccia", what = error.what();
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  const std::string lacking = " missing";
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    what = "not expected: " + case_::joined(app.remaining(true), " ");
  } else if (error.get_name() == "ArgumentMismatch" && what.ends_with(lacking) && what.find(':') != std::string::npos) {
    what.replace(what.find(':'), std::string::npos, ": the value is missing");
  }
  return printable(what) + "; `" + command + " --help` lists the allowed ones";
}

/// Message for a first word that is no command, before the rest of the line is parsed. @return  empty: all is well
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return {};
    commands.push_back(command->get_name());
  }
  const std::string meant = case_::likely_meant(argv[1], commands);
  return "unknown command \"" + std::string(argv[1]) + "\"" + (meant.empty() ? "" : "; did you mean " + meant + "?") +
         "; allowed: " + case_::joined(commands) + "; `breccia --help` describes them";
}

/// "insitu replay": the sub-commands that the line names.
std::string command_of(const CLI::App& app) {
  std::string command;
  for (const CLI::App* chosen = &app; !chosen->get_subcommands().empty();) {
    chosen = chosen->get_subcommands().front();
    command += (command.empty() ? "" : " ") + chosen->get_name();
  }
  return command;
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CommandLine line;
  CLI::App app{"Breccia: combined finite-discrete element simulation of solids that break"};
  define_command_line(app, line.arguments);
  line.problem = printable(unknown_command(app, argc, argv));
  if (!line.problem.empty()) return line;
  try {
    app.parse(argc, argv);
    line.command = command_of(app);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      line.problem = usage_problem(app, error);
    } else {
      std::ostringstream answer;
      app.exit(error, answer, answer);
      line.answer = answer.str();
    }
  }
  return line;
}

}  // namespace breccia
