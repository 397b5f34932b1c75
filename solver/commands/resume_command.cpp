#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "base/quantity_text.hpp"
#include "base/version.hpp"
#include "case/reader.hpp"
#include "case/schema.hpp"
#include "commands/commands.hpp"
#include "commands/oversubscription.hpp"
#include "commands/run_sinks.hpp"
#include "commands/start_state.hpp"
#include "commands/terminal.hpp"
#include "domains/possible_records.hpp"
#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/resumed_folder.hpp"
#include "output/folder/run_lock.hpp"
#include "output/insitu/insitu.hpp"
#include "simulation/run.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Keys that may differ in a resumed run: those without effect on results.
constexpr std::array<std::string_view, 4> kFreeKeys{"domains.", "detection.", "checkpoint.", "time.max_steps"};

InputError refused(const std::string& where, const std::string& what, const std::string& allowed,
                   const std::string& given = {}) {
  return InputError(Problem{where, 0, "resume", what, allowed, given});
}

/// Refusals for the sake of the pipelines, which change no result, name the way around them.
std::vector<Problem> with_way_around(std::vector<Problem> problems) {
  for (Problem& problem : problems) {
    if (problem.key.starts_with("insitu"))
      problem.allowed +=
          (problem.allowed.empty() ? "" : "; or ") + std::string("--without-insitu, to continue without it");
  }
  return problems;
}

void check_overrides(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    const auto is_free = [&](std::string_view key) { return text.starts_with(key); };
    if (std::none_of(kFreeKeys.begin(), kFreeKeys.end(), is_free))
      throw refused("--set", "this would change the results of a continued run",
                    "keys of [domains], [detection] and [checkpoint], and time.max_steps", text);
  }
}

[[nodiscard]] std::vector<fs::path> candidates(const fs::path& run) {
  std::error_code error;
  if (!fs::exists(run, error)) throw refused(run.string(), "there is no such run", "the folder of a run");
  if (fs::is_regular_file(run, error)) return {run};
  if (!fs::is_directory(run, error))
    throw refused(run.string(), "this is neither a folder nor a regular file", "the folder of a run");
  demand_plain_folder(RunFolder{run});
  std::vector<fs::path> files;
  for (const CheckpointEntry& entry : checkpoints_in(RunFolder{run}.checkpoints())) files.push_back(entry.file);
  if (files.empty() && !checkpoints_in(run).empty())
    throw refused(run.string(), "this is the folder of a run's checkpoints, not of the run",
                  "the folder of the run, or " + checkpoints_in(run).front().file.string());
  if (const std::string holder = files.empty() ? holder_of(run) : ""; !holder.empty())
    throw refused(run.string(), "another run writes here: " + holder + ", and there is no checkpoint yet",
                  "this folder when there is one");
  if (files.empty())
    throw refused(run.string(), "there are no checkpoints of a run here",
                  "the folder of a run with checkpoints/step_*.h5, or one of these files");
  return files;
}

/// The latest that is sound. Collective.
std::pair<Checkpoint, fs::path> latest_sound(const std::vector<fs::path>& files, const Communicator& world) {
  std::vector<Problem> problems;
  for (const fs::path& file : files) {
    try {
      Checkpoint checkpoint = read_checkpoint(file, world);
      world.agree([&] { demand_possible(file, checkpoint.whole_model, checkpoint.mine); });
      for (const Problem& problem : problems) {
        if (world.is_root()) print_warning(problem.text());
      }
      return {std::move(checkpoint), file};
    } catch (const InputError& error) {  // the same on all ranks
      for (const Problem& problem : error.problems()) problems.push_back(problem);
    }
  }
  throw InputError(std::move(problems));
}

/// What the case would refuse as the end of a stage is the fault of the option.
void check_later_end(double until) {
  const case_::Range& allowed = case_::key_of("stage[].end").range;
  if (!allowed.contains(until))
    throw refused("--until", "is out of range", "a time in s " + allowed.text(), quantity_text(until, "s"));
}

/// The case of the checkpoint, with a later end if requested.
case_::Case case_of(const Checkpoint& from, const fs::path& file, std::vector<std::string> overrides, double until,
                    ResumeOptions& options) {
  case_::Case input = case_::read_case_text(from.case_text, file, overrides, case_::MeshFile::may_be_gone);
  options.until = until;
  const double saved = from.position.saved;  // the last stage ends earlier by this (RunStages)
  if (until + saved <= input.stages.back().end || !std::isfinite(until)) return input;
  check_later_end(until + saved);
  overrides.push_back(fmt::format("stage[{}].end={:.17g}", input.stages.size() - 1, until + saved));
  options.extended = true;
  return case_::read_case_text(from.case_text, file, overrides, case_::MeshFile::may_be_gone);
}

