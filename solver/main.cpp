#include <malloc.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "case/live_address.hpp"
#include "case/nearest.hpp"
#include "case/schema.hpp"
#include "case/units.hpp"
#include "commands/commands.hpp"
#include "commands/environment.hpp"
#include "parallel/mpi_session.hpp"
#include "simulation/run.hpp"
#include "simulation/run_checkpoints.hpp"

namespace {

using namespace breccia;

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

volatile std::sig_atomic_t speaks_of_signals = 0;  // one rank tells

/// Ctrl-C, a polite kill and a closed terminal end the run after the present step, with everything written; a second
/// one kills.
void stop_handler(int signal) {
  interruption = signal;
  stop_requested = true;
  std::signal(signal, SIG_DFL);
  if (!speaks_of_signals) return;
  const char words[] = "\nbreccia: ending after the present step; a second signal ends at once\n";
  (void)!::write(STDERR_FILENO, words, sizeof words - 1);
}

/// A checkpoint is written while the run goes on.
void checkpoint_handler(int) { checkpoint_requested = true; }

/// What is freed is soon asked for again, above all when elements change ranks; getting large blocks anew from the
/// kernel each time costs more than the work on them.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

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

const char* kCaseHelp = "case file (TOML); `breccia explain` lists its keys";
const char* kSetHelp =
    "override a key of the case: material.glass.young=\"70 GPa\", time.safety=0.5; may be given several times";

const char* kProgressHelp =
    "bar, log (a line every few seconds), json (JSON lines on stdout), none; default auto: a bar on a terminal";

const char* kTrustHelp =
    "the geometry may do what gmsh lets it: run programs, write files; without, it is read by a process that cannot";

const CLI::IsMember& progress_modes() {
  static const CLI::IsMember modes({"auto", "bar", "log", "json", "none"});
  return modes;
}

/// Seconds of simulated time, with a unit or without.
double seconds_of(const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value)) value = case_::to_si(text, "s");
  return value;
}

/// Refuses what is no simulated time, and 0 unless it is allowed.
CLI::Validator simulated_time(bool zero_allowed) {
  const auto check = [zero_allowed](const std::string& text) -> std::string {
    try {
      const double value = seconds_of(text);
      if (std::isfinite(value) && (value > 0 || (zero_allowed && value == 0))) return {};
    } catch (const case_::UnitError&) {
    }
    return std::string("a simulated time ") + (zero_allowed ? "of at least" : "above") +
           " 0 is allowed, such as \"20 us\"; given: " + text;
  };
  return {check, "TIME"};
}

const char* kRaceFooter =
    R"(Every algorithm races with every buffer, from the same state to the same step, in three laps of which the least
times count. All must end in the same state: how contact is looked for never changes a result.

The table has, the fastest first: searches in a lap and how many of them were used up (the last one lasts beyond the
lap), the time of all searching and of one search, couples at the end, the time of contact forces, and that of a step
as a whole, which pays for searches used up; on several ranks (mpiexec -n N) times are those of the slowest. Below it
stand the lines for the case file; `breccia explain detection` tells what they mean.

Race where it matters, once things fly:  breccia race case.toml --from "50 us"
Ctrl-C ends the race after the present step; what all have finished is told.)";

void define_race(CLI::App& app, Arguments& a) {
  CLI::App* race =
      app.add_subcommand("race", "Which contact search is the fastest for a case: run a stretch of it with each");
  RaceSettings& s = a.race.settings;
  race->add_option("case", a.race.case_file, kCaseHelp)->required();
  const auto set_time = [&s](const std::string& text) { s.time = seconds_of(text); };
  const auto set_from = [&s](const std::string& text) { s.from = seconds_of(text); };
  CLI::Option* time =
      race->add_option_function<std::string>(
              "--time", set_time,
              "length of a lap in simulated time, such as \"20 us\"; default: ten searches, and a minute for all laps")
          ->check(simulated_time(false));
  race->add_option("--steps", s.steps, "length of a lap in steps")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}))
      ->excludes(time);
  race->add_option_function<std::string>(
          "--from", set_from, "simulated time at which the race starts: the case is run that far once; default 0")
      ->check(simulated_time(true));
  const std::vector<std::string> names = case_::key_of("detection.algorithm").choice_list();
  const auto choose = [&s, names](const std::vector<std::string>& chosen) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::find(chosen.begin(), chosen.end(), names[i]) != chosen.end())
        s.algorithms.push_back(static_cast<case_::DetectionAlgorithm>(i));
    }
  };
  race->add_option_function<std::vector<std::string>>(
          "--algorithms", choose,
          "who races, such as ms,sorted_grid; default: all, brute_force only where the model is small")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(names));
  race->add_option("--buffers", s.buffers,
                   "buffers as multiples of the case's own, which races in any event; default 0.5,1,2,4")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0.01, 100.0));
  race->add_option("--set", a.race.overrides, kSetHelp)->allow_extra_args(false)->take_all();
  race->add_flag("--trust-geometry", a.race.trust_geometry, kTrustHelp);
  race->add_option("-o,--output", a.race.folder,
                   "write the table as race.csv into this folder; default: nothing is written");
  race->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  race->footer(kRaceFooter);
}

