// An adaptor around the one for Catalyst 2: compares the addresses that the solver hands over with those that our
// libcatalyst is given. Environment: WITNESSED, the adaptor; BRECCIA_LIBCATALYST, our libcatalyst; WITNESS_FILE, to
// which a line an execution and channel is added: its name, views of the solver's memory, other views.

#include <dlfcn.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "catalyst/insitu_abi.h"
#include "catalyst2/blueprint_check.hpp"

namespace breccia::test {
namespace {

constexpr const char* kNames[] = BRECCIA_CHANNEL_NAMES;

template <class Function>
Function function_of(const char* library, const char* name) {
  void* const opened = dlopen(std::getenv(library), RTLD_LAZY | RTLD_LOCAL);
  return opened == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(opened, name));
}

const BrecciaInsituApi& witnessed() {
  static const auto* const api = function_of<const BrecciaInsituApi* (*)()>("WITNESSED", "breccia_insitu_api")();
  return *api;
}

void look(const StandinTree& tree, const std::string& name, const BrecciaGrid& grid) {
  const std::string data = "catalyst/channels/" + name + "/data";
  int same = 0, other = 0;
  const auto compare = [&](const std::string& path, const void* expected) {
    for (const StandinLeaf* leaf : leaves_below(tree, data + path)) (leaf->data == expected ? same : other) += 1;
  };
  if (grid.cell != BRECCIA_TABLE) compare("/coordsets/coords/values", grid.points);
  if (grid.corners != nullptr) compare("/topologies/mesh/elements/connectivity", grid.corners);
  for (int i = 0; i < grid.num_arrays; ++i)
    compare(std::string("/fields/") + grid.arrays[i].name + "/values", grid.arrays[i].values);
  std::ofstream(std::getenv("WITNESS_FILE"), std::ios::app) << name << ' ' << same << ' ' << other << '\n';
}

std::int64_t execute(void* adaptor, std::uint32_t pipelines, const BrecciaInstant* instant, BrecciaRequests* requests,
                     char* text, size_t size) {
  const std::int64_t failed = witnessed().execute(adaptor, pipelines, instant, requests, text, size);
  const auto entry = function_of<StandinEntry>("BRECCIA_LIBCATALYST", "standin");
  const StandinTree& tree = entry()->executed.back();
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    const BrecciaGrid* const grid = instant->channels[channel];
    if (grid != nullptr && grid->num_cells > 0) look(tree, kNames[channel], *grid);
  }
  return failed;
}

}  // namespace
}  // namespace breccia::test

extern "C" __attribute__((visibility("default"))) const BrecciaInsituApi* breccia_insitu_api(void) {
  static const BrecciaInsituApi api = [] {
    BrecciaInsituApi copy = breccia::test::witnessed();
    copy.execute = breccia::test::execute;
    return copy;
  }();
  return &api;
}
