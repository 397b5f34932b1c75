#include "mesh/node_parting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/topology.hpp"

namespace breccia {
namespace {

constexpr double kCoincident = 1e-9;  // of the mesh's size: far above round-off, far below any element

std::vector<char> used_nodes(const Mesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const auto& corners : mesh.elements) {
    for (const Index node : corners) used[at(node)] = 1;
  }
  return used;
}

/// Bodies behind each surface triangle (by place in mesh.surface_faces), ascending, each once.
std::vector<std::vector<Index>> bodies_behind(const Mesh& mesh) {
  std::vector<std::pair<std::array<Index, 3>, std::size_t>> wanted;  // (sorted nodes, triangle)
  std::vector<char> on_surface(mesh.nodes.size(), 0);
  wanted.reserve(mesh.surface_faces.size());
  for (std::size_t f = 0; f < mesh.surface_faces.size(); ++f) {
    const auto& nodes = mesh.surface_faces[f].nodes;
    wanted.emplace_back(sorted(nodes), f);
    for (const Index node : nodes) on_surface[at(node)] = 1;
  }
  std::sort(wanted.begin(), wanted.end());

  std::vector<std::vector<Index>> bodies(mesh.surface_faces.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& corners = mesh.elements[at(e)];
    for (const auto& face : kFaceCorners) {
      const std::array<Index, 3> nodes{corners[at(face[0])], corners[at(face[1])], corners[at(face[2])]};
      if (!std::all_of(nodes.begin(), nodes.end(), [&](Index n) { return on_surface[at(n)] != 0; })) continue;
      const auto key = sorted(nodes);
      auto hit = std::lower_bound(wanted.begin(), wanted.end(), std::pair{key, std::size_t{0}});
      for (; hit != wanted.end() && hit->first == key; ++hit) bodies[hit->second].push_back(mesh.element_body[at(e)]);
    }
  }
  for (auto& list : bodies) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return bodies;
}

/// A node of a curve or point stays one, and so does every copy of it. @param copies  (node << 32 | body) to copy
void add_copies(const std::unordered_map<std::uint64_t, Index>& copies, std::vector<Mesh::GroupNode>& group_nodes) {
  if (group_nodes.empty()) return;
  std::unordered_multimap<Index, Index> copies_of;
  for (const auto& [key, copy] : copies) copies_of.emplace(static_cast<Index>(key >> 32), copy);
  const std::size_t before = group_nodes.size();
  for (std::size_t i = 0; i < before; ++i) {
    const auto [first, last] = copies_of.equal_range(group_nodes[i].node);
    for (auto copy = first; copy != last; ++copy) group_nodes.push_back({copy->second, group_nodes[i].group});
  }
}

}  // namespace

Index count_orphan_nodes(const Mesh& mesh) {
  const auto used = used_nodes(mesh);
  return static_cast<Index>(std::count(used.begin(), used.end(), 0));
}

namespace {

/// (nodes) The first node of the same class within the distance, m, of each node, along each axis: itself where there
/// is none before it. @param classes  (nodes) -1: of no element, counts for none
std::vector<Index> first_nearby(const Mesh& mesh, const std::vector<Index>& classes, double distance) {
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::max());
  for (std::size_t n = 0; n < classes.size(); ++n) {
    if (classes[n] >= 0) lowest = lowest.cwiseMin(mesh.nodes[n]);
  }
  // Cells much wider than the distance: a node's neighbourhood lies in one cell, rarely in two, at most in eight.
  const double per_metre = 1.0 / (256.0 * distance);

  using Cell = std::array<std::int64_t, 3>;
  const auto cell_of = [&](const Vec3& x) {
    Cell cell{};
    for (int a = 0; a < 3; ++a) cell[at(a)] = static_cast<std::int64_t>(std::floor((x[a] - lowest[a]) * per_metre));
    return cell;
  };
  const auto hash = [](const Cell& cell) {
    std::uint64_t h = 0;
    for (const std::int64_t c : cell) h = (h ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  };
  std::unordered_multimap<Cell, Index, decltype(hash)> seen(mesh.nodes.size(), hash);
  const auto first_at = [&](Index node) {
    const Vec3& x = mesh.nodes[at(node)];
    const Cell first = cell_of(x - Vec3::Constant(distance)), last = cell_of(x + Vec3::Constant(distance));
    for (std::int64_t i = first[0]; i <= last[0]; ++i) {
      for (std::int64_t j = first[1]; j <= last[1]; ++j) {
        for (std::int64_t k = first[2]; k <= last[2]; ++k) {
          const auto [begin, end] = seen.equal_range(Cell{i, j, k});
          const auto near = [&](const auto& entry) {
            return classes[at(entry.second)] == classes[at(node)] &&
                   (mesh.nodes[at(entry.second)] - x).cwiseAbs().maxCoeff() <= distance;
          };
          const auto twin = std::find_if(begin, end, near);
          if (twin != end) return twin->second;
        }
      }
    }
    return node;
  };
  std::vector<Index> first(classes.size());
  for (Index n = 0; n < mesh.num_nodes(); ++n) {
    const bool used = classes[at(n)] >= 0;
    first[at(n)] = used ? first_at(n) : n;
    if (used && first[at(n)] == n) seen.emplace(cell_of(mesh.nodes[at(n)]), n);
  }
  return first;
}

/// (nodes) -1: of no element; else 0, or the first volume that has it.
std::vector<Index> volumes_of_nodes(const Mesh& mesh, bool all_alike) {
  std::vector<Index> volumes(mesh.nodes.size(), -1);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (const Index node : mesh.elements[at(e)]) {
      if (volumes[at(node)] < 0) volumes[at(node)] = all_alike ? 0 : mesh.volume_of(e);
    }
  }
  return volumes;
}

