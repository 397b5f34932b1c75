#include "commands/commands.hpp"

#include <fmt/core.h>
#include <cstdio>
#include <optional>
#include <set>

#include "base/interruption.hpp"
#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "commands/overlap_report.hpp"
#include "commands/oversubscription.hpp"
#include "commands/run_sinks.hpp"
#include "mesh/geo_scan.hpp"
#include "output/insitu.hpp"
#include "output/run_folder.hpp"
#include "output/run_lock.hpp"
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

/// Where the results come from, with hashes of all files that went in.
Provenance provenance_of(const RunCommand& asked, const case_::Case& input, const Communicator& world) {
  Provenance provenance = collect_provenance(BRECCIA_VERSION, asked.command_line);
  provenance.ranks = world.size();
  std::set<std::filesystem::path> files{asked.case_file};
  if (!input.mesh.file.empty()) files.insert(input.mesh.file);
  if (input.mesh.file.extension() == ".geo") files.merge(scan_geo(input.mesh.file).files);
  for (const std::filesystem::path& file : files) provenance.inputs.push_back(input_file(file));
  return provenance;
}

}  // namespace

int run_command(const RunCommand& asked, const Communicator& world) {
  case_::Case input;
  std::unique_ptr<Model> model;
  std::filesystem::path root;
  RunFolder folder;
  std::optional<RunWatch> watch;
  if (world.is_root()) watch.emplace();  // before memory is taken
  world.agree([&] {
    input = case_::read_case(asked.case_file, asked.overrides);
    input.mesh.trust = asked.trust_geometry;
    world.set_patience(input.domains.patience);
    root = asked.folder.empty() ? default_run_folder(input.file) : asked.folder;
    if (input.insitu.asked_for()) InSituPlugin();  // before anything is made: stays loaded
    if (!world.is_root()) return;
    const bool announce = asked.progress == ProgressMode::log || asked.progress == ProgressMode::bar;
    if (announce) fmt::print(stderr, "breccia: reading the mesh and building the model\n");
    model = std::make_unique<Model>(world.size() > 1 ? build_bare_model(input) : build_model(input));
    give_up_if_interrupted();
    refuse_initial_overlaps(input, *model);
    folder = prepare_run_folder(root, input.resolved, provenance_of(asked, input, world),
                                asked.overwrite ? OldResults::overwrite : OldResults::refuse);
    if (announce) fmt::print(stderr, "breccia: dividing the model and preparing the first step\n");
  });
  warn_of_oversubscription(world);
  if (world.is_root()) warn_of_remote_viewer(input.insitu);
  folder.root = root;
  if (watch) watch->guard(root);
  const auto sinks = run_sinks(input, folder, asked.progress, world);
  const Summary summary = run_case(input, std::move(model), sinks, world, &folder);
  print_results(summary, folder, asked.progress, world);
  return 0;
}

}  // namespace breccia
