#include "system/control_group.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace breccia {
namespace {

/// A limit in a file, 0: none ("max"), or no such file.
std::uint64_t limit_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t bytes = 0;
  return in >> bytes ? bytes : 0;
}

/// The least limit of a group and of those above it. In a container the names may be those outside it, where only the
/// top is seen.
std::uint64_t least_limit(const std::filesystem::path& top, std::filesystem::path group, const char* file) {
  std::uint64_t least = 0;
  const auto consider = [&](const std::filesystem::path& folder) {
    const std::uint64_t limit = limit_in(folder / file);
    if (limit > 0) least = least == 0 ? limit : std::min(least, limit);
  };
  for (group = group.relative_path(); !group.empty(); group = group.parent_path()) consider(top / group);
  consider(top);
  return least;
}

bool contains(std::string_view list, std::string_view name) {
  return ("," + std::string(list) + ",").find("," + std::string(name) + ",") != std::string::npos;
}

}  // namespace

std::uint64_t memory_of_control_group(const std::filesystem::path& root) {
  const std::filesystem::path groups = root / "sys/fs/cgroup";
  std::ifstream membership(root / "proc/self/cgroup");
  std::string line;
  while (std::getline(membership, line)) {  // hierarchy:controllers:group
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::filesystem::path group = line.substr(second + 1);
    std::uint64_t limit = 0;
    if (controllers.empty()) limit = least_limit(groups, group, "memory.max");
    if (contains(controllers, "memory")) limit = least_limit(groups / "memory", group, "memory.limit_in_bytes");
    if (limit > 0) return limit;
  }
  return 0;
}

}  // namespace breccia
