#include "mesh/set_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {

Index group_of(std::vector<std::string>& names, const std::string& name) {
  const Index known = group_index(names, name);
  if (known >= 0) return known;
  names.push_back(name);
  return static_cast<Index>(names.size()) - 1;
}

class Builder {
 public:
  Builder(const SetMesh& given, const std::filesystem::path& file, double scale) : given_(given) {
    mesh_.source = file.string();
    for (const Vec3& x : given.nodes) mesh_.nodes.push_back(scale * x);
  }

  RawMesh build() {
    const std::vector<Index> group = volume_groups();
    std::vector<Index> elements;
    for (std::size_t e = 0; e < group.size(); ++e)
      if (group[e] >= 0) elements.push_back(static_cast<Index>(e));
    add_bodies(elements, group);
    for (const SetMesh::Set& set : given_.sets) add_parts(set);
    RawMesh raw;
    raw.notes = given_.notes;
    if (given_.higher_order) raw.notes.emplace_back(kHigherOrderNote);
    drop_unused_nodes();
    raw.mesh = std::move(mesh_);
    return raw;
  }

 private:
  [[nodiscard]] bool is_tetrahedron(Index e) const { return given_.elements[at(e)].corners == 4; }

  /// Sets whose tetrahedra are those of a set behind them, which is the one that a person has named.
  [[nodiscard]] std::set<const SetMesh::Set*> sets_named_later() const {
    std::map<std::vector<Index>, const SetMesh::Set*> last;
    std::set<const SetMesh::Set*> earlier;
    for (const bool material : {false, true})  // one with a material is the last
      for (const SetMesh::Set& set : given_.sets) {
        if (set.material != material) continue;
        std::vector<Index> tetrahedra;
        for (const Index e : set.elements)
          if (is_tetrahedron(e)) tetrahedra.push_back(e);
        std::sort(tetrahedra.begin(), tetrahedra.end());
        tetrahedra.erase(std::unique(tetrahedra.begin(), tetrahedra.end()), tetrahedra.end());
        const SetMesh::Set*& known = last[tetrahedra];
        if (known != nullptr && !tetrahedra.empty()) earlier.insert(known);
        known = &set;
      }
    return earlier;
  }

  /// Group of each element; -1: it is no tetrahedron.
  std::vector<Index> volume_groups() {
    std::vector<Index> group(given_.elements.size(), -1);
    const std::set<const SetMesh::Set*> named_later = sets_named_later();
    for (const bool material : {true, false})
      for (const SetMesh::Set& set : given_.sets) {
        if (set.material != material) continue;
        const auto is_taken = [&](Index e) { return is_tetrahedron(e) && group[at(e)] >= 0; };
        const bool has_any =
            std::any_of(set.elements.begin(), set.elements.end(), [&](Index e) { return is_tetrahedron(e); });
        if (!has_any) continue;
        if (named_later.count(&set) != 0 || std::any_of(set.elements.begin(), set.elements.end(), is_taken)) {
          overlapping_.push_back(&set);
          continue;
        }
        const Index g = group_of(mesh_.volume_groups, set.name);
        for (const Index e : set.elements)
          if (is_tetrahedron(e)) group[at(e)] = g;
      }
    Index rest = -1;
    for (std::size_t e = 0; e < group.size(); ++e) {
      if (group[e] >= 0 || !is_tetrahedron(static_cast<Index>(e))) continue;
      if (rest < 0) rest = group_of(mesh_.volume_groups, mesh_.volume_groups.empty() ? "volume_1" : "rest");
      group[e] = rest;
    }
    return group;
  }

  /// Bodies: tetrahedra of a group that hang together through nodes.
  void add_bodies(const std::vector<Index>& elements, const std::vector<Index>& group) {
    DisjointSets parts(elements.size());
    std::map<std::pair<Index, Index>, Index> first;  // by group and node
    for (std::size_t i = 0; i < elements.size(); ++i)
      for (const Index node : given_.elements[at(elements[i])].nodes) {
        const auto [entry, fresh] = first.emplace(std::pair{group[at(elements[i])], node}, static_cast<Index>(i));
        if (!fresh) parts.join(entry->second, static_cast<Index>(i));
      }
    std::map<Index, Index> body;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const SetMesh::Element& element = given_.elements[at(elements[i])];
      const auto [entry, fresh] = body.emplace(parts.root(static_cast<Index>(i)), mesh_.num_bodies);
      if (fresh) ++mesh_.num_bodies;
      mesh_.elements.push_back(element.nodes);
      mesh_.element_group.push_back(group[at(elements[i])]);
      mesh_.element_body.push_back(entry->second);
      mesh_.element_source_id.push_back(element.label);
    }
  }

  /// Surface and node groups of a set.
  void add_parts(const SetMesh::Set& set) {
    const auto add_face = [&](const std::array<Index, 3>& nodes) {
      mesh_.surface_faces.push_back({nodes, group_of(mesh_.surface_groups, set.name)});
    };
    const auto add_node = [&](Index node) {
      mesh_.group_nodes.push_back({node, group_of(mesh_.node_groups, set.name)});
    };
    const bool overlaps = std::find(overlapping_.begin(), overlapping_.end(), &set) != overlapping_.end();
    for (const Index e : set.elements) {
      const SetMesh::Element& element = given_.elements[at(e)];
      if (element.corners == 3) add_face({element.nodes[0], element.nodes[1], element.nodes[2]});
      if (element.corners == 2 || (element.corners == 4 && overlaps))
        std::for_each_n(element.nodes.begin(), element.corners, add_node);
    }
    std::for_each(set.faces.begin(), set.faces.end(), add_face);
    std::for_each(set.nodes.begin(), set.nodes.end(), add_node);
  }

  /// Nodes between corners, of elements that are left out, and of none.
  void drop_unused_nodes() {
    std::vector<Index> new_of(mesh_.nodes.size(), -1);
    const auto keep = [&](Index n) { new_of[at(n)] = 0; };
    for (const auto& corners : mesh_.elements) std::for_each(corners.begin(), corners.end(), keep);
    for (const auto& face : mesh_.surface_faces) std::for_each(face.nodes.begin(), face.nodes.end(), keep);
    Index kept = 0;
    for (std::size_t n = 0; n < new_of.size(); ++n) {
      if (new_of[n] < 0) continue;
      mesh_.nodes[at(kept)] = mesh_.nodes[n];
      new_of[n] = kept++;
    }
    mesh_.nodes.resize(at(kept));
    const auto renumber = [&](Index& n) { n = new_of[at(n)]; };
    for (auto& corners : mesh_.elements) std::for_each(corners.begin(), corners.end(), renumber);
    for (auto& face : mesh_.surface_faces) std::for_each(face.nodes.begin(), face.nodes.end(), renumber);
    for (Mesh::GroupNode& one : mesh_.group_nodes) renumber(one.node);
    std::erase_if(mesh_.group_nodes, [](const Mesh::GroupNode& one) { return one.node < 0; });
  }

  const SetMesh& given_;
  Mesh mesh_;
  std::vector<const SetMesh::Set*> overlapping_;  ///< sets whose tetrahedra are in groups before them
};

}  // namespace

RawMesh raw_mesh(const SetMesh& mesh, const std::filesystem::path& file, double scale) {
  return Builder(mesh, file, scale).build();
}

}  // namespace breccia
