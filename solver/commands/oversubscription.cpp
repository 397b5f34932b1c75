#include "commands/oversubscription.hpp"

#include <unistd.h>

#include <iostream>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "model/memory_demand.hpp"

namespace breccia {

namespace {

std::string name_of_machine() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

/// Ranks that share this one's machine, itself included. Collective.
int ranks_on_this_machine(const Communicator& world) {
  const std::string host = name_of_machine();
  int here = 0;
  for (const std::vector<char>& other : world.all_gather(std::span<const char>(host)))
    here += std::string(other.begin(), other.end()) == host ? 1 : 0;
  return here;
}

}  // namespace

void demand_memory_of_ranks(const case_::Case& input, const Model* model, const Communicator& world) {
  if (world.size() == 1) return;
  const double elements = world.max(model == nullptr ? 0.0 : static_cast<double>(model->mesh.num_elements()));
  const double bytes = world.max(model == nullptr ? 0.0 : model_bytes(*model));
  const double share = static_cast<double>(ranks_on_this_machine(world)) / world.size();
  world.agree([&] { demand_memory(input, elements, share * bytes); });
}

void warn_of_oversubscription(const Communicator& world) {
  const int here = ranks_on_this_machine(world);
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (!world.is_root() || world.size() == 1 || here <= cores) return;
  std::cerr << "breccia: warning: " << here << " ranks share the " << cores << " cores of " << name_of_machine()
            << "; more ranks than cores make a run slower\n";
}

}  // namespace breccia