/// Largest extent of the nodes of elements, m.
double size_of(const Mesh& mesh, const std::vector<Index>& volumes) {
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::max()), highest = -lowest;
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    if (volumes[n] < 0) continue;
    lowest = lowest.cwiseMin(mesh.nodes[n]);
    highest = highest.cwiseMax(mesh.nodes[n]);
  }
  return (highest - lowest).maxCoeff();
}

}  // namespace

std::vector<Index> coincident_nodes(const Mesh& mesh) {
  const std::vector<Index> used = volumes_of_nodes(mesh, true);
  return first_nearby(mesh, used, kCoincident * size_of(mesh, used));
}

Index join_near_nodes(Mesh& mesh, double distance, bool across_volumes) {
  const std::vector<Index> first = first_nearby(mesh, volumes_of_nodes(mesh, across_volumes), distance);
  for (auto& corners : mesh.elements) {
    for (Index& node : corners) node = first[at(node)];
  }
  for (Mesh::SurfaceFace& face : mesh.surface_faces) {
    for (Index& node : face.nodes) node = first[at(node)];
  }
  for (Mesh::GroupNode& one : mesh.group_nodes) one.node = first[at(one.node)];
  Index merged = 0;
  for (Index n = 0; n < mesh.num_nodes(); ++n) merged += first[at(n)] != n;
  return merged;
}

Index count_duplicate_nodes(const Mesh& mesh) {
  const std::vector<Index> first = coincident_nodes(mesh);
  Index twins = 0;
  for (Index n = 0; n < mesh.num_nodes(); ++n) twins += first[at(n)] != n;
  return twins;
}

void demand_surfaces_are_faces(const Mesh& mesh) {
  const auto bodies = bodies_behind(mesh);
  std::map<Index, Index> strays;  // by surface group
  for (std::size_t f = 0; f < bodies.size(); ++f) {
    if (bodies[f].empty()) ++strays[mesh.surface_faces[f].group];
  }
  std::vector<Problem> problems;
  problems.reserve(strays.size());
  for (const auto& [group, number] : strays) {
    problems.push_back({mesh.source, 0, "surface group \"" + mesh.surface_groups[at(group)] + "\"", kStrayTriangles,
                        kFacesOfVolumes, std::to_string(number) + " such triangles"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

Index part_bodies(Mesh& mesh) {
  const auto bodies = bodies_behind(mesh);
  constexpr Index kNone = -1;
  std::vector<Index> owner(mesh.nodes.size(), kNone);  // the body that keeps the node
  std::unordered_map<std::uint64_t, Index> copies;     // (node, body) of every other body
  const auto node_in = [&](Index node, Index body) {
    if (owner[at(node)] == kNone) owner[at(node)] = body;
    if (owner[at(node)] == body) return node;
    const auto key = (static_cast<std::uint64_t>(node) << 32) | static_cast<std::uint32_t>(body);
    const auto [entry, fresh] = copies.try_emplace(key, mesh.num_nodes());
    if (fresh) {
      const Vec3 position = mesh.nodes[at(node)];
      mesh.nodes.push_back(position);
    }
    return entry->second;
  };
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (Index& node : mesh.elements[at(e)]) node = node_in(node, mesh.element_body[at(e)]);
  }
  std::vector<Mesh::SurfaceFace> faces;
  faces.reserve(mesh.surface_faces.size());
  for (std::size_t f = 0; f < bodies.size(); ++f) {
    for (const Index body : bodies[f]) {
      Mesh::SurfaceFace face = mesh.surface_faces[f];
      for (Index& node : face.nodes) node = node_in(node, body);
      faces.push_back(face);
    }
  }
  mesh.surface_faces = std::move(faces);
  add_copies(copies, mesh.group_nodes);
  return static_cast<Index>(copies.size());
}

}  // namespace breccia
