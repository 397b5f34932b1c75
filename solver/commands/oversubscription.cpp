#include "commands/oversubscription.hpp"

#include <unistd.h>

#include <cstdint>
#include <iostream>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace breccia {

void warn_of_oversubscription(const Communicator& world) {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  const std::string host = name;
  std::int64_t here = 0;
  for (const std::vector<char>& other : world.all_gather(std::span<const char>(host)))
    here += std::string(other.begin(), other.end()) == host;
  const auto cores = static_cast<std::int64_t>(std::thread::hardware_concurrency());
  if (!world.is_root() || world.size() == 1 || here <= cores) return;
  std::cerr << "breccia: warning: " << here << " ranks share the " << cores << " cores of " << host
            << "; more ranks than cores make a run slower\n";
}

}  // namespace breccia
