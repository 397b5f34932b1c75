#pragma once

#include <algorithm>
#include <vector>

#include "base/index.hpp"
#include "mesh/raster.hpp"
#include "state/records.hpp"

namespace breccia::test {

inline Mesh cubes() { return make_raster({.cells = {3, 2, 1}, .group = "block"}).mesh; }

/// Bare records of a whole mesh, with one tag, joint and hold for every third element.
inline Records records_of(const Mesh& mesh, const Topology& topology) {
  Records records;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    ElementRecord record;
    record.id = e;
    record.group = mesh.element_group[at(e)];
    record.body = mesh.element_body[at(e)];
    record.source_id = mesh.element_source_id[at(e)];
    for (std::size_t c = 0; c < 4; ++c) {
      record.vertex[c] = mesh.elements[at(e)][c];
      const Vec3& x = mesh.nodes[at(mesh.elements[at(e)][c])];
      record.reference[c] = record.position[c] = {x[0], x[1], x[2]};
    }
    for (std::size_t f = 0; f < 4; ++f) {
      record.neighbour[f] = topology.links[at(e)][f].neighbour;
      record.code[f] = topology.links[at(e)][f].code;
    }
    records.elements.push_back(record);
    if (e % 3 != 0) continue;
    records.corners.push_back({e, 0, 5});
    records.holds.push_back({e, 1, 2, 0, 0.5, -0.25});
    records.joints.push_back({e, e + 1, {}});
    records.joints.back().joint.history.mode_1 = 0.125 * e;
  }
  for (std::size_t g = 0; g < topology.surface_groups.size(); ++g) {
    for (const Topology::Face& face : topology.surface_groups[g])
      records.faces.push_back({face.element, static_cast<Index>(g), face.face});
  }
  std::stable_sort(records.faces.begin(), records.faces.end(),
                   [](const FaceTag& p, const FaceTag& q) { return p.element < q.element; });
  return records;
}

/// Marks of the elements for which wanted(id) holds.
template <class Wanted>
std::vector<std::uint8_t> marks(const Records& records, Wanted&& wanted) {
  std::vector<std::uint8_t> list;
  for (const ElementRecord& record : records.elements) list.push_back(wanted(record.id) ? 1 : 0);
  return list;
}

}  // namespace breccia::test
