#include "commands.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fmt/core.h>
#include <iostream>
#include <thread>
#include <unistd.h>

#include "case/explain.hpp"
#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "output/atomic_file.hpp"
#include "output/history_sink.hpp"
#include "output/insitu.hpp"
#include "output/run_folder.hpp"
#include "output/summary.hpp"
#include "output/vtkhdf_sink.hpp"
#include "simulation/balance.hpp"
#include "simulation/check.hpp"
#include "simulation/convert.hpp"
#include "simulation/fragment_labels.hpp"
#include "simulation/frames.hpp"
#include "simulation/model.hpp"
#include "simulation/race_report.hpp"
#include "simulation/run.hpp"

namespace breccia {

namespace {

/// Ranks that share a core wait for each other: it works, slowly.
void warn_of_crowding(const Communicator& world) {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  const std::string host = name;
  std::int64_t here = 0;
  for (const std::vector<char>& other : world.all_gather(std::span<const char>(host))) here += std::string(other.begin(), other.end()) == host;
  const auto cores = static_cast<std::int64_t>(std::thread::hardware_concurrency());
  if (!world.is_root() || world.size() == 1 || here <= cores) return;
  fmt::print(stderr, "breccia: warning: {} ranks share the {} cores of {}; more ranks than cores make a run slower\n", here, cores, host);
}

/// A live view that leaves the machine.
void warn_of_strangers(const case_::InSitu& insitu) {
  if (!insitu.live || case_::is_loopback(case_::host_and_port(insitu.live->address)->first)) return;
  fmt::print(stderr, "breccia: warning: the run is offered to {}, another machine; what is sent there is neither encrypted nor checked\n", insitu.live->address);
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
    model = std::make_unique<Model>(build_model(input));
    (void)prepare_run_folder(root, input.resolved, collect_provenance(BRECCIA_VERSION, asked.command_line),
                             asked.overwrite ? OldResults::overwrite : OldResults::refuse);
  });
  warn_of_crowding(world);
  if (world.is_root()) warn_of_strangers(input.insitu);
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

int race_command(const RaceCommand& asked, const Communicator& world) {
  case_::Case input;
  std::unique_ptr<Model> model;
  const std::filesystem::path file = asked.folder / "race.csv";
  const bool writes = world.is_root() && !asked.folder.empty();
  world.agree([&] {
    input = case_::read_case(asked.case_file, asked.overrides);
    world.set_patience(input.domains.patience);
    if (world.is_root()) model = std::make_unique<Model>(build_model(input));
    if (!writes) return;
    std::error_code error;
    std::filesystem::create_directories(asked.folder, error);
    if (error) throw output_error(asked.folder, "the folder cannot be made", error.value());
    if (access(asked.folder.c_str(), W_OK) != 0) throw output_error(asked.folder, "nothing can be written into the folder", errno);
  });
  warn_of_crowding(world);
  RaceProgress progress(world.is_root() ? asked.progress : ProgressMode::none, std::cout, terminal_columns(fileno(stdout)));
  const RaceResult result = race_case(input, asked.settings, std::move(model), progress, world);
  if (world.is_root()) fmt::print("{}", asked.progress == ProgressMode::json ? race_json(result) : race_table(result));
  world.agree([&] {
    if (writes) write_file_atomically(file, race_csv(result));
  });
  return 0;
}

int check_command(const CheckCommand& asked, int launched) {
  const case_::Case input = case_::read_case(asked.case_file, asked.overrides);
  if (input.insitu.asked_for()) preflight(input, std::filesystem::temp_directory_path(), InSituPlugin(), {});
  if (asked.ranks > 0) {
    fmt::print("{}", domain_table(input, build_bare_model(input), asked.ranks));
    return 0;
  }
  const Model model = build_model(input);
  fmt::print("{}", check_report(input, model));
  const std::array<int, 3>& n = input.domains.n;
  const int ranks = launched > 1 ? launched : n[0] * n[1] * n[2];  // the product is bounded by the case's validation
  if (ranks > 1) fmt::print("{}", domain_line(input, model, ranks));
  return 0;
}

int mesh_command(const MeshCommand& asked) {
  const case_::Case input = case_::read_case(asked.case_file, asked.overrides);
  if (asked.folder.empty()) {
    fmt::print("{}", mesh_report(build_mesh(input)));
    return 0;
  }
  const Model model = build_model(input);
  fmt::print("{}", mesh_report({model.mesh, model.mesh_report}));
  std::filesystem::create_directories(asked.folder);
  const Stepper rest(model, search_params(input, model));
  const FrameParts elements{true, false, false};
  VtkhdfSink(asked.folder, elements).frame(make_frame(rest, 0, elements, {find_fragments(rest), Balance().weights(rest)}));
  fmt::print("elements for ParaView in {}\n", asked.folder.string());
  return 0;
}

int explain_command(const std::string& key) {
  fmt::print("{}\n", key.empty() ? case_::explain() : case_::explain(key));
  return 0;
}

}  // namespace breccia
