#include "mesh/gmsh/model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "mesh/material_groups.hpp"

namespace breccia {
namespace {

constexpr std::array<const char*, 4> kKinds{"point", "curve", "surface", "volume"};  // by dimension

class ModelReader {
 public:
  ModelReader(const std::filesystem::path& file, double scale, const std::vector<std::string>& materials)
      : scale_(scale), materials_(materials) {
    mesh_.source = file.string();
  }

  RawMesh read() {
    RawMesh raw;
    read_nodes();
    read_volumes(raw.ungrouped_elements);
    read_surfaces();
    read_node_groups();
    if (!problems_.empty()) throw InputError(std::move(problems_));
    if (order_ > 1) drop_mid_side_nodes(raw.notes);
    raw.mesh = std::move(mesh_);
    return raw;
  }

 private:
  void refuse(const std::string& entity, const std::string& what, const std::string& allowed,
              const std::string& given) {
    problems_.push_back({mesh_.source, 0, entity, what, allowed, given});
  }

  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused);
    node_of_tag_.reserve(tags.size());
    mesh_.nodes.reserve(tags.size());
    for (std::size_t n = 0; n < tags.size(); ++n) {
      const double* x = &coordinates[3 * n];
      const Vec3 place = scale_ * Vec3(x[0], x[1], x[2]);
      const auto [entry, fresh] = node_of_tag_.emplace(tags[n], mesh_.num_nodes());
      if (fresh) {
        mesh_.nodes.push_back(place);
      } else if (mesh_.nodes[static_cast<std::size_t>(entry->second)] != place && problems_.empty()) {
        refuse("node " + std::to_string(tags[n]), "stands twice, at different places",
               "a number of its own for each node", "");
      }
    }
  }

  /// Whether an entity lies between partitions of an entity of a higher dimension, whose physical group gmsh gives it.
  static bool parts_partitions(int dimension, int entity) {
    int parent_dimension = -1, parent = -1;
    gmsh::model::getParent(dimension, entity, parent_dimension, parent);
    return parent_dimension > dimension;
  }

