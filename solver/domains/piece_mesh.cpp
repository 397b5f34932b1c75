#include "domains/piece_mesh.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "state/packed_bytes.hpp"

namespace breccia {

std::vector<std::byte> pack(const WholeModel& whole) {
  PackedBytes bytes;
  for (const std::int64_t count : {whole.num_elements, whole.num_joints}) bytes.put(count);
  for (const double number :
       {whole.contactor_size, whole.longest_edge, whole.lower_side, whole.energy_floor, whole.step_ratio})
    bytes.put(number);
  bytes.put(static_cast<std::uint64_t>(whole.joint_groups.size()));
  for (const WholeModel::JointGroups& groups : whole.joint_groups) {
    bytes.put(groups.a);
    bytes.put(groups.b);
    bytes.put(groups.size);
    bytes.put(groups.least_class);
    bytes.put(groups.num_classes);
  }
  bytes.put_list(whole.node_sets);
  const GroupSizes& sizes = whole.group_sizes;
  for (const auto* list : {&sizes.volume_mass, &sizes.surface_area, &sizes.node_group_mass}) bytes.put_list(*list);
  bytes.put_list(whole.body_length);
  bytes.put_list(whole.body_extent);
  bytes.put(static_cast<std::uint64_t>(whole.motion_centres.size()));
  for (const std::vector<Vec3>& centres : whole.motion_centres) {
    bytes.put(static_cast<std::uint64_t>(centres.size()));
    for (const Vec3& centre : centres) {
      for (const double x : centre) bytes.put(x);
    }
  }
  bytes.put_text(whole.source);
  for (const auto* names :
       {&whole.volume_groups, &whole.surface_groups, &whole.node_groups, &whole.element_sets, &whole.cut}) {
    bytes.put(static_cast<std::uint64_t>(names->size()));
    for (const std::string& name : *names) bytes.put_text(name);
  }
  return bytes.take();
}

WholeModel unpack_whole(std::span<const std::byte> packed) {
  PackedReader bytes(packed);
  WholeModel whole;
  for (std::int64_t* count : {&whole.num_elements, &whole.num_joints}) *count = bytes.take<std::int64_t>();
  for (double* number :
       {&whole.contactor_size, &whole.longest_edge, &whole.lower_side, &whole.energy_floor, &whole.step_ratio})
    *number = bytes.take<double>();
  for (auto left = bytes.take<std::uint64_t>(); left > 0; --left) {
    WholeModel::JointGroups& groups = whole.joint_groups.emplace_back();
    groups.a = bytes.take<Index>();
    groups.b = bytes.take<Index>();
    groups.size = bytes.take<double>();
    groups.least_class = bytes.take<Index>();
    groups.num_classes = bytes.take<Index>();
  }
  whole.node_sets = bytes.take_list<Index>();
  GroupSizes& sizes = whole.group_sizes;
  for (auto* list : {&sizes.volume_mass, &sizes.surface_area, &sizes.node_group_mass})
    *list = bytes.take_list<double>();
  whole.body_length = bytes.take_list<double>();
  whole.body_extent = bytes.take_list<double>();
  DEMAND(whole.body_extent.size() == whole.body_length.size(), "two numbers of bodies");
  const auto lists = bytes.take<std::uint64_t>();
  DEMAND(lists <= bytes.left(), "lists of centres beyond the end");
  whole.motion_centres.resize(lists);
  for (std::vector<Vec3>& centres : whole.motion_centres) {
    for (auto left = bytes.take<std::uint64_t>(); left > 0; --left) {
      Vec3& centre = centres.emplace_back();
      for (double& x : centre) x = bytes.take<double>();
    }
  }
  whole.source = bytes.take_text();
  for (auto* names :
       {&whole.volume_groups, &whole.surface_groups, &whole.node_groups, &whole.element_sets, &whole.cut}) {
    for (auto left = bytes.take<std::uint64_t>(); left > 0; --left) names->push_back(bytes.take_text());
  }
  DEMAND(sizes.volume_mass.size() == whole.volume_groups.size() &&
             sizes.surface_area.size() == whole.surface_groups.size() &&
             sizes.node_group_mass.size() == whole.node_groups.size() + whole.element_sets.size(),
         "sizes of other groups");
  DEMAND(bytes.left() == 0, std::to_string(bytes.left()) + " bytes too many");
  return whole;
}

namespace {

/// Places of ascending ids: by a table where it is not much longer than the list, else by bisection.
class PlaceTable {
 public:
  explicit PlaceTable(const std::vector<GlobalId>& ids) : ids_(ids) {
    if (ids.empty() || ids.back() - ids.front() >= kSparse * static_cast<GlobalId>(ids.size())) return;
    table_.assign(static_cast<std::size_t>(ids.back() - ids.front()) + 1, -1);
    for (std::size_t i = 0; i < ids.size(); ++i)
      table_[static_cast<std::size_t>(ids[i] - ids.front())] = static_cast<Index>(i);
  }
  /// -1: not there
  [[nodiscard]] Index operator()(GlobalId id) const {
    if (ids_.empty() || id < ids_.front() || id > ids_.back()) return -1;
    if (!table_.empty()) return table_[static_cast<std::size_t>(id - ids_.front())];
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
    return *found == id ? static_cast<Index>(found - ids_.begin()) : -1;
  }

