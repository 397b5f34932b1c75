#include "state/local_mesh.hpp"

#include <algorithm>
#include <string>

#include <Eigen/LU>

#include "base/error.hpp"
#include "state/joint_links.hpp"

namespace breccia {
namespace {

/// Elements of each volume group, ascending.
std::vector<std::vector<Index>> elements_by_group(const Mesh& mesh) {
  std::vector<std::vector<Index>> members(mesh.volume_groups.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    members[static_cast<std::size_t>(mesh.element_group[static_cast<std::size_t>(e)])].push_back(e);
  }
  return members;
}

/// Appends the elements of one group as whole blocks.
void append_group(LocalMesh& local, Index group, const std::vector<Index>& members) {
  for (const Index e : members) {
    local.slot_of_element[static_cast<std::size_t>(e)] = static_cast<Index>(local.element_of_slot.size());
    local.element_of_slot.push_back(e);
  }
  local.element_of_slot.resize(static_cast<std::size_t>(padded(static_cast<Index>(local.element_of_slot.size()))), -1);
  local.block_group.resize(local.element_of_slot.size() / kLanes, group);
}

/// Gives the corners of shared-node elements local nodes, numbered by first use; padding gets four spare nodes a block.
/// Returns the mesh node of every shared node, -1 for padding.
std::vector<Index> number_shared_nodes(LocalMesh& local, const Mesh& mesh) {
  std::vector<Index> local_of(mesh.nodes.size(), -1);
  std::vector<Index> mesh_node_of;
  const Index first = local.num_own_nodes();
  local.shared_corners.resize(static_cast<std::size_t>(local.num_slots - local.num_own_slots));
  for (Index s = local.num_own_slots; s < local.num_slots; ++s) {
    const GlobalId e = local.element_of_slot[static_cast<std::size_t>(s)];
    auto& corners = local.shared_corners[static_cast<std::size_t>(s - local.num_own_slots)];
    for (std::size_t c = 0; c < 4; ++c) {
      if (e < 0) {
        corners[c] = first + static_cast<Index>(mesh_node_of.size());
        mesh_node_of.push_back(-1);
        continue;
      }
      const Index node = mesh.elements[static_cast<std::size_t>(e)][c];
      Index& known = local_of[static_cast<std::size_t>(node)];
      if (known < 0) {
        known = first + static_cast<Index>(mesh_node_of.size());
        mesh_node_of.push_back(node);
      }
      corners[c] = known;
    }
  }
  mesh_node_of.resize(static_cast<std::size_t>(padded(static_cast<Index>(mesh_node_of.size()))), -1);
  local.num_nodes = first + static_cast<Index>(mesh_node_of.size());
  return mesh_node_of;
}

/// Corners of a padding element: a unit tetrahedron, so that nothing divides by zero.
const std::array<Vec3, 4> kPaddingCorners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

void fill_element(LocalMesh& local, const Mesh& mesh, const std::vector<double>& density, Index slot) {
  const auto s = static_cast<std::size_t>(slot);
  const GlobalId e = local.element_of_slot[s];
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
                           const std::vector<double>& density) {
  LocalMesh local;
  local.num_elements = mesh.num_elements();
  local.slot_of_element.assign(mesh.elements.size(), -1);
  const auto members = elements_by_group(mesh);
  for (const Discretisation kind : {Discretisation::own_nodes, Discretisation::shared_nodes}) {
    for (std::size_t g = 0; g < members.size(); ++g) {
      if (discretisation[g] == kind) append_group(local, static_cast<Index>(g), members[g]);
    }
    if (kind == Discretisation::own_nodes) local.num_own_slots = static_cast<Index>(local.element_of_slot.size());
  }
  DEMAND(local.element_of_slot.size() <= static_cast<std::size_t>(kMaxSlots),
         "a rank holds at most " + std::to_string(kMaxSlots) + " elements");
  local.num_slots = static_cast<Index>(local.element_of_slot.size());
  const std::vector<Index> mesh_node_of = number_shared_nodes(local, mesh);

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
  const GlobalId first_shared_id = 4 * static_cast<GlobalId>(mesh.num_elements());
  for (std::size_t n = 0; n < mesh_node_of.size(); ++n) {
    if (mesh_node_of[n] >= 0) local.node_id[static_cast<std::size_t>(local.num_own_nodes()) + n] = first_shared_id + mesh_node_of[n];
  }
  return local;
}

}  // namespace breccia
