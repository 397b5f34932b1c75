#include "commands/commands.hpp"

#include <fmt/core.h>
#include <cstdio>
#include <iostream>

#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "commands/overlap_report.hpp"
#include "commands/oversubscription.hpp"
#include "output/history_sink.hpp"
#include "output/insitu.hpp"
#include "output/run_folder.hpp"
#include "output/summary.hpp"
#include "output/vtkhdf_sink.hpp"
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
  std::vector<std::unique_ptr<Sink>> sinks;
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
  world.agree([&] {
    // Frames are written by all ranks together, everything else by the root.
    const FrameParts parts{input.output.elements, input.output.joints, input.output.contacts};
    sinks.push_back(std::make_unique<VtkhdfSink>(folder.frames(), parts, world));
    if (!world.is_root()) return;
    sinks.push_back(std::make_unique<HistorySink>(folder.history()));
    sinks.push_back(std::make_unique<StatusSink>(folder.status()));
    sinks.push_back(std::make_unique<ProgressSink>(asked.progress, std::cout, terminal_columns(fileno(stdout))));
    sinks.push_back(std::make_unique<SummarySink>(folder.summary(), folder.summary_text()));
  });
  const Summary summary = run_case(input, std::move(model), sinks, world, &folder);
  if (world.is_root() && asked.progress != ProgressMode::json && asked.progress != ProgressMode::none) {
    fmt::print("{}results in {}\n", summary_text(summary), root.string());
  }
  return 0;
}

}  // namespace breccia