const char* kControlFooter =
    R"(Commands:
  pause, resume               wait between two steps, and go on
  stop                        end after the present step, with everything written
  extract                     let all in-situ pipelines work on the present state
  frame                       write a frame
  frame_interval TIME         from now on a frame every so much simulated time, such as "2 us"
  checkpoint                  write the whole state, from which `breccia resume` goes on
The answer comes when it is done. A line with a command in the file `control` of the run's folder does the same.)";

void define_control(CLI::App& app, Arguments& a) {
  CLI::App* control =
      app.add_subcommand("control", "Ask something of a run that goes on: pause, resume, stop, extract, ...");
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
  live->add_option("--set", a.live.overrides, kSetHelp)->allow_extra_args(false)->take_all();

  CLI::App* insitu =
      app.add_subcommand("insitu", "Pipelines that work while a run goes on: try them, or see what they need");
  insitu->require_subcommand(1);
  insitu->add_subcommand("info", "what the in-situ adaptor is, or what is missing");
  CLI::App* replay = insitu->add_subcommand(
      "replay", "Feed what a run has recorded (pipelines volume, surface, fractures, ...) through pipelines");
  replay->add_option("run", a.replay.run, "folder of the run")->required();
  replay->add_option("pipelines", a.replay.pipelines, "scripts exported from ParaView, or names of pipelines")
      ->required();
  replay->add_option("-o,--output", a.replay.folder,
                     "folder of what they write; default: replay in the folder of the run");
}

const char* kResumeFooter =
    R"(The run goes on as if nothing had happened: the same bits, whatever the number of ranks (mpiexec -n N), the
division among them, the contact search and the instruction set. Lines of history.csv and status.jsonl and frames
beyond the checkpoint are dropped and made anew. With -o the run's folder stays as it is, and the other one gets
all results.

A checkpoint that is cut off or damaged is named, and the one before it is used; checkpoint.keep says how many
there are.)";

void define_resume(CLI::App& app, Arguments& a) {
  CLI::App* resume = app.add_subcommand("resume", "Go on with a run from its last checkpoint, on any number of ranks");
  resume->add_option("run", a.resume.run, "folder of the run, or one of its checkpoints")->required();
  resume->add_option("-o,--output", a.resume.folder, "folder of the results; default: the run's own");
  const auto set_until = [&a](const std::string& text) { a.resume.until = seconds_of(text); };
  resume
      ->add_option_function<std::string>(
          "--until", set_until,
          "simulated time, such as \"2 ms\": before the end of the case the run stops there, beyond it the last stage "
          "goes on to it; default: the end")
      ->check(simulated_time(false));
  resume
      ->add_option(
          "--set", a.resume.overrides,
          "override keys of [domains], [detection], [checkpoint], or time.max_steps; others would change the results")
      ->allow_extra_args(false)
      ->take_all();
  resume->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  resume->footer(kResumeFooter);
}

void define_report(CLI::App& app, Arguments& a) {
  CLI::App* report = app.add_subcommand("report", "Write one HTML page of a run, to read, print and send on");
  report->add_option("run", a.report.run, "folder of the run, which may go on or have been killed")->required();
  report->add_option("-o,--output", a.report.file, "file of the page; default: report.html in the folder of the run");
  report->add_flag("--no-pictures", a.report.no_pictures, "leave out what ParaView makes of the frames");
  const char* limit = "seconds that ParaView may take; what is done by then is shown; default 600";
  report->add_option("--time-limit", a.report.time_limit, limit)->check(CLI::Range(1, 1000000));
}

