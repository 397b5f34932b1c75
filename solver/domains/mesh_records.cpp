#include "domains/mesh_records.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace breccia {
namespace {}  // namespace

ElementRecord mesh_record(const Mesh& mesh, const Topology& topology, Index element) {
  ElementRecord record;
  record.id = mesh.element_id(element);
  record.source_id = mesh.element_source_id[at(element)];
  record.group = mesh.element_group[at(element)];
  record.body = mesh.element_body[at(element)];
  for (std::size_t c = 0; c < 4; ++c) {
    const Index node = mesh.elements[at(element)][c];
    const Vec3& x = mesh.nodes[at(node)];
    record.vertex[c] = mesh.node_id(node);
    record.reference[c] = {x[0], x[1], x[2]};
  }
  for (std::size_t f = 0; f < 4; ++f) {
    // An element beyond the piece is one that has broken off and left. What it was to this one is still known.
    const FaceLink& link = topology.links[at(element)][f];
    record.neighbour[f] = neighbour_id(mesh, topology, element, static_cast<int>(f));
    record.code[f] = link.free() ? std::int8_t{0} : link.code;
  }
  return record;
}

std::vector<FaceTag> face_tags(const Mesh& mesh, const Topology& topology) {
  std::vector<FaceTag> tags;
  for (std::size_t g = 0; g < topology.surface_groups.size(); ++g) {
    for (const Topology::Face& face : topology.surface_groups[g])
      tags.push_back({mesh.element_id(face.element), static_cast<Index>(g), face.face});
  }
  std::stable_sort(tags.begin(), tags.end(), [](const FaceTag& p, const FaceTag& q) { return p.element < q.element; });
  return tags;
}

}  // namespace breccia
