#include <cstdio>
#include <functional>
#include <stdexcept>

#include "experiments.hpp"
#include "peers.hpp"
#include "point_scenes.hpp"

/// Its name and its calls are what callgrind looks for: neither is changed by the compiler.
extern "C" [[gnu::noinline]] void breccia_counted_cycle(const std::function<void()>& cycle) { cycle(); }

namespace breccia::lab {
namespace {

struct All {
  Contenders equal_size = own_searches();
  PointContenders points = own_point_searches();

  explicit All(bool peers) {
    if (peers) add_peers(equal_size, points);
  }
};

template <class Some>
auto& find(Some& contenders, const std::string& name) {
  for (auto& contender : contenders) {
    if (contender->name() == name) return *contender;
  }
  throw std::invalid_argument("no algorithm '" + name + "' here; --names lists those that are");
}

Scene scene_named(const std::string& text, std::size_t largest) {
  for (const PointScene& make : point_scenes(largest)) {
    Scene scene = make();
    if (scene.name.find(text) != std::string::npos) return scene;
  }
  throw std::invalid_argument("no scene whose name holds '" + text + "'");
}

void count_points(const Options& options, PointContender& contender) {
  const Scene scene = scene_named(options.scene, options.largest);
  contender.detect(scene.points, scene.contactors, scene.buffer);
  Tally tally;
  breccia_counted_cycle([&] { tally = contender.detect(scene.points, scene.contactors, scene.buffer); });
  std::printf("%s: %zu tetrahedra, %zu couples\n", scene.name.c_str(), scene.contactors.size(),
              std::size_t{tally.count});
}

void count_equal_size(const Options& options, Contender& contender) {
  Placement placement(options.experiments.front(), options.largest, 1);
  contender.detect(placement.cells());
  placement.move();
  Tally tally;
  breccia_counted_cycle([&] { tally = contender.detect(placement.cells()); });
  std::printf("%s: %zu bodies, %zu pairs\n", options.experiments.front().c_str(), placement.cells().size(),
              std::size_t{tally.count});
}

}  // namespace

void count_cycle(const Options& options, const std::string& algorithm) {
  All all(options.peers);
  if (options.experiments.front() == "points") {
    count_points(options, find(all.points, algorithm));
  } else {
    count_equal_size(options, find(all.equal_size, algorithm));
  }
}

void print_names(const Options& options) {
  const All all(options.peers);
  for (const auto& contender : all.equal_size) std::printf("equal_size %s\n", contender->name().c_str());
  for (const auto& contender : all.points) std::printf("points %s\n", contender->name().c_str());
}

}  // namespace breccia::lab