/// What --live and --insitu add to the case, as overrides.
void define_run_insitu(CLI::App& run, Arguments& a) {
  const auto live = [&a](const std::vector<std::string>& address) {
    a.run.overrides.push_back("insitu.live.address=\"" +
                              (address.empty() || address[0].empty() ? case_::live_address : address[0]) + "\"");
  };
  CLI::Option* asked = run.add_option_function<std::vector<std::string>>(
                              "--live", live,
                              "offer the run to ParaView (Catalyst > Connect there), which listens at host:port, "
                              "default localhost:22222; after the case file, or --live=HOST:PORT")
                           ->expected(0, 1)
                           ->type_name("[HOST:PORT]");
  run.add_flag_callback(
         "--live-remote", [&a] { a.run.overrides.emplace_back("insitu.live.remote=true"); },
         "the live view may leave this machine; nothing is encrypted")
      ->needs(asked);
  const auto pipelines = [&a](const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names)
      list += (list.empty() ? "\"" : ", \"") +
              (case_::is_script(name) ? std::filesystem::absolute(name).string() : name) + "\"";
    a.run.overrides.push_back("insitu.run=[" + list + "]");
  };
  run.add_option_function<std::vector<std::string>>(
         "--insitu", pipelines,
         "pipelines that work while the run goes on, separated by commas, such as fractures,stress; a script by its "
         "path; `breccia explain insitu`")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->take_all();
}

void define(CLI::App& app, Arguments& a) {
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("breccia ") + BRECCIA_VERSION);
  app.footer(
      "Exit codes: 0 success, 1 usage, 2 case, mesh or output refused, 3 the numbers went wrong, 4 a fault of ours, "
      "128 + N ended by signal N: 130 Ctrl-C, 143 a polite kill.");

  CLI::App* run = app.add_subcommand("run", "Run a case through all its stages");
  run->add_option("case", a.run.case_file, kCaseHelp)->required();
  run->add_option("-o,--output", a.run.folder, "folder of the results; default runs/<folder of the case>");
  run->add_option("--set", a.run.overrides, kSetHelp)->allow_extra_args(false)->take_all();
  run->add_flag("--trust-geometry", a.run.trust_geometry, kTrustHelp);
  run->add_flag("-f,--overwrite", a.run.overwrite, "replace the results of an earlier run in that folder");
  run->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  run->footer(
      "Writes frames for ParaView (frames/*.series), history.csv, status.jsonl, summary.json and .txt, the resolved "
      "case and provenance.json.\n"
      "Ctrl-C ends the run after the present step with everything written, with exit code 130 (under mpiexec, which "
      "kills a second after it, `breccia control FOLDER stop` is the way); `breccia resume` goes on with it, also "
      "after a power cut, from the last of its checkpoints (`breccia explain checkpoint`). SIGUSR1 asks for one.");

  define_run_insitu(*run, a);
  define_resume(app, a);

  define_control(app, a);
  define_insitu(app, a);
  define_race(app, a);

  CLI::App* check =
      app.add_subcommand("check", "Everything short of the first step: time step, memory, run time, advice");
  check->add_option("case", a.check.case_file, kCaseHelp)->required();
  check->add_option("--set", a.check.overrides, kSetHelp)->allow_extra_args(false)->take_all();
  check->add_flag("--trust-geometry", a.check.trust_geometry, kTrustHelp);

  check
      ->add_option("--ranks", a.check.ranks, "tell only how a run on so many ranks (mpiexec -n) would divide the model")
      ->check(CLI::Range(1, 1000000));

  check->add_flag("--joints", a.check.joints,
                  "tell only, as JSON, the traction curves and strengths of the joint laws");
  check->add_flag("--json", a.check.json, "as JSON, problems of the case too");

  CLI::App* mesh =
      app.add_subcommand("mesh", "Read or generate the mesh of a case and report its bodies, groups and quality");
  mesh->add_option("case", a.mesh.case_file, "case file (TOML), or a STEP, BREP or STL file that has none yet")
      ->required();
  mesh->add_option("--set", a.mesh.overrides, kSetHelp)->allow_extra_args(false)->take_all();
  mesh->add_flag("--trust-geometry", a.mesh.trust_geometry, kTrustHelp);
  mesh->add_option("-o,--output", a.mesh.folder, "write the elements for ParaView into this folder");
  mesh->add_flag("--json", a.mesh.json, "as JSON, problems of the case too");

  CLI::App* diff =
      app.add_subcommand("diff", "In which keys, inputs, versions and results two runs differ, and where they part");
  diff->add_option("first", a.diff.first, "folder of a run")->required();
  diff->add_option("second", a.diff.second, "folder of another")->required();

  define_report(app, a);

  CLI::App* explain =
      app.add_subcommand("explain", "What a key of the case file means: unit, default, range; all keys without one");
  explain->add_option("key", a.key, "such as material.young, or the name of a section");

  CLI::App* schema = app.add_subcommand("schema", "The table of all keys of a case file, a line a key");
  schema->add_flag("--json", a.schema_json, "as JSON, with units, defaults, ranges, choices and help");
}