 private:
  static constexpr GlobalId kSparse = 64;
  const std::vector<GlobalId>& ids_;
  std::vector<Index> table_;
};

/// All mesh nodes of the records, ascending.
std::vector<GlobalId> nodes_of(const Records& records) {
  std::vector<GlobalId> ids;
  ids.reserve(4 * records.elements.size());
  for (const ElementRecord& r : records.elements) ids.insert(ids.end(), r.vertex.begin(), r.vertex.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

Mesh mesh_of(const Records& records, const WholeModel& whole) {
  Mesh mesh;
  mesh.source = whole.source;
  mesh.volume_groups = whole.volume_groups;
  mesh.surface_groups = whole.surface_groups;
  mesh.node_groups = whole.node_groups;
  mesh.element_sets = whole.element_sets;
  mesh.num_bodies = static_cast<Index>(whole.body_length.size());
  mesh.node_ids = nodes_of(records);
  mesh.nodes.resize(mesh.node_ids.size());
  const PlaceTable place(mesh.node_ids);
  for (const ElementRecord& r : records.elements) {
    std::array<Index, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c) {
      corners[c] = place(r.vertex[c]);
      mesh.nodes[static_cast<std::size_t>(corners[c])] = Vec3(r.reference[c][0], r.reference[c][1], r.reference[c][2]);
    }
    mesh.elements.push_back(corners);
    mesh.element_ids.push_back(r.id);
    mesh.element_group.push_back(r.group);
    mesh.element_body.push_back(r.body);
    mesh.element_source_id.push_back(r.source_id);
  }
  return mesh;
}

Topology topology_of(const Records& records, const Mesh& mesh) {
  Topology topology;
  topology.links.resize(records.elements.size());
  const PlaceTable place(mesh.element_ids);
  for (std::size_t e = 0; e < records.elements.size(); ++e) {
    const ElementRecord& r = records.elements[e];
    for (std::size_t f = 0; f < 4; ++f) {
      if (r.neighbour[f] < 0) continue;
      const Index neighbour = place(r.neighbour[f]);
      topology.links[e][f] = {neighbour >= 0 ? neighbour : FaceLink::kBeyond, r.code[f]};
      if (neighbour < 0) topology.beyond.push_back({{static_cast<Index>(e), static_cast<int>(f)}, r.neighbour[f]});
    }
  }
  topology.surface_groups.resize(mesh.surface_groups.size());
  for (const FaceTag& tag : records.faces) {
    topology.surface_groups[static_cast<std::size_t>(tag.group)].push_back({place(tag.element), tag.face});
  }
  return topology;
}

}  // namespace breccia
