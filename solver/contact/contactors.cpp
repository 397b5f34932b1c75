#include "contact/contactors.hpp"

#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "model/plane.hpp"

namespace breccia {

namespace {

/// Nodes at which elements of several groups meet.
std::vector<bool> nodes_between_groups(const Mesh& mesh) {
  std::vector<Index> group(at(mesh.num_nodes()), -1);
  std::vector<bool> between(group.size(), false);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (const Index node : mesh.elements[at(e)]) {
      if (group[at(node)] < 0) group[at(node)] = mesh.element_group[at(e)];
      if (group[at(node)] != mesh.element_group[at(e)]) between[at(node)] = true;
    }
  }
  return between;
}

}  // namespace

Contactors choose_contactors(const std::vector<bool>& breakable, const Mesh& mesh, const Topology& topology,
                             int across) {
  Contactors result;
  result.surface = surface_depth(breakable, mesh, across < 0 ? topology : without_sides(mesh, topology, across));
  const std::vector<bool> between = nodes_between_groups(mesh);
  result.chosen.assign(at(mesh.num_elements()), 0);
  double volume = 0, number = 0;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& nodes = mesh.elements[at(e)];
    const bool exposed = breakable[at(mesh.element_group[at(e)])] ||
                         std::any_of(nodes.begin(), nodes.end(),
                                     [&](Index n) { return result.surface.on_surface[at(n)] != 0 || between[at(n)]; });
    if (!exposed) continue;
    result.chosen[at(e)] = 1;
    const auto x = geometry::corners_of(mesh, e);
    volume += geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    number += 1;
  }
  if (number > 0) result.size = std::cbrt(6 * std::sqrt(2.0) * volume / number);
  return result;
}

}  // namespace breccia
