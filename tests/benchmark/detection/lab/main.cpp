// The contact detection laboratory: chapter 7 of the thesis on the machine at hand, with libraries beside it.
//
//   bench_detection_lab [--largest N] [--repeat R] [--budget SECONDS] [--experiments I,II,...,points] [--algorithms
//   ...]
//                       [--scene TEXT] [--no-peers] [--folder FOLDER]
//   bench_detection_lab --names
//   bench_detection_lab --count ALGORITHM --experiments III|points [--scene TEXT] --largest N   one detection, for
//   callgrind
//
// Ends with 1 where two searches see different pairs.

#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "experiments.hpp"

namespace breccia::lab {

bool wanted(const Options& options, const std::string& algorithm) {
  const auto& names = options.algorithms;
  return names.empty() || std::find(names.begin(), names.end(), algorithm) != names.end();
}

double now() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace breccia::lab

int main(int argc, char** argv) {
  using namespace breccia::lab;
  Options options;
  bool no_peers = false, names = false;
  std::string counted;
  CLI::App app(
      "Contact detection: experiments I to VII of the thesis, points against tetrahedra, and libraries beside them.");
  app.add_option("--largest", options.largest, "largest number of bodies");
  app.add_option("--repeat", options.repeat, "runs of each experiment; the shortest time counts")
      ->check(CLI::PositiveNumber);
  app.add_option("--budget", options.budget, "s of one algorithm in one run; longer runs are not begun");
  app.add_option("--experiments", options.experiments, "of I, II, III, IV, V, VI, VII, bytes, points")
      ->delimiter(',')
      ->transform(CLI::IsMember({"I", "II", "III", "IV", "V", "VI", "VII", "bytes", "points"}, CLI::ignore_case));
  app.add_option("--algorithms", options.algorithms, "only these")->delimiter(',');
  app.add_flag("--no-peers", no_peers, "Breccia's own searches only");
  app.add_option("--folder", options.folder, "where the tables are written");
  app.add_flag("--names", names, "list the algorithms and end");
  app.add_option("--count", counted,
                 "one detection of this algorithm on the first experiment, to be counted by callgrind");
  app.add_option("--scene", options.scene, "points: only scenes whose name holds this");
  CLI11_PARSE(app, argc, argv);
  options.peers = !no_peers;
  const auto chosen = [&](const char* name) {
    return std::find(options.experiments.begin(), options.experiments.end(), name) != options.experiments.end();
  };
  try {
    if (names) print_names(options);
    if (!counted.empty()) count_cycle(options, counted);
    if (names || !counted.empty()) return 0;
    std::filesystem::create_directories(options.folder);
    run_equal_size(options);
    if (chosen("bytes")) run_bytes(options);
    if (chosen("VII")) run_memory_order(options);
    if (chosen("points")) run_points(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_detection_lab: %s\n", error.what());
    return 1;
  }
}
