#include "mesh/finish.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/bodies.hpp"
#include "mesh/geometry.hpp"
#include "mesh/node_parting.hpp"
#include "mesh/space_curve.hpp"
#include "system/interruption.hpp"

namespace breccia {
namespace {

constexpr double kFlatShare = 1e-10;  // of the longest edge cubed: a height of 1e-9 edges, below any use
constexpr double kSmallest = 1e-50, kLargest = 1e50;  // m, of edges and coordinates: far beyond any use
constexpr double kRoundedStrain = 1e-5;               // rounding of positions over an edge: rock breaks at 1e-4
constexpr std::size_t kIdsNamed = 10;

/// Element ids for a message: the first ten, then the count of all.
std::string list_of(const std::vector<std::int64_t>& ids) {
  std::string text;
  for (std::size_t i = 0; i < std::min(ids.size(), kIdsNamed); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(ids[i]);
  }
  if (ids.size() > kIdsNamed) text += ", ...";
  return text + " (" + std::to_string(ids.size()) + (ids.size() == 1 ? " element)" : " elements)");
}

double volume_of(const Mesh& mesh, Index element) {
  const auto x = geometry::corners_of(mesh, element);
  return geometry::tetra_volume(x[0], x[1], x[2], x[3]);
}

/// Elements keep their shape, but for what is within the distance: none loses half of its volume.
/// Returns how many nodes became an earlier one.
Index merge_nodes(Mesh& mesh, double distance, bool across_volumes) {
  constexpr double kLeastShare = 0.5;
  std::vector<double> before(mesh.elements.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) before[at(e)] = volume_of(mesh, e);
  const Index merged = join_near_nodes(mesh, distance, across_volumes);
  std::vector<std::int64_t> collapsed;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    std::array<Index, 4> corners = mesh.elements[at(e)];
    std::sort(corners.begin(), corners.end());
    const bool is_flat = before[at(e)] != 0 && !(volume_of(mesh, e) / before[at(e)] > kLeastShare);
    if (is_flat || std::adjacent_find(corners.begin(), corners.end()) != corners.end())
      collapsed.push_back(mesh.element_source_id[at(e)]);
  }
  if (collapsed.empty()) return merged;
  std::ostringstream given;
  given << distance << " m: element " << list_of(collapsed);
  throw InputError(Problem{mesh.source, 0, "mesh.merge_nodes", "elements would collapse as their nodes are merged",
                           "a distance far below the shortest edge", given.str()});
}

void demand_sizes(const Mesh& mesh) {
  if (mesh.elements.empty()) {
    throw InputError(Problem{mesh.source, 0, "mesh", "the mesh has no tetrahedra", "at least one", ""});
  }
  constexpr auto kMostElements = static_cast<std::size_t>(std::numeric_limits<Index>::max() / 4);
  if (mesh.elements.size() > kMostElements) {
    throw InputError(Problem{mesh.source, 0, "mesh", "too many tetrahedra", "up to " + std::to_string(kMostElements),
                             std::to_string(mesh.elements.size())});
  }
  const std::size_t num_elements = mesh.elements.size();
  DEMAND(mesh.element_group.size() == num_elements && mesh.element_body.size() == num_elements &&
             mesh.element_source_id.size() == num_elements,
         std::to_string(num_elements) + " elements");
}

/// Elements can be computed with: their sixth powers, of volumes squared, are numbers.
void demand_computable(const Mesh& mesh) {
  std::vector<std::int64_t> bad, beyond, far;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& corners = mesh.elements[at(e)];
    if (!std::all_of(corners.begin(), corners.end(), [&](Index n) { return mesh.nodes[at(n)].allFinite(); })) {
      bad.push_back(mesh.element_source_id[at(e)]);
      continue;
    }
    const auto x = geometry::corners_of(mesh, e);
    double largest = 0, longest = 0;
    for (const Vec3& corner : x) largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    for (const auto& [a, b] : geometry::kEdges) {
      longest = std::max(longest, (x[at(a)] - x[at(b)]).cwiseAbs().maxCoeff());  // a square may vanish
    }
    const bool tiny = longest > 0 && longest < kSmallest;  // of no length at all: reported as a flat one
    const double rounding = largest * std::numeric_limits<double>::epsilon();
    if (largest > kLargest || tiny)
      beyond.push_back(mesh.element_source_id[at(e)]);
    else if (rounding > kRoundedStrain * longest && longest > 0)
      far.push_back(mesh.element_source_id[at(e)]);
  }
  if (!beyond.empty()) {
    throw InputError(Problem{mesh.source, 0, "mesh", "elements of a size or place that cannot be computed with",
                             "coordinates up to 1e50 m, edges of at least 1e-50 m", "element " + list_of(beyond)});
  }
  if (!far.empty()) {
    throw InputError(Problem{mesh.source, 0, "mesh", "elements so far from the origin that their strains are round-off",
                             "a mesh moved towards the origin: coordinates up to 4.5e10 edges",
                             "element " + list_of(far)});
  }
  if (!bad.empty()) {
    throw InputError(Problem{mesh.source, 0, "mesh", "elements with a coordinate that is not finite", "finite numbers",
                             "element " + list_of(bad)});
  }
}

