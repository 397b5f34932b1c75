#include "model/nodal_loads.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

double mass_of(const Model& model, Index element) {
  const auto x = geometry::corners_of(model.mesh, element);
  return model.density[at(model.mesh.element_group[at(element)])] * geometry::tetra_volume(x[0], x[1], x[2], x[3]);
}

double area_of(const Mesh& mesh, const Topology::Face& face) {
  std::array<Vec3, 3> x;
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = mesh.nodes[at(mesh.elements[at(face.element)][at(kFaceCorners[at(face.face)][i])])];
  return 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
}

/// Calls f(element, tag) for all corner tags, ascending elements.
template <class F>
void for_each_tag(const Model& model, F&& f) {
  auto tag = model.corner_tags.begin();
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (; tag != model.corner_tags.end() && tag->element == model.mesh.element_id(e); ++tag) f(e, *tag);
  }
}

/// Sums shares of nodes in the order in which they are added, which is that of the elements.
class Shares {
 public:
  explicit Shares(const Model& model) : model_(model) {}

  void add(Index element, int corner, double share) {
    const Index slot = model_.local.slot_of_element[at(element)];
    shares_.push_back({model_.local.corner_node(slot, corner), share});
  }

  [[nodiscard]] std::vector<NodeShare> take() {
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const NodeShare& a, const NodeShare& b) { return a.node < b.node; });
    std::vector<NodeShare> nodes;
    for (const NodeShare& one : shares_) {
      if (nodes.empty() || nodes.back().node != one.node) {
        nodes.push_back(one);
      } else {
        nodes.back().share += one.share;
      }
    }
    return nodes;
  }

 private:
  const Model& model_;
  std::vector<NodeShare> shares_;
};

}  // namespace

GroupSizes group_sizes(const Model& model) {
  const Mesh& mesh = model.mesh;
  GroupSizes sizes;
  sizes.volume_mass.assign(mesh.volume_groups.size(), 0.0);
  sizes.surface_area.assign(mesh.surface_groups.size(), 0.0);
  sizes.node_group_mass.assign(mesh.node_groups.size() + mesh.element_sets.size(), 0.0);
  for (Index e = 0; e < mesh.num_elements(); ++e) sizes.volume_mass[at(mesh.element_group[at(e)])] += mass_of(model, e);
  for (std::size_t s = 0; s < mesh.surface_groups.size(); ++s) {
    for (const Topology::Face& face : model.topology.surface_groups[s]) sizes.surface_area[s] += area_of(mesh, face);
  }
  for_each_tag(model, [&](Index e, const CornerTag& tag) {
    const auto group = static_cast<std::ptrdiff_t>(tag.group) - std::ssize(mesh.surface_groups);
    if (group < 0) return;  // of a surface
    sizes.node_group_mass[static_cast<std::size_t>(group)] += 0.25 * std::popcount(tag.corners) * mass_of(model, e);
  });
  return sizes;
}

NodalLoad nodal_load(const case_::Force& force, const Model& model) {
  const Mesh& mesh = model.mesh;
  const GroupSizes& sizes = model.whole.group_sizes;
  Shares shares(model);
  const auto add_corners = [&](Index element, unsigned corners, double mass) {
    const double share = 0.25 * mass_of(model, element) / mass;
    for (int c = 0; c < 4; ++c) {
      if ((corners >> c & 1U) != 0) shares.add(element, c, share);
    }
  };
  const Index volume = group_index(mesh.volume_groups, force.group);
  const Index surface = group_index(mesh.surface_groups, force.group);
  if (volume >= 0) {
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      if (mesh.element_group[at(e)] == volume) add_corners(e, 15U, sizes.volume_mass[at(volume)]);
    }
  } else if (surface >= 0) {
    std::vector<Topology::Face> faces = model.topology.surface_groups[at(surface)];
    std::sort(faces.begin(), faces.end(), [](const Topology::Face& a, const Topology::Face& b) {
      return std::pair(a.element, a.face) < std::pair(b.element, b.face);
    });
    for (const Topology::Face& face : faces) {
      const double share = area_of(mesh, face) / (3 * sizes.surface_area[at(surface)]);
      for (const int corner : kFaceCorners[at(face.face)]) shares.add(face.element, corner, share);
    }
  } else {
    const Index group = corner_group(mesh, force.group);
    const double mass = sizes.node_group_mass[at(group) - mesh.surface_groups.size()];
    for_each_tag(model, [&](Index e, const CornerTag& tag) {
      if (tag.group == group) add_corners(e, tag.corners, mass);
    });
  }
  return {shares.take(), force.value};
}

}  // namespace breccia
