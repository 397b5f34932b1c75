#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"
#include "model/model.hpp"
#include "state/records.hpp"

namespace breccia {

// What a rank builds its piece of the model from.

[[nodiscard]] std::vector<std::byte> pack(const WholeModel& whole);
/// Throws InternalError if the bytes are not whole.
[[nodiscard]] WholeModel unpack_whole(std::span<const std::byte> packed);

/// The bare mesh of the records: elements and nodes ascending by id, links to elements that are not here `kBeyond`.
/// @param whole  for the names of the groups
[[nodiscard]] Mesh mesh_of(const Records& records, const WholeModel& whole);
/// @param mesh  as mesh_of gave it
[[nodiscard]] Topology topology_of(const Records& records, const Mesh& mesh);

}  // namespace breccia
