#include "mesh/bodies.hpp"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {}  // namespace

std::vector<std::uint8_t> faces_of_surfaces(const Mesh& mesh, const Topology& topology,
                                            std::span<const std::string> surfaces) {
  std::vector<std::uint8_t> faces(mesh.elements.size(), 0);
  for (std::size_t s = 0; s < mesh.surface_groups.size(); ++s) {
    if (std::find(surfaces.begin(), surfaces.end(), mesh.surface_groups[s]) == surfaces.end()) continue;
    for (const Topology::Face& f : topology.surface_groups[s]) {
      faces[at(f.element)] |= static_cast<std::uint8_t>(1U << f.face);
      const FaceLink& link = topology.links[at(f.element)][at(f.face)];
      if (link.inner()) faces[at(link.neighbour)] |= static_cast<std::uint8_t>(1U << link.face());
    }
  }
  return faces;
}

Bodies find_bodies(const Mesh& mesh, const Topology& topology, std::span<const std::uint8_t> cut) {
  DisjointSets sets(mesh.elements.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      const FaceLink& link = topology.links[at(e)][at(f)];
      if (link.inner() && (cut.empty() || (cut[at(e)] >> f & 1) == 0)) sets.join(e, link.neighbour);
    }
  }
  std::vector<Index> lowest_volume(mesh.elements.size(), -1);  // by root, the lowest element of its body
  std::vector<std::pair<Index, Index>> order;                  // of bodies: lowest volume, root
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    Index& lowest = lowest_volume[at(sets.root(e))];
    lowest = lowest < 0 ? mesh.volume_of(e) : std::min(lowest, mesh.volume_of(e));
  }
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    if (sets.root(e) == e) order.emplace_back(lowest_volume[at(e)], e);
  }
  std::sort(order.begin(), order.end());
  Bodies bodies{std::vector<Index>(mesh.elements.size()), static_cast<Index>(order.size())};
  for (Index b = 0; b < bodies.count; ++b) bodies.of_element[at(order[at(b)].second)] = b;
  for (Index e = 0; e < mesh.num_elements(); ++e) bodies.of_element[at(e)] = bodies.of_element[at(sets.root(e))];
  return bodies;
}

void number_bodies(const Topology& topology, std::span<const std::uint8_t> cut, Mesh& mesh) {
  Bodies bodies = find_bodies(mesh, topology, cut);
  mesh.element_body = std::move(bodies.of_element);
  mesh.num_bodies = bodies.count;
}

}  // namespace breccia
