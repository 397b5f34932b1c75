#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "experiments.hpp"
#include "peers.hpp"
#include "point_scenes.hpp"

namespace breccia::lab {
namespace {

/// Least and most time of the runs, s; the runs end early where they would exceed the budget.
std::pair<double, double> measure(PointContender& contender, const Scene& scene, const Options& options, Tally& tally) {
  double least = 1e300, most = 0, sum = 0;
  for (int run = 0; run < options.repeat && sum + most < options.budget; ++run) {
    const double start = now();
    tally = contender.detect(scene.points, scene.contactors, scene.buffer);
    const double time = now() - start;
    least = std::min(least, time);
    most = std::max(most, time);
    sum += time;
  }
  return {least, most};
}

}  // namespace

void run_points(const Options& options) {
  std::ofstream table(options.folder / "points.csv");
  table << "scene,algorithm,points,contactors,couples,least_s,most_s\n";
  for (const PointScene& make : point_scenes(options.largest)) {
    const Scene scene = make();
    if (scene.name.find(options.scene) == std::string::npos) continue;
    std::printf("%s: %zu points, %zu contactors, buffer %g\n", scene.name.c_str(), scene.points.size(),
                scene.contactors.size(), scene.buffer);
    PointContenders contenders = own_point_searches();
    Contenders unused;
    if (options.peers) add_peers(unused, contenders);
    Tally reference;
    bool first = true;
    for (auto& contender : contenders) {
      if (!wanted(options, contender->name())) continue;
      Tally tally;
      const auto [least, most] = measure(*contender, scene, options, tally);
      if (first) reference = tally;
      first = false;
      if (tally != reference) throw std::runtime_error(scene.name + ": " + contender->name() + " sees other couples");
      std::printf("  %-14s %10.2f ms (to %.2f) %8.1f ns a point  %zu couples\n", contender->name().c_str(), least * 1e3,
                  most * 1e3, least * 1e9 / static_cast<double>(scene.points.size()), std::size_t{tally.count});
      table << '"' << scene.name << "\"," << contender->name() << ',' << scene.points.size() << ','
            << scene.contactors.size() << ',' << tally.count << ',' << least << ',' << most << std::endl;
      std::fflush(stdout);
    }
  }
}

}  // namespace breccia::lab