/// Flat elements are refused; inverted ones are turned or refused. Returns how many were turned.
Index orient(Mesh& mesh, bool repair) {
  std::vector<std::int64_t> flat, inverted;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    const double longest = geometry::longest_edge(x);
    const double volume = geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    if (!(std::abs(volume) > kFlatShare * longest * longest * longest)) {
      flat.push_back(mesh.element_source_id[at(e)]);
    } else if (volume < 0) {
      inverted.push_back(mesh.element_source_id[at(e)]);
      if (repair) std::swap(mesh.elements[at(e)][2], mesh.elements[at(e)][3]);
    }
  }
  std::vector<Problem> problems;
  if (!flat.empty()) {
    problems.push_back(
        {mesh.source, 0, "mesh", "elements of zero volume", "tetrahedra with a volume", "element " + list_of(flat)});
  }
  if (!inverted.empty() && !repair) {
    problems.push_back({mesh.source, 0, "mesh", "inverted elements", "positive volumes, or mesh.inverted = \"repair\"",
                        "element " + list_of(inverted)});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return static_cast<Index>(inverted.size());
}

/// Old indices of the elements in their new order.
std::vector<Index> element_order(const Mesh& mesh) {
  std::vector<Vec3> centroids(mesh.elements.size());
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::max()), highest = -lowest;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    centroids[at(e)] = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    lowest = lowest.cwiseMin(centroids[at(e)]);
    highest = highest.cwiseMax(centroids[at(e)]);
  }
  constexpr double kCells = static_cast<double>(1u << kHilbertBits);
  // One cell size for all axes, a hair above extent / cells so that the highest centroid stays inside.
  const double extent = std::max((highest - lowest).maxCoeff(), kSmallest);
  const double cells_per_metre = (kCells - 1) / extent;

  struct Key {
    Index group;
    std::uint64_t rank;
    Index old;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys(mesh.elements.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    std::array<std::uint32_t, 3> cell{};
    for (int a = 0; a < 3; ++a) {
      const double cells = (centroids[at(e)][a] - lowest[a]) * cells_per_metre;
      cell[at(a)] = static_cast<std::uint32_t>(std::clamp(cells, 0.0, kCells - 1));
    }
    keys[at(e)] = {mesh.element_group[at(e)], hilbert_rank(cell), e};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.old; });
  return order;
}

template <class T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<Index>& order) {
  std::vector<T> result(order.size());
  std::transform(order.begin(), order.end(), result.begin(), [&](Index old) { return values[at(old)]; });
  return result;
}

void sort_elements(Mesh& mesh) {
  const std::vector<Index> order = element_order(mesh);
  mesh.elements = permuted(mesh.elements, order);
  mesh.element_group = permuted(mesh.element_group, order);
  mesh.element_body = permuted(mesh.element_body, order);
  mesh.element_source_id = permuted(mesh.element_source_id, order);
  std::vector<Index> new_of(order.size());
  for (std::size_t e = 0; e < order.size(); ++e) new_of[at(order[e])] = static_cast<Index>(e);
  for (Mesh::SetElement& one : mesh.set_elements) one.element = new_of[at(one.element)];
  std::sort(mesh.set_elements.begin(), mesh.set_elements.end(), [](const auto& a, const auto& b) {
    return std::pair{a.group, a.element} < std::pair{b.group, b.element};
  });
}

/// Nodes in the order in which the elements touch them; nodes of no element are dropped. @pre surface faces name only
/// nodes of elements. Of curves and points they get the number -1.
void sort_nodes(Mesh& mesh) {
  std::vector<Index> new_of(mesh.nodes.size(), -1);
  std::vector<Vec3> nodes;
  nodes.reserve(mesh.nodes.size());
  for (auto& corners : mesh.elements) {
    for (Index& node : corners) {
      Index& number = new_of[at(node)];
      if (number < 0) {
        number = static_cast<Index>(nodes.size());
        nodes.push_back(mesh.nodes[at(node)]);
      }
      node = number;
    }
  }
  for (auto& face : mesh.surface_faces) {
    for (Index& node : face.nodes) node = new_of[at(node)];
  }
  for (Mesh::GroupNode& one : mesh.group_nodes) one.node = new_of[at(one.node)];
  mesh.nodes = std::move(nodes);
}