int dispatch(const CLI::App& app, Arguments& a, const Communicator& world, int argc, char** argv) {
  if (app.got_subcommand("run") || app.got_subcommand("resume") || app.got_subcommand("race")) {
    const std::map<std::string, ProgressMode> modes{{"bar", ProgressMode::bar},
                                                    {"log", ProgressMode::log},
                                                    {"json", ProgressMode::json},
                                                    {"none", ProgressMode::none}};
    const auto mode = modes.find(a.progress);
    a.run.progress = a.resume.progress = a.race.progress =
        mode != modes.end() ? mode->second : default_progress_mode(STDOUT_FILENO);
    if (app.got_subcommand("race")) return race_command(a.race, world);
    a.run.command_line.assign(argv, argv + argc);
    a.resume.command_line = a.run.command_line;
    if (app.got_subcommand("resume")) return resume_command(a.resume, world);
    return run_command(a.run, world);
  }
  if (app.got_subcommand("insitu") && app.get_subcommand("insitu")->got_subcommand("replay"))
    return replay_command(a.replay, world);
  if (!world.is_root()) return code(ExitCode::success);  // what follows is the work of one
  if (app.got_subcommand("check")) return check_command(a.check, world.size());
  if (app.got_subcommand("mesh")) return mesh_command(a.mesh);
  if (app.got_subcommand("diff")) return diff_command(a.diff);
  if (app.got_subcommand("report")) return report_command(a.report);
  if (app.got_subcommand("control")) return control_command(a.control);
  if (app.got_subcommand("live")) return live_command(a.live);
  if (app.got_subcommand("insitu")) return insitu_info_command();
  if (app.got_subcommand("schema")) return schema_command(a.schema_json);
  return explain_command(a.key);
}

/// What went wrong, told by `speaks` alone.
int report(bool speaks, const std::string& what, ExitCode exit_code) {
  if (speaks) std::fprintf(stderr, "breccia: error: %s\n", what.c_str());
  return code(exit_code);
}

/// Errors of the first three kinds are agreed upon: all ranks have the same one and one of them tells it. Others are of
/// one rank, and the rest would wait for it for ever.
int guarded(const CLI::App& app, Arguments& arguments, MpiSession& session, int argc, char** argv) {
  const bool root = session.world().is_root();
  int ended = 0;
  try {
    check_environment();
    const int done = dispatch(app, arguments, session.world(), argc, argv);
    return interruption != 0 && done == 0 ? exit_code_of(interruption) : done;
  } catch (const InputError& error) {
    const int refused = report(root, error.what(), ExitCode::input);
    return interruption != 0 ? exit_code_of(interruption) : refused;
  } catch (const SimulationError& error) {
    return report(root, error.what(), ExitCode::simulation);
  } catch (const std::bad_alloc&) {
    ended = report(true, out_of_memory().text(), ExitCode::input);
  } catch (const std::filesystem::filesystem_error& error) {  // a file or folder that cannot be used
    ended = report(true, error.what(), ExitCode::input);
  } catch (const std::exception& error) {
    ended = report(true, error.what(), ExitCode::internal);
  }
  session.abort(ended);
  return ended;
}

/// A first word that is no command, told before anything else of the line is read. @return  empty: all is well
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return {};
    commands.push_back(command->get_name());
  }
  const std::string meant = case_::likely_meant(argv[1], commands);
  return "unknown command \"" + std::string(argv[1]) + "\"" + (meant.empty() ? "" : "; did you mean " + meant + "?") +
         "; allowed: " + case_::joined(commands) + "; `breccia --help` tells what they do";
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  MpiSession session(argc, argv);
  CLI::App app{"Breccia: combined finite-discrete element simulation of solids that break"};
  Arguments arguments;
  define(app, arguments);
  if (const std::string complaint = unknown_command(app, argc, argv); !complaint.empty())
    return report(session.world().is_root(), complaint, ExitCode::usage);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream nowhere;
    const bool root = session.world().is_root();
    const int answer = root ? app.exit(error) : app.exit(error, nowhere, nowhere);
    return answer == 0 ? code(ExitCode::success) : code(ExitCode::usage);
  }
  const auto asked_for = [&](const char* command) { return app.got_subcommand(command); };
  const bool in_order = asked_for("run") || asked_for("resume") || asked_for("race");  // the others lose nothing
  if (in_order) {
    speaks_of_signals = session.world().is_root() ? 1 : 0;
    for (const int s : {SIGINT, SIGTERM, SIGHUP}) std::signal(s, stop_handler);
    std::signal(SIGUSR1, checkpoint_handler);
  }
  std::signal(SIGPIPE, SIG_IGN);  // who reads the progress may go; the run goes on
  std::signal(SIGXFSZ, SIG_IGN);  // a file over its limit is an error of the write, told with the file's name
  return guarded(app, arguments, session, argc, argv);
}
