#include "observe/body_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace breccia {
namespace {

/// A body and a group that it has elements of.
using Part = std::array<Index, 2>;

void sort_unique(std::vector<Part>& parts) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

/// "core + shell", "core + shell + 12 other groups".
std::string joined_names(const std::vector<Index>& own, const std::vector<std::string>& groups) {
  constexpr std::size_t kMost = 3;  // a name fits into a legend
  const std::size_t named = own.size() > kMost ? kMost - 1 : own.size();
  std::string name;
  for (std::size_t i = 0; i < named; ++i) name += (i > 0 ? " + " : "") + groups[static_cast<std::size_t>(own[i])];
  if (named < own.size()) name += " + " + std::to_string(own.size() - named) + " other groups";
  return name;
}

}  // namespace

std::vector<std::string> body_names(const std::vector<std::vector<Index>>& groups_of_body,
                                    const std::vector<std::string>& groups) {
  std::vector<std::size_t> bodies_of(groups.size(), 0);
  for (const std::vector<Index>& own : groups_of_body) {
    for (const Index group : own) ++bodies_of[static_cast<std::size_t>(group)];
  }
  std::vector<std::string> names;
  for (std::size_t body = 0; body < groups_of_body.size(); ++body) {
    const std::vector<Index>& own = groups_of_body[body];
    const std::string number = "body " + std::to_string(body);
    const bool alone = std::all_of(own.begin(), own.end(),
                                   [&](Index group) { return bodies_of[static_cast<std::size_t>(group)] == 1; });
    if (own.empty())
      names.push_back(number);
    else
      names.push_back(joined_names(own, groups) + (alone ? "" : " (" + number + ")"));
  }
  return names;
}

std::vector<std::string> body_names(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  std::vector<Part> mine;
  for (const Index slot : local.slot_of_element) {
    const Part part{local.slot_body[static_cast<std::size_t>(slot)],
                    local.block_group[static_cast<std::size_t>(slot / kLanes)]};
    if (mine.empty() || mine.back() != part) mine.push_back(part);
  }
  sort_unique(mine);
  const Communicator& communicator = domain.exchange.communicator();
  std::vector<Part> all;
  for (const auto& of_rank : communicator.all_gather(std::span<const Part>(mine)))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  if (!communicator.is_root()) return {};
  sort_unique(all);
  std::vector<std::vector<Index>> groups_of_body(static_cast<std::size_t>(domain.model.mesh.num_bodies));
  for (const auto& [body, group] : all) groups_of_body[static_cast<std::size_t>(body)].push_back(group);
  return body_names(groups_of_body, domain.model.mesh.volume_groups);
}

}  // namespace breccia
