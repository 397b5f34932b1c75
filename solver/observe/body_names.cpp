#include "observe/body_names.hpp"

#include <cstddef>

namespace breccia {

std::vector<std::string> body_names(const std::vector<Index>& group_of_body, const std::vector<std::string>& groups) {
  std::vector<std::size_t> bodies_of(groups.size(), 0);
  for (const Index group : group_of_body) {
    if (group >= 0) ++bodies_of[static_cast<std::size_t>(group)];
  }
  std::vector<std::string> names;
  for (std::size_t body = 0; body < group_of_body.size(); ++body) {
    const std::string number = "body " + std::to_string(body);
    if (group_of_body[body] < 0) {
      names.push_back(number);
      continue;
    }
    const auto group = static_cast<std::size_t>(group_of_body[body]);
    names.push_back(bodies_of[group] == 1 ? groups[group] : groups[group] + " (" + number + ")");
  }
  return names;
}

std::vector<std::string> body_names(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  std::vector<double> group_of(static_cast<std::size_t>(domain.model.mesh.num_bodies), -1.0);
  for (const Index slot : local.slot_of_element) {
    const auto body = static_cast<std::size_t>(local.slot_body[static_cast<std::size_t>(slot)]);
    group_of[body] = static_cast<double>(local.block_group[static_cast<std::size_t>(slot / kLanes)]);
  }
  const Communicator& communicator = domain.exchange.communicator();
  communicator.max(group_of);
  if (!communicator.is_root()) return {};
  std::vector<Index> groups;
  groups.reserve(group_of.size());
  for (const double group : group_of) groups.push_back(static_cast<Index>(group));
  return body_names(groups, domain.model.mesh.volume_groups);
}

}  // namespace breccia