  /// Physical groups of a dimension as (name, entities), by ascending tag; names of volumes and surfaces are unique.
  std::vector<std::pair<std::string, std::vector<int>>> physical_groups(int dimension) {
    const std::string kind = kKinds[static_cast<std::size_t>(dimension)];
    gmsh::vectorpair tags;
    gmsh::model::getPhysicalGroups(tags, dimension);
    std::sort(tags.begin(), tags.end());
    std::vector<std::pair<std::string, std::vector<int>>> groups;
    std::map<std::string, int> tag_of_name;
    for (const auto& [unused, tag] : tags) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      if (name.empty()) name = kind + "_" + std::to_string(tag);
      const auto [entry, fresh] = tag_of_name.emplace(name, tag);
      if (!fresh && dimension >= 2) {
        refuse("physical " + kind + " \"" + name + "\"", "the name is used twice", "one name a group",
               "tags " + std::to_string(entry->second) + " and " + std::to_string(tag));
      }
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
      if (std::erase_if(entities, [&](int entity) { return parts_partitions(dimension, entity); }) > 0 &&
          entities.empty())
        continue;
      groups.emplace_back(std::move(name), std::move(entities));
    }
    return groups;
  }

  /// Groups of every volume with elements that lies in one; without physical volumes each volume is a group.
  /// @param volumes  (undivided volume, volume), ascending
  MaterialGroups groups_of_volumes(const gmsh::vectorpair& volumes) {
    PhysicalVolumes physical;
    const auto groups = physical_groups(3);
    std::map<int, std::vector<Index>> groups_of;
    for (const auto& [name, entities] : groups) {
      const auto group = static_cast<Index>(physical.names.size());
      physical.names.push_back(name);
      for (const int volume : entities) groups_of[volume].push_back(group);
    }
    int named = 0;  // tags are positive
    for (const auto& [whole, volume] : volumes) {
      if (groups.empty()) {
        if (whole != named) physical.names.push_back("volume_" + std::to_string(whole));
        named = whole;
        physical.of_volume[volume] = {static_cast<Index>(physical.names.size() - 1)};
      } else if (const auto own = groups_of.find(volume); own != groups_of.end()) {
        physical.of_volume[volume] = own->second;
      }
    }
    MaterialGroups chosen = material_groups(physical, materials_, mesh_.source, problems_);
    mesh_.volume_groups = chosen.volume_groups;
    mesh_.element_sets = chosen.element_sets;
    return chosen;
  }

  /// The volume that gmsh has divided into this one among others (Mesh > Partition); itself where it has not.
  static int undivided(int volume) {
    for (int dimension = 3, parent = volume; dimension == 3 && parent > 0;) {
      volume = parent;
      gmsh::model::getParent(3, volume, dimension, parent);
    }
    return volume;
  }

  /// A mesh that gmsh has written in a file for each partition is whole in none of them: entities at the border name
  /// partitions whose elements are not there.
  void refuse_missing_partitions() {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    const auto partitions_of = [](const std::pair<int, int>& entity) {
      std::vector<int> own;
      gmsh::model::getPartitions(entity.first, entity.second, own);
      return own;
    };
    std::set<int> named, present;
    for (const auto& entity : entities) {
      const std::vector<int> own = partitions_of(entity);
      named.insert(own.begin(), own.end());
    }
    for (const auto& entity : entities) {
      std::vector<int> types;
      if (!named.empty() && entity.first == 3) gmsh::model::mesh::getElementTypes(types, 3, entity.second);
      if (types.empty()) continue;
      const std::vector<int> own = partitions_of(entity);
      present.insert(own.begin(), own.end());
    }
    if (present.empty() || present == named) return;
    refuse("mesh.file", "holds some partitions of a mesh only",
           "the whole mesh in one file (Mesh.PartitionSplitMeshFiles = 0)",
           std::to_string(present.size()) + " of " + std::to_string(named.size()) + " partitions or more");
  }

  void read_volumes(Index& ungrouped_elements) {
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (auto& [whole, volume] : volumes) whole = undivided(volume);
    std::sort(volumes.begin(), volumes.end());
    refuse_missing_partitions();
    MaterialGroups groups = groups_of_volumes(volumes);
    int before = 0;  // the volume that the last body is of; tags are positive
    for (const auto& [whole, volume] : volumes) {
      const auto group = groups.group_of.find(volume);
      const auto elements = elements_of(3, volume, group != groups.group_of.end());
      if (group == groups.group_of.end()) {
        ungrouped_elements += static_cast<Index>(elements.tags.size());
        continue;
      }
      if (elements.tags.empty()) continue;
      if (before != whole) ++mesh_.num_bodies;
      before = whole;
      const Index body = mesh_.num_bodies - 1;
      const std::vector<Index>& sets = groups.sets_of[volume];
      std::set<std::array<Index, 4>> known;
      for (std::size_t e = 0; e < elements.tags.size(); ++e) {
        std::array<Index, 4> corners{};
        for (std::size_t c = 0; c < 4; ++c) corners[c] = node(elements.nodes[4 * e + c]);
        if (!sets.empty() && !known.insert(corners).second) continue;  // format 2.2 has it once for each of its groups
        for (const Index set : sets) mesh_.set_elements.push_back({mesh_.num_elements(), set});
        mesh_.elements.push_back(corners);
        mesh_.element_group.push_back(group->second);
        mesh_.element_body.push_back(body);
        mesh_.element_source_id.push_back(static_cast<std::int64_t>(elements.tags[e]));
      }
    }
  }

  void read_surfaces() {
    for (const auto& [name, entities] : physical_groups(2)) {
      const auto group = static_cast<Index>(mesh_.surface_groups.size());
      mesh_.surface_groups.push_back(name);
      for (const int surface : entities) {
        const auto triangles = elements_of(2, surface, true);
        for (std::size_t t = 0; t < triangles.tags.size(); ++t) {
          Mesh::SurfaceFace face{{}, group};
          for (std::size_t c = 0; c < 3; ++c) face.nodes[c] = node(triangles.nodes[3 * t + c]);
          mesh_.surface_faces.push_back(face);
        }
      }
    }
  }

  /// Physical curves and points: the nodes of their elements.
  void read_node_groups() {
    for (const int dimension : {1, 0}) {
      for (const auto& [name, entities] : physical_groups(dimension)) {
        Index group = group_index(mesh_.node_groups, name);  // a point and a curve of one name are one group
        if (group < 0) {
          group = static_cast<Index>(mesh_.node_groups.size());
          mesh_.node_groups.push_back(name);
        }
        for (const int entity : entities) {
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
          for (const std::vector<std::size_t>& of_type : nodes) {
            for (const std::size_t tag : of_type) mesh_.group_nodes.push_back({node(tag), group});
          }
        }
      }
    }
  }

  struct Elements {
    std::vector<std::size_t> tags, nodes;
  };

  /// Corners of the tetrahedra of a volume, or of the triangles of a surface. Other shapes are refused where `strict`.
  Elements elements_of(int dimension, int entity, bool strict) {
    const auto corners = static_cast<std::size_t>(dimension) + 1;
    const std::string shape = dimension == 3 ? "Tetrahedron" : "Triangle";
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    Elements wanted;
    for (std::size_t t = 0; t < types.size(); ++t) {
      std::string kind;
      int unused_dimension = 0, order = 0, num_nodes = 0, num_primary = 0;
      std::vector<double> unused;
      gmsh::model::mesh::getElementProperties(types[t], kind, unused_dimension, order, num_nodes, unused, num_primary);
      if (kind.starts_with(shape)) {
        wanted.tags.insert(wanted.tags.end(), tags[t].begin(), tags[t].end());
        add_corners(nodes[t], corners, static_cast<std::size_t>(num_nodes), wanted.nodes);
        if (strict && !tags[t].empty()) order_ = std::max(order_, order);
      } else if (strict && !tags[t].empty()) {
        const std::string name = kKinds[static_cast<std::size_t>(dimension)] + (' ' + std::to_string(entity));
        refuse(name, "holds elements of a kind that is not supported", dimension == 3 ? "tetrahedra" : "triangles",
               std::to_string(tags[t].size()) + " of " + kind);
      }
    }
    return wanted;
  }

  /// The first nodes of each element; the others are those between them.
  void add_corners(const std::vector<std::size_t>& nodes, std::size_t corners, std::size_t num_nodes,
                   std::vector<std::size_t>& into) {
    for (std::size_t first = 0; first + num_nodes <= nodes.size(); first += num_nodes)
      for (std::size_t n = 0; n < num_nodes; ++n) {
        if (n < corners)
          into.push_back(nodes[first + n]);
        else
          mid_side_.insert(nodes[first + n]);
      }
  }

  /// Nodes that only elements of higher order have are no nodes that the mesh has lost.
  void drop_mid_side_nodes(std::vector<std::string>& notes) {
    std::vector<Index> new_of(mesh_.nodes.size(), 0);
    for (const std::size_t tag : mid_side_) new_of[static_cast<std::size_t>(node(tag))] = -1;
    const auto keep = [&](Index n) { new_of[static_cast<std::size_t>(n)] = 0; };
    for (const auto& corners : mesh_.elements) std::for_each(corners.begin(), corners.end(), keep);
    for (const auto& face : mesh_.surface_faces) std::for_each(face.nodes.begin(), face.nodes.end(), keep);
    Index kept = 0;
    for (std::size_t n = 0; n < new_of.size(); ++n) {
      if (new_of[n] < 0) continue;
      mesh_.nodes[static_cast<std::size_t>(kept)] = mesh_.nodes[n];
      new_of[n] = kept++;
    }
    mesh_.nodes.resize(static_cast<std::size_t>(kept));
    const auto renumber = [&](Index& n) { n = new_of[static_cast<std::size_t>(n)]; };
    for (auto& corners : mesh_.elements) std::for_each(corners.begin(), corners.end(), renumber);
    for (auto& face : mesh_.surface_faces) std::for_each(face.nodes.begin(), face.nodes.end(), renumber);
    for (Mesh::GroupNode& one : mesh_.group_nodes) renumber(one.node);
    std::erase_if(mesh_.group_nodes, [](const Mesh::GroupNode& one) { return one.node < 0; });
    notes.push_back(kHigherOrderNote);
  }

  Index node(std::size_t tag) {
    const auto found = node_of_tag_.find(tag);
    if (found == node_of_tag_.end()) {
      throw InputError(Problem{mesh_.source, 0, "mesh", "an element names a node that is not in the file", "",
                               "node " + std::to_string(tag)});
    }
    return found->second;
  }

  double scale_;
  const std::vector<std::string>& materials_;
  Mesh mesh_;
  std::vector<Problem> problems_;
  std::unordered_map<std::size_t, Index> node_of_tag_;
  std::unordered_set<std::size_t> mid_side_;  ///< tags of nodes that some element has between its corners
  int order_ = 1;                             ///< highest of the elements
};

}  // namespace

RawMesh read_gmsh_model(const std::filesystem::path& file, double scale, const std::vector<std::string>& materials) {
  return ModelReader(file, scale, materials).read();
}

}  // namespace breccia
