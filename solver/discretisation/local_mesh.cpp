#include "discretisation/local_mesh.hpp"

#include <limits>
#include <string>

#include <Eigen/LU>

#include "base/error.hpp"
#include "discretisation/joint_links.hpp"

namespace breccia {
namespace {

/// Places the elements of one volume group that are wanted, ascending, in whole blocks.
template <class Wanted>
void append_group(LocalMesh& local, const Mesh& mesh, Index group, Wanted&& wanted) {
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    if (mesh.element_group[static_cast<std::size_t>(e)] != group || !wanted(e)) continue;
    local.slot_of_element[static_cast<std::size_t>(e)] = static_cast<Index>(local.mesh_element.size());
    local.mesh_element.push_back(e);
  }
  local.mesh_element.resize(static_cast<std::size_t>(padded(static_cast<Index>(local.mesh_element.size()))), -1);
  local.block_group.resize(local.mesh_element.size() / kLanes, group);
}

/// Slots of all elements in the order that LocalMesh describes.
void place_elements(LocalMesh& local, const Mesh& mesh, const std::vector<Discretisation>& discretisation,
                    const std::vector<std::uint8_t>& original) {
  const auto own = [&](Index e) { return original.empty() || original[static_cast<std::size_t>(e)] != 0; };
  const auto append = [&](Discretisation kind, auto&& wanted) {
    for (std::size_t g = 0; g < discretisation.size(); ++g) {
      if (discretisation[g] == kind) append_group(local, mesh, static_cast<Index>(g), wanted);
    }
    return static_cast<Index>(local.mesh_element.size());
  };
  local.slot_of_element.assign(mesh.elements.size(), -1);
  local.num_own_originals = append(Discretisation::own_nodes, own);
  local.num_own_slots = append(Discretisation::own_nodes, [&](Index e) { return !own(e); });
  DEMAND(local.mesh_element.size() <= static_cast<std::size_t>(kMaxSlots),
         "a rank holds at most " + std::to_string(kMaxSlots) + " elements");
  local.num_slots = append(Discretisation::shared_nodes, [](Index) { return true; });
  local.element_of_slot.assign(local.mesh_element.size(), -1);
  local.original.assign(local.mesh_element.size(), 0);
  for (std::size_t s = 0; s < local.mesh_element.size(); ++s) {
    const Index e = local.mesh_element[s];
    if (e < 0) continue;
    local.element_of_slot[s] = mesh.element_id(e);
    local.original[s] = own(e) ? 1 : 0;
  }
}

/// Gives the corners of shared-node elements local nodes, numbered by first use, those that originals touch first;
/// padding gets four spare nodes a block. Returns the ids of the shared nodes, -1 for padding.
std::vector<GlobalId> number_shared_nodes(LocalMesh& local, const Mesh& mesh, const std::vector<Index>& node_sets) {
  const auto set_of = [&](Index element) {
    return node_sets.empty()
               ? Index{0}
               : node_sets[static_cast<std::size_t>(mesh.element_group[static_cast<std::size_t>(element)])];
  };
  const Index num_sets = node_sets.empty() ? 1 : 1 + *std::max_element(node_sets.begin(), node_sets.end());
  std::vector<Index> local_of(mesh.nodes.size() * static_cast<std::size_t>(num_sets), -1);  // [set][node]
  const auto known = [&](Index element, std::size_t corner) -> Index& {
    return local_of[static_cast<std::size_t>(set_of(element)) * mesh.nodes.size() +
                    static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(element)][corner])];
  };
  std::vector<GlobalId> ids;
  const Index first = local.num_own_nodes();
  const auto fresh = [&](GlobalId id) {
    ids.push_back(id);
    return first + static_cast<Index>(ids.size()) - 1;
  };
  const auto number = [&](bool originals) {
    for (Index s = local.num_own_slots; s < local.num_slots; ++s) {
      const Index e = local.mesh_element[static_cast<std::size_t>(s)];
      if (e < 0 || local.is_original(s) != originals) continue;
      for (std::size_t c = 0; c < 4; ++c) {
        Index& node = known(e, c);
        if (node < 0)
          node = fresh(shared_node_id(set_of(e), mesh.node_id(mesh.elements[static_cast<std::size_t>(e)][c])));
      }
    }
    while (ids.size() % kLanes != 0) fresh(-1);
    return first + static_cast<Index>(ids.size());
  };
  local.num_moved_nodes = number(true);
  number(false);
  local.shared_corners.resize(static_cast<std::size_t>(local.num_slots - local.num_own_slots));
  for (Index s = local.num_own_slots; s < local.num_slots; ++s) {
    const Index e = local.mesh_element[static_cast<std::size_t>(s)];
    auto& corners = local.shared_corners[static_cast<std::size_t>(s - local.num_own_slots)];
    for (std::size_t c = 0; c < 4; ++c) corners[c] = e < 0 ? fresh(-1) : known(e, c);
  }
  while (ids.size() % kLanes != 0) fresh(-1);
  local.num_nodes = first + static_cast<Index>(ids.size());
  return ids;
}

