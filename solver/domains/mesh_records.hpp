#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"
#include "state/records.hpp"

namespace breccia {

/// What an element is in the mesh; nothing of its state.
[[nodiscard]] ElementRecord mesh_record(const Mesh& mesh, const Topology& topology, Index element);

/// The faces on physical surfaces, ascending by element.
[[nodiscard]] std::vector<FaceTag> face_tags(const Mesh& mesh, const Topology& topology);

/// Appends the tags of an element. @param tags  ascending by element
/// @param next  in: no tag before it is of this or a later element; out: likewise for the next element
template <class Tag>
void append_tags(const std::vector<Tag>& tags, GlobalId element, std::size_t& next, std::vector<Tag>& chosen) {
  while (next < tags.size() && tags[next].element < element) ++next;
  for (; next < tags.size() && tags[next].element == element; ++next) chosen.push_back(tags[next]);
}

}  // namespace breccia
