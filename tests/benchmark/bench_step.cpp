// Speed of the whole step on one core, against the memory bandwidth measured in the same minute.
//
//   bench_step [cells along the plate's edge, default 48 = 442,368 elements]
//
// Prints one line a case: million element-steps/s, ns an element-step by phase, bytes an element-step that the layout
// moves, the share of the measured triad bandwidth that is, and the state hash: the same for every machine and SIMD
// width.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case/reader.hpp"
#include "contact/search_params.hpp"
#include "domains/state_records.hpp"
#include "model/parameters.hpp"
#include "model/time_step.hpp"
#include "observe/observe.hpp"
#include "simulation/step.hpp"

namespace {

using namespace breccia;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Best of several STREAM triads over 480 MB, GB/s (24 B an entry).
double triad() {
  constexpr std::size_t n = 20'000'000;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
    best = std::min(best, since(start));
  }
  return a[n / 2] == 7.0 ? 24.0 * static_cast<double>(n) / best / 1e9 : 0.0;
}

std::string plate(int cells, const std::string& joints) {
  const std::string n = std::to_string(cells), h = std::to_string(0.06 / cells);
  return "title = \"slit plate\"\n[mesh.raster]\ncells = [" + n + ", " + n + ", " + std::to_string(cells / 6) +
         "]\ncell_size = " + h +
         "\ngroup = \"plate\"\nslit = { lower = [0.02, 0.03, 0.0], upper = [0.04, 0.03, 0.01] }\n"
         "[[material]]\ngroup = \"plate\"\nyoung = \"26.6 GPa\"\npoisson = 0.205\ndensity = \"2340 kg/m3\"\njoints = "
         "\"" +
         joints + "\"\n" +
         (joints == "none" ? ""
                           : "[[joint]]\ngroup = \"plate\"\npenalty_factor = 50\ntensile_strength = \"5 "
                             "MPa\"\nenergy_mode_1 = \"30 J/m2\"\n"
                             "[joints]\nbroken = [\"plate.slit\"]\n") +
         "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"266 GPa\"\n"
         "[[stage]]\nname = \"load\"\nend = \"1 ms\"\n[[stage.pressure]]\nsurface = \"plate." +
         (joints == "none" ? "x0" : "slit") + "\"\nvalue = { linear = \"20 GPa/s\" }\n";
}

case_::Case plate_case(int cells, const std::string& joints) {
  const auto file = std::filesystem::temp_directory_path() / "breccia_bench_case.toml";
  std::ofstream(file) << plate(cells, joints);
  const case_::Case input = case_::read_case(file);
  std::filesystem::remove(file);
  return input;
}

/// What a case is measured with.
struct Race {
  int lead, rounds,
      steps;  ///< steps that do not count, then rounds of so many steps; the best counts, the phases are those of all
  double bytes = 0;  ///< that the layout moves an element-step; 0: nobody has counted
};

void measure(const char* name, const case_::Case& input, const Race& race, double bandwidth) {
  const Model model = build_model(input);
  Domain domain(model, search_params(input, model));
  for (const InitialVelocity& initial : initial_velocities(input, model)) add_velocity(domain, initial);
  begin_stage(domain, stage_loads(input.stages[0], model), 0.8 * TimeStep(model).bound(model.local.reference).step);
  for (int i = 0; i < race.lead; ++i) step(domain);
  const PhaseTimer before = domain.timer;
  const double elements = model.mesh.num_elements();
  double best = 1e300;
  for (int round = 0; round < race.rounds; ++round) {
    const auto start = Clock::now();
    for (int i = 0; i < race.steps; ++i) step(domain);
    best = std::min(best, since(start) / race.steps);
  }
  const double rate = elements / best;
  std::printf("%-28s %8.0f elements  %7.2f M element-steps/s", name, elements, rate / 1e6);
  for (const Phase phase : {Phase::joints, Phase::search, Phase::contact, Phase::sweep, Phase::loads}) {
    const double seconds = domain.timer.seconds(phase) - before.seconds(phase);
    std::printf("  %s %.1f ns", std::string(name_of(phase)).c_str(),
                seconds * 1e9 / (elements * race.rounds * race.steps));
  }
  if (race.bytes > 0) std::printf("  %.0f B, %.0f %% of triad", race.bytes, 100 * race.bytes * rate / 1e9 / bandwidth);
  if (domain.state.joints.active.size() > 0) {
    std::printf("  %zu active joints, %lld broken", domain.state.joints.active.size(),
                static_cast<long long>(domain.state.joints.broken));
  }
  std::printf("  %s  hash %s\n", std::string(name_of(domain.simd)).c_str(), hash_of(domain).text().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::max(6, std::atoi(argv[1]) / 6 * 6) : 48;
  const double bandwidth = triad();
  std::printf("triad %.1f GB/s on one core\n", bandwidth);
  // Own nodes: x read, x_next written (and fetched), v read and written, D_m^-1, V, m, places of linked corners,
  // stiffness, limit.
  constexpr double own = 96 + 192 + 192 + 72 + 8 + 8 + 48 + 32 + 8;
  // Shared nodes: corners, D_m^-1, V, and 0.22 nodes of x, v, f, m read and written.
  constexpr double shared = 16 + 72 + 8 + 0.222 * (24 + 48 + 48 + 96 + 8);
  measure("joints everywhere, dormant", plate_case(cells, "breakable"),
          {.lead = 0, .rounds = 5, .steps = 20, .bytes = own}, bandwidth);
  measure("no joints", plate_case(cells, "none"), {.lead = 0, .rounds = 5, .steps = 40, .bytes = shared}, bandwidth);
  measure("glass plate, shattering", case_::read_case(BRECCIA_MESHES "/glass_impact/case_demo.toml"),
          {.lead = 2500, .rounds = 5, .steps = 50}, bandwidth);
  std::printf("%s\n", triad() > 0.7 * bandwidth ? "the machine was steady"
                                                : "the machine's bandwidth fell meanwhile: measure again");
  return 0;
}
