#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "case/live_address.hpp"
#include "case/schema.hpp"
#include "case/units.hpp"
#include "commands/command_line_parts.hpp"

namespace breccia {
namespace {

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
    R"(Every search algorithm is timed with every buffer, from the same state to the same step; the best of three
repetitions counts. All must end in the same state: the contact search never changes a result.

The table lists, the fastest first: searches of a repetition and how many of them expired (the last one remains
valid), the time of all searches and of one, couples at the end, the time of contact forces, and that of a step
as a whole, expired searches included; on several ranks (mpiexec -n N) times are those of the slowest. Below it
are the lines for the case file; `breccia explain detection` explains them.

Time a state with moving bodies:  breccia race case.toml --from "50 us"
Ctrl-C ends the race after the present step; completed results are reported.)";

const char* kResumeFooter =
    R"(The run continues as without the interruption: bitwise identical for any number of ranks (mpiexec -n N), any
division among them, contact search and instruction set. Lines of history.csv and status.jsonl and frames
beyond the checkpoint are removed and computed again. With -o the folder of the run stays unchanged, and FOLDER gets
all results.

A truncated or damaged checkpoint is reported, and the previous one is used; checkpoint.keep is the number of
checkpoints.)";

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
         "pipelines to execute during the run, separated by commas, such as fractures,stress; a script by its path; "
         "`breccia explain insitu`")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->take_all();
}

}  // namespace

void define_run(CLI::App& app, Arguments& a) {
  CLI::App* run = app.add_subcommand("run", "Run a case through all its stages");
  run->add_option("case", a.run.case_file, kCaseHelp)->required();
  run->add_option("-o,--output", a.run.folder, "folder of the results; default runs/<folder of the case>")
      ->check(some_name());
  run->add_option("--set", a.run.overrides, kSetHelp)->allow_extra_args(false)->take_all()->check(override_text());
  run->add_flag("--trust-geometry", a.run.trust_geometry, kTrustHelp);
  run->add_flag("-f,--overwrite", a.run.overwrite, "replace the results of an earlier run in that folder");
  run->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  run->footer(
      "Writes frames for ParaView (frames/*.series), history.csv, status.jsonl, summary.json and .txt, the resolved "
      "case and provenance.json.\nCtrl-C ends the run after the present step with everything written, with exit code "
      "130 (under mpiexec, which kills its processes after a second, use `breccia control FOLDER stop`); `breccia "
      "resume` continues it, also after a power cut, from its last checkpoint (`breccia explain checkpoint`). SIGUSR1 "
      "requests a checkpoint.");

  define_run_insitu(*run, a);
}

void define_resume(CLI::App& app, Arguments& a) {
  CLI::App* resume = app.add_subcommand("resume", "Continue a run from its last checkpoint, on any number of ranks");
  resume->add_option("run", a.resume.run, "folder of the run, or one of its checkpoints")->required();
  resume->add_option("-o,--output", a.resume.folder, "folder of the results; default: the run's own")
      ->check(some_name());
  const auto set_until = [&a](const std::string& text) { a.resume.until = seconds_of(text); };
  resume
      ->add_option_function<std::string>(
          "--until", set_until,
          "simulated time, such as \"2 ms\": the run stops there; the last stage is extended to a time beyond the end; "
          "default: the end")
      ->check(simulated_time(false));
  resume
      ->add_option(
          "--set", a.resume.overrides,
          "override keys of [domains], [detection], [checkpoint], or time.max_steps; others would change the results")
      ->allow_extra_args(false)
      ->take_all()
      ->check(override_text());
  resume->add_flag("--without-insitu", a.resume.without_insitu,
                   "omit the [insitu] of the case, if a script or the adaptor is missing; results are the same");
  resume->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  resume->footer(kResumeFooter);
}

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
              "length of a repetition in simulated time, such as \"20 us\"; default: ten searches, at most a minute "
              "for all")
          ->check(simulated_time(false));
  race->add_option("--steps", s.steps, "length of a repetition in steps")
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
          "algorithms to compare, such as ms,sorted_grid; default: all, brute_force only where the model is small")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(names));
  race->add_option("--buffers", s.buffers,
                   "buffers as multiples of the case's own, which is always compared; default 0.5,1,2,4")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0.01, 100.0));
  race->add_option("--set", a.race.overrides, kSetHelp)->allow_extra_args(false)->take_all()->check(override_text());
  race->add_flag("--trust-geometry", a.race.trust_geometry, kTrustHelp);
  race->add_option("-o,--output", a.race.folder,
                   "write the table as race.csv into this folder; default: nothing is written")
      ->check(some_name());
  race->add_option("--progress", a.progress, kProgressHelp)->check(progress_modes());
  race->footer(kRaceFooter);
}

}  // namespace breccia