/// A node is counted by the rank that owns its lowest element.
void count_nodes(LocalMesh& local) {
  local.counted.assign(static_cast<std::size_t>(local.num_nodes), 0);
  std::vector<GlobalId> lowest(static_cast<std::size_t>(local.num_nodes), std::numeric_limits<GlobalId>::max());
  for (Index s = 0; s < local.num_slots; ++s) {
    const GlobalId id = local.element_of_slot[static_cast<std::size_t>(s)];
    for (int c = 0; c < 4 && id >= 0; ++c) {
      const auto node = static_cast<std::size_t>(local.corner_node(s, c));
      if (id >= lowest[node]) continue;
      lowest[node] = id;
      local.counted[node] = local.original[static_cast<std::size_t>(s)];
    }
  }
}

/// Corners of a padding element: a unit tetrahedron, so that nothing divides by zero.
const std::array<Vec3, 4> kPaddingCorners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

void fill_element(LocalMesh& local, const Mesh& mesh, const std::vector<double>& density, Index slot) {
  const auto s = static_cast<std::size_t>(slot);
  const Index e = local.mesh_element[s];
  std::array<Vec3, 4> x = kPaddingCorners;
  if (e >= 0) {
    for (std::size_t c = 0; c < 4; ++c) {
      local.vertex[s][c] = mesh.elements[static_cast<std::size_t>(e)][c];
      x[c] = mesh.nodes[static_cast<std::size_t>(local.vertex[s][c])];
    }
    local.slot_body[s] = mesh.element_body[static_cast<std::size_t>(e)];
  }
  Mat3 edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const Mat3 inverse = edges.inverse();
  const double volume = e >= 0 ? edges.determinant() / 6.0 : 0.0;
  DEMAND(e < 0 || volume > 0.0, "element " + std::to_string(e) + " has volume " + std::to_string(volume));

  const std::size_t block = s / kLanes, lane = s % kLanes;
  for (std::size_t i = 0; i < 9; ++i) {
    local.gradient[block * 72 + i * kLanes + lane] = inverse(static_cast<Index>(i / 3), static_cast<Index>(i % 3));
  }
  local.volume[s] = volume;
  const double mass = e >= 0 ? 0.25 * density[static_cast<std::size_t>(local.block_group[block])] * volume : 0.0;
  for (int c = 0; c < 4; ++c) {
    const Index node = local.corner_node(slot, c);
    local.node_mass[static_cast<std::size_t>(node)] += mass;
    store_node(local.reference.data(), node, x[static_cast<std::size_t>(c)]);
  }
}

}  // namespace

LocalMesh build_local_mesh(const Mesh& mesh, const std::vector<Discretisation>& discretisation,
                           const std::vector<double>& density, const std::vector<std::uint8_t>& original,
                           const std::vector<Index>& node_sets) {
  LocalMesh local;
  local.num_elements = mesh.num_elements();
  place_elements(local, mesh, discretisation, original);
  const std::vector<GlobalId> shared_ids = number_shared_nodes(local, mesh, node_sets);

  const auto slots = static_cast<std::size_t>(local.num_slots);
  const auto nodes = static_cast<std::size_t>(local.num_nodes);
  local.slot_body.assign(slots, -1);
  local.vertex.assign(slots, {-1, -1, -1, -1});
  local.gradient.assign(slots * 9, 0.0);
  local.volume.assign(slots, 0.0);
  local.node_mass.assign(nodes, 0.0);
  local.reference.assign(nodes * 3, 0.0);
  for (Index s = 0; s < local.num_slots; ++s) fill_element(local, mesh, density, s);
  for (double& m : local.node_mass) {
    if (m == 0.0) m = 1.0;  // padding: divides safely, moves nowhere
  }

  local.node_id.assign(nodes, -1);
  for (Index s = 0; s < local.num_own_slots; ++s) {
    const GlobalId e = local.element_of_slot[static_cast<std::size_t>(s)];
    for (int c = 0; c < 4 && e >= 0; ++c) local.node_id[static_cast<std::size_t>(own_corner_node(s, c))] = 4 * e + c;
  }
  std::copy(shared_ids.begin(), shared_ids.end(), local.node_id.begin() + local.num_own_nodes());
  count_nodes(local);
  return local;
}

const double* LocalMesh::block_corners(Index block, const double* field, BlockCorners& room) const {
  if (block < num_own_blocks()) return field + kBlockCorners * static_cast<std::size_t>(block);
  for (Index lane = 0; lane < kLanes; ++lane) {
    for (int corner = 0; corner < 4; ++corner) {
      const Index node = corner_node(block * kLanes + lane, corner);
      for (int axis = 0; axis < 3; ++axis)
        room[static_cast<std::size_t>((3 * corner + axis) * kLanes + lane)] = field[nodal(node, axis)];
    }
  }
  return room.data();
}

}  // namespace breccia
