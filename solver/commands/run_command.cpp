#include "commands/commands.hpp"

#include <iostream>
#include <optional>
#include <set>

#include "advice/advice.hpp"
#include "base/geometry_file.hpp"
#include "base/printable.hpp"
#include "base/version.hpp"
#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "commands/oversubscription.hpp"
#include "commands/refusals.hpp"
#include "commands/run_sinks.hpp"
#include "commands/start_state.hpp"
#include "commands/terminal.hpp"
#include "mesh/geo_scan.hpp"
#include "model/surfaces_to_break.hpp"
#include "output/folder/run_folder.hpp"
#include "output/folder/run_lock.hpp"
#include "output/insitu/insitu.hpp"
#include "simulation/run.hpp"
#include "system/interruption.hpp"

namespace breccia {
namespace {

/// A live view that leaves the machine.
void warn_of_remote_viewer(const case_::InSitu& insitu) {
  if (!insitu.live || case_::is_loopback(case_::host_and_port(insitu.live->address)->first)) return;
  print_warning("the run is offered to " + insitu.live->address +
                ", another machine; data are sent without encryption or authentication");
}

/// Where the results come from, with hashes of all files that went in.
Provenance provenance_of(const RunCommand& asked, const case_::Case& input, const std::optional<StartState>& start,
                         const Communicator& world) {
  Provenance provenance = collect_provenance(program_version(), asked.command_line);
  provenance.ranks = world.size();
  if (start) {
    provenance.inputs = inputs_of_started(asked.case_file, input, start->checkpoint);
    provenance.parents = with_parent(start->file, start->checkpoint);
    return provenance;
  }
  provenance.inputs.push_back(input_file(asked.case_file));  // first: readers know it by that
  std::set<std::filesystem::path> files;
  if (!input.mesh.file.empty()) files.insert(input.mesh.file);
  if (geometry_file(input.mesh.file) == GeometryFile::script) files.merge(scan_geo(input.mesh.file).files);
  for (const case_::DataFiles::One& one : input.data.files) files.insert(one.file);
  for (const std::filesystem::path& file : files) provenance.inputs.push_back(input_file(file));
  return provenance;
}

/// On the root; nothing elsewhere. Collective.
std::unique_ptr<Model> model_of(const case_::Case& input, bool announce, const Communicator& world) {
  std::unique_ptr<Model> model;
  world.agree([&] {
    if (!world.is_root()) return;
    if (announce) std::cerr << "breccia: reading the mesh and building the model\n";
    model = std::make_unique<Model>(world.size() > 1 ? build_bare_model(input) : build_model(input));
    give_up_if_interrupted();
  });
  demand_memory_of_ranks(input, model.get(), world);
  return model;
}

Summary carry_out(const case_::Case& input, std::unique_ptr<Model> model, std::optional<StartState>& start,
                  const std::vector<std::unique_ptr<Sink>>& sinks, const RunFolder& folder, const Communicator& world) {
  if (!start) return run_case(input, std::move(model), sinks, world, &folder);
  const StartOptions options = start_options(input, *start);
  return start_case(input, std::move(start->checkpoint), options, sinks, world, folder);
}

}  // namespace

int run_command(const RunCommand& asked, const Communicator& world) {
  case_::Case input;
  std::unique_ptr<Model> model;
  std::filesystem::path root;
  RunFolder folder;
  std::optional<RunWatch> watch;
  if (world.is_root()) watch.emplace();  // before memory is taken
  std::optional<StartState> start = read_start_state(asked.case_file, asked.overrides, world);
  world.agree([&] {
    input = read_case_of(asked.case_file, asked.overrides, start);
    input.mesh.trust = asked.trust_geometry;
    world.set_patience(input.domains.patience);
    root = asked.folder.empty() ? default_run_folder(input.file) : asked.folder;
    if (input.insitu.asked_for()) InSituPlugin(input.insitu.backend);  // before anything is made: stays loaded
  });
  const bool announce = asked.progress == ProgressMode::log || asked.progress == ProgressMode::bar;
  if (!start) model = model_of(input, announce, world);
  std::vector<ConstraintConflict> conflicts;
  if (start) conflicts = conflicts_of(input, *start, world);
  world.agree([&] {
    if (!world.is_root()) return;
    if (start) {
      refuse_contradictions(input, conflicts);
      print_warnings(overruled_constraints(conflicts));
      refuse_folder_of_state(root, *start);
      if (announce) std::cerr << "breccia: starting from " << printable(words_of(*start)) << '\n';
    } else {
      refuse_initial_overlaps(input, *model);
      give_up_if_interrupted();
      refuse_contradictions(input, *model);
      refuse_what_cannot_break(input, joints_on(*model, surfaces_to_break(input)));
      print_warnings(model->mesh_report.notes);
      print_warnings(start_warnings(input, *model));
      give_up_if_interrupted();
    }
    folder = prepare_run_folder(root, input.resolved, provenance_of(asked, input, start, world),
                                asked.overwrite ? OldResults::overwrite : OldResults::refuse);
    if (announce) std::cerr << "breccia: dividing the model and preparing the first step\n";
  });
  warn_of_oversubscription(world);
  if (world.is_root()) warn_of_remote_viewer(input.insitu);
  folder.root = root;
  if (watch) watch->guard(root);
  const auto sinks = run_sinks(input, folder, asked.progress, world);
  const Summary summary = carry_out(input, std::move(model), start, sinks, folder, world);
  print_results(summary, folder, asked.progress, world);
  return 0;
}

}  // namespace breccia
