#include "commands/commands.hpp"

#include <unistd.h>

#include <fmt/core.h>
#include <cerrno>
#include <iostream>
#include <optional>

#include "base/error.hpp"
#include "case/reader.hpp"
#include "commands/oversubscription.hpp"
#include "commands/race_report.hpp"
#include "commands/refusals.hpp"
#include "system/atomic_file.hpp"

namespace breccia {
namespace {

void refuse_start(const RaceCommand& asked) {
  const std::optional<case_::Start> start = case_::read_start(asked.case_file, asked.overrides);
  if (!start) return;
  throw InputError(Problem{asked.case_file.string(), start->origin.line, "start",
                           "a race begins at the first step of its case, not with the state of another run",
                           "the case of that run, with --from and a time", start->from.string()});
}

}  // namespace

int race_command(const RaceCommand& asked, const Communicator& world) {
  case_::Case input;
  std::unique_ptr<Model> model;
  const std::filesystem::path file = asked.folder / "race.csv";
  const bool writes = world.is_root() && !asked.folder.empty();
  world.agree([&] {
    refuse_start(asked);
    input = case_::read_case(asked.case_file, asked.overrides);
    input.mesh.trust = asked.trust_geometry;
    world.set_patience(input.domains.patience);
    if (world.is_root()) {
      model = std::make_unique<Model>(world.size() > 1 ? build_bare_model(input) : build_model(input));
      refuse_initial_overlaps(input, *model);
      refuse_contradictions(input, *model);
    }
    if (!writes) return;
    std::error_code error;
    std::filesystem::create_directories(asked.folder, error);
    if (error) throw output_error(asked.folder, "the folder cannot be made", error.value());
    if (access(asked.folder.c_str(), W_OK) != 0)
      throw output_error(asked.folder, "nothing can be written into the folder", errno);
  });
  demand_memory_of_ranks(input, model.get(), world);
  warn_of_oversubscription(world);
  RaceProgress progress(world.is_root() ? asked.progress : ProgressMode::none, std::cout,
                        terminal_columns(fileno(stdout)));
  const RaceResult result = race_case(input, asked.settings, std::move(model), progress, world);
  if (world.is_root()) fmt::print("{}", asked.progress == ProgressMode::json ? race_json(result) : race_table(result));
  world.agree([&] {
    if (writes) write_file_atomically(file, race_csv(result));
  });
  return 0;
}

}  // namespace breccia
