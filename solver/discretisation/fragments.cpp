#include "discretisation/fragments.hpp"

#include <numeric>
#include <utility>

namespace breccia {

FragmentFinder::FragmentFinder(const LocalMesh& mesh) : mesh_(mesh), parent_(static_cast<std::size_t>(mesh.num_slots)) {
  std::iota(parent_.begin(), parent_.end(), 0);
  std::vector<Index> slot_of_node(static_cast<std::size_t>(mesh.num_nodes - mesh.num_own_nodes()), -1);
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[static_cast<std::size_t>(s)] < 0) continue;
    for (int c = 0; c < 4; ++c) {
      Index& seen = slot_of_node[static_cast<std::size_t>(mesh.corner_node(s, c) - mesh.num_own_nodes())];
      if (seen < 0) {
        seen = s;
      } else {
        join(s, seen);
      }
    }
  }
}

Index FragmentFinder::root(Index slot) {
  auto at = static_cast<std::size_t>(slot);
  while (parent_[at] != static_cast<Index>(at)) {
    parent_[at] = parent_[static_cast<std::size_t>(parent_[at])];  // halves the path for the next visit
    at = static_cast<std::size_t>(parent_[at]);
  }
  return static_cast<Index>(at);
}

void FragmentFinder::join(Index slot, Index other) {
  Index a = root(slot), b = root(other);
  if (a == b) return;
  const auto id = [&](Index s) { return mesh_.element_of_slot[static_cast<std::size_t>(s)]; };
  if (id(b) < id(a)) std::swap(a, b);
  parent_[static_cast<std::size_t>(b)] = a;
}

void FragmentFinder::join_linked(const JointLinks& links) {
  for (Index s = 0; s < mesh_.num_own_slots; ++s) {
    for (int face = 0; face < 4; ++face) {
      const std::int32_t link = links.link[JointLinks::at(s, face)];
      const Index other = JointLinks::slot_of(link);
      if (JointLinks::code_of(link) >= 12 || other < s) continue;
      if (mesh_.is_original(s) || mesh_.is_original(other)) join(s, other);  // of others this rank need not know
    }
  }
}

Fragments FragmentFinder::find() {
  Fragments fragments;
  fragments.of_slot.assign(parent_.size(), -1);
  fragments.alone.assign(parent_.size(), 1);
  for (Index s = 0; s < mesh_.num_slots; ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (mesh_.element_of_slot[i] < 0) continue;
    const Index top = root(s);
    fragments.of_slot[i] = mesh_.element_of_slot[static_cast<std::size_t>(top)];
    if (top == s) {
      ++fragments.count;
    } else {
      fragments.alone[i] = fragments.alone[static_cast<std::size_t>(top)] = 0;
    }
  }
  return fragments;
}

}  // namespace breccia
