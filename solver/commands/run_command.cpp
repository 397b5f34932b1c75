#include "commands/commands.hpp"

#include <fmt/core.h>
#include <cstdio>

#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "commands/overlap_report.hpp"
#include "commands/oversubscription.hpp"
#include "commands/run_sinks.hpp"
#include "output/insitu.hpp"
#include "output/run_folder.hpp"
#include "simulation/run.hpp"

namespace breccia {
namespace {

/// A live view that leaves the machine.
void warn_of_remote_viewer(const case_::InSitu& insitu) {
  if (!insitu.live || case_::is_loopback(case_::host_and_port(insitu.live->address)->first)) return;
  fmt::print(stderr,
             "breccia: warning: the run is offered to {}, another machine; what is sent there is neither encrypted nor "
             "checked\n",
             insitu.live->address);
}

}  // namespace

int run_command(const RunCommand& asked, const Communicator& world) {
  case_::Case input;
  std::unique_ptr<Model> model;
  std::filesystem::path root;
  world.agree([&] {
    input = case_::read_case(asked.case_file, asked.overrides);
    world.set_patience(input.domains.patience);
    root = asked.folder.empty() ? default_run_folder(input.file) : asked.folder;
    if (input.insitu.asked_for()) InSituPlugin();  // before anything is made: stays loaded
    if (!world.is_root()) return;
    model = std::make_unique<Model>(world.size() > 1 ? build_bare_model(input) : build_model(input));
    refuse_initial_overlaps(input, *model);
    (void)prepare_run_folder(root, input.resolved, collect_provenance(BRECCIA_VERSION, asked.command_line),
                             asked.overwrite ? OldResults::overwrite : OldResults::refuse);
  });
  warn_of_oversubscription(world);
  if (world.is_root()) warn_of_remote_viewer(input.insitu);
  const RunFolder folder{root};
  const auto sinks = run_sinks(input, folder, asked.progress, world);
  const Summary summary = run_case(input, std::move(model), sinks, world, &folder);
  print_results(summary, folder, asked.progress, world);
  return 0;
}

}  // namespace breccia