/// Sorted, each once: a triangle may stand in the file for each of the two bodies it parts.
void sort_surface_faces(Mesh& mesh) {
  const auto key = [](const Mesh::SurfaceFace& face) {
    std::array<Index, 3> nodes = face.nodes;
    std::sort(nodes.begin(), nodes.end());
    return std::pair{face.group, nodes};
  };
  auto& faces = mesh.surface_faces;
  std::sort(faces.begin(), faces.end(), [&](const auto& a, const auto& b) {
    return std::pair{key(a), a.nodes} < std::pair{key(b), b.nodes};
  });
  faces.erase(std::unique(faces.begin(), faces.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
              faces.end());
}

/// Sorted, each once; those of no element are dropped.
void sort_group_nodes(Mesh& mesh) {
  auto& all = mesh.group_nodes;
  std::erase_if(all, [](const Mesh::GroupNode& one) { return one.node < 0; });
  const auto key = [](const Mesh::GroupNode& one) { return std::pair{one.group, one.node}; };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  all.erase(std::unique(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
            all.end());
}

void count(const Mesh& mesh, MeshReport& report) {
  report.nodes = mesh.num_nodes();
  report.elements = mesh.num_elements();
  report.bodies = mesh.num_bodies;
  for (const std::string& name : mesh.volume_groups) report.volume_groups.push_back({name, 0});
  for (const std::string& name : mesh.surface_groups) report.surface_groups.push_back({name, 0});
  for (const std::string& name : mesh.node_groups) report.node_groups.push_back({name, 0});
  for (const std::string& name : mesh.element_sets) report.element_sets.push_back({name, 0});
  for (const Mesh::SetElement& one : mesh.set_elements) ++report.element_sets[at(one.group)].count;
  for (const Mesh::GroupNode& one : mesh.group_nodes) ++report.node_groups[at(one.group)].count;
  for (const Index group : mesh.element_group) ++report.volume_groups[at(group)].count;
  for (const auto& face : mesh.surface_faces) ++report.surface_groups[at(face.group)].count;
}

/// Leaves out the groups of one kind that nothing is in; `use` visits the number of each thing's group.
template <class Use>
void drop_empty_groups(std::vector<std::string>& names, std::vector<std::string>& empty, const Use& use) {
  std::vector<Index> new_of(names.size(), -1);
  use([&](Index& group) { new_of[at(group)] = 0; });
  std::vector<std::string> kept;
  for (std::size_t g = 0; g < names.size(); ++g) {
    if (new_of[g] == 0) new_of[g] = static_cast<Index>(kept.size());
    (new_of[g] < 0 ? empty : kept).push_back(names[g]);
  }
  names = std::move(kept);
  use([&](Index& group) { group = new_of[at(group)]; });
}

/// What a case demands of such a group would be lost without a word.
void drop_empty_groups(Mesh& mesh, MeshReport& report) {
  std::vector<std::string>& empty = report.empty_groups;
  drop_empty_groups(mesh.volume_groups, empty, [&](const auto& visit) {
    std::for_each(mesh.element_group.begin(), mesh.element_group.end(), visit);
  });
  drop_empty_groups(mesh.surface_groups, empty, [&](const auto& visit) {
    for (Mesh::SurfaceFace& face : mesh.surface_faces) visit(face.group);
  });
  drop_empty_groups(mesh.node_groups, empty, [&](const auto& visit) {
    for (Mesh::GroupNode& one : mesh.group_nodes) visit(one.group);
  });
  drop_empty_groups(mesh.element_sets, empty, [&](const auto& visit) {
    for (Mesh::SetElement& one : mesh.set_elements) visit(one.group);
  });
}

}  // namespace

FinishedMesh finish_mesh(Mesh raw, const FinishOptions& options) {
  FinishedMesh result{std::move(raw), {}};
  Mesh& mesh = result.mesh;
  MeshReport& report = result.report;

  demand_sizes(mesh);
  demand_computable(mesh);
  report.orphan_nodes = count_orphan_nodes(mesh);
  if (options.merge_nodes > 0) report.merged_nodes = merge_nodes(mesh, options.merge_nodes, options.glue);
  report.inverted_repaired = orient(mesh, options.repair_inverted);
  give_up_if_interrupted();
  report.duplicate_nodes = count_duplicate_nodes(mesh);
  give_up_if_interrupted();
  demand_surfaces_are_faces(mesh);
  if (!options.glue) report.split_nodes = part_bodies(mesh);
  give_up_if_interrupted();
  sort_elements(mesh);
  give_up_if_interrupted();
  sort_nodes(mesh);
  sort_surface_faces(mesh);
  sort_group_nodes(mesh);
  drop_empty_groups(mesh, report);
  give_up_if_interrupted();
  mesh.element_volume = mesh.element_body;
  number_bodies(build_topology(mesh), {}, mesh);
  count(mesh, report);
  return result;
}

}  // namespace breccia