/// Throws InputError where the checkpoint is in no stage of its case, or holds nodes by what the stage does not have.
void check_stage(const case_::Case& input, const Checkpoint& from, const fs::path& file, const fs::path& run) {
  if (from.position.stage < 0 || from.position.stage >= std::ssize(input.stages))
    throw refused(run.string(), "this checkpoint is damaged: its case has no such stage",
                  fmt::format("0 to {}", input.stages.size() - 1), std::to_string(from.position.stage));
  demand_constraints(file, from.mine, input.stages[static_cast<std::size_t>(from.position.stage)]);
}

/// Throws InputError where there is nothing to do.
void check_there_is_more(const case_::Case& input, const Checkpoint& from, const fs::path& run, double until) {
  const Clock& clock = from.model.clock;
  if (until <= clock.time + 0.5 * clock.dt)
    throw refused(run.string(), "the run has come as far already",
                  "--until later than " + quantity_text(clock.time, "s"), quantity_text(until, "s"));
  if (input.time.max_steps > 0 && clock.steps - from.position.start_step >= input.time.max_steps)
    throw refused(run.string(), fmt::format("the run has done its time.max_steps, {}", input.time.max_steps),
                  "--set time.max_steps=0, or a larger number");
}

}  // namespace

namespace {

int go_on(const ResumeCommand& asked, const Communicator& world) {
  std::vector<fs::path> files;
  std::optional<RunWatch> watch;
  if (world.is_root()) watch.emplace();  // before memory is taken
  world.agree([&] {
    check_overrides(asked.overrides);
    if (world.is_root()) files = candidates(asked.run);
  });
  of_root(files, world);
  std::pair<Checkpoint, fs::path> found = latest_sound(files, world);
  Checkpoint& from = found.first;
  const fs::path& file = found.second;
  std::error_code error;
  const fs::path run = fs::is_directory(asked.run, error) ? asked.run : fs::absolute(file).parent_path().parent_path();
  case_::Case input;
  ResumeOptions options;
  bool complete = false;
  RunFolder folder{asked.folder.empty() ? run : asked.folder};
  world.agree([&] {
    std::vector<std::string> overrides = asked.overrides;
    if (asked.without_insitu) overrides.emplace_back("insitu={}");
    input = case_of(from, RunFolder{run}.case_file(), std::move(overrides), asked.until, options);
    world.set_patience(input.domains.patience);
    if (world.is_root()) {
      demand_plain_folder(RunFolder{run});
      demand_own_run(RunFolder{run}, file, from);
    }
    complete = is_complete(RunFolder{run}, from.model.clock.steps) && !options.extended;
    if (complete) return;
    check_stage(input, from, file, run);
    check_there_is_more(input, from, run, asked.until);
    if (input.insitu.asked_for()) InSituPlugin(input.insitu.backend);
  });
  if (complete) {
    if (world.is_root())
      print_lines(fmt::format("{} is complete at {}; --until TIME continues to a later end\n", run.string(),
                              quantity_text(from.model.clock.time, "s")));
    return 0;
  }
  world.agree([&] {
    if (!world.is_root()) return;
    Provenance provenance = collect_provenance(program_version(), asked.command_line);
    provenance.ranks = world.size();
    provenance.inputs = inputs_in(from.provenance);
    provenance.parents = with_parent(file, from);
    folder = prepare_resumed_folder({run}, folder.root, from, input.resolved, provenance);
  });
  warn_of_oversubscription(world);
  if (watch) watch->guard(folder.root);
  const auto sinks = run_sinks(input, folder, asked.progress, world);
  const Summary summary = resume_case(input, std::move(from), options, sinks, world, folder);
  print_results(summary, folder, asked.progress, world);
  return 0;
}

}  // namespace

int resume_command(const ResumeCommand& asked, const Communicator& world) {
  try {
    return go_on(asked, world);
  } catch (const InputError& error) {  // the same on all ranks
    throw InputError(with_way_around(error.problems()));
  }
}

}  // namespace breccia
