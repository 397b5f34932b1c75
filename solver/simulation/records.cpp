#include "simulation/records.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace breccia {
namespace {

GlobalId key(const ElementRecord& record) { return record.id; }
template <class T>
GlobalId key(const T& record) {
  return record.element;
}

template <class R, class F>
void for_each_list(R& r, F&& f) {
  f(r.elements);
  f(r.joints);
  f(r.released);
  f(r.couples);
  f(r.ramps);
  f(r.offsets);
  f(r.holds);
  f(r.faces);
  f(r.corners);
}

/// Appends a list behind its length. Records are plain numbers; Eigen's small vectors in them are arrays of doubles that only
/// lack the name of being trivially copyable.
template <class T>
void put(const std::vector<T>& list, std::vector<std::byte>& bytes) {
  static_assert(std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>);
  const std::uint64_t count = list.size();
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof count + count * sizeof(T));
  std::memcpy(bytes.data() + at, &count, sizeof count);
  if (count > 0) std::memcpy(bytes.data() + at + sizeof count, list.data(), count * sizeof(T));
}

template <class T>
std::size_t take(std::span<const std::byte> bytes, std::size_t at, std::vector<T>& list) {
  std::uint64_t count = 0;
  DEMAND(at + sizeof count <= bytes.size(), std::to_string(bytes.size()) + " bytes");
  std::memcpy(&count, bytes.data() + at, sizeof count);
  at += sizeof count;
  DEMAND(count <= (bytes.size() - at) / sizeof(T), std::to_string(count) + " records in " + std::to_string(bytes.size()) + " bytes");
  const std::size_t before = list.size();
  list.resize(before + count);
  if (count > 0) std::memcpy(static_cast<void*>(list.data() + before), bytes.data() + at, count * sizeof(T));
  return at + count * sizeof(T);
}

}  // namespace

Index Records::place_of(GlobalId element) const {
  const auto found = std::lower_bound(elements.begin(), elements.end(), element,
                                      [](const ElementRecord& record, GlobalId id) { return record.id < id; });
  return found != elements.end() && found->id == element ? static_cast<Index>(found - elements.begin()) : -1;
}

std::vector<std::byte> pack(const Records& records, std::span<const std::uint8_t> wanted) {
  DEMAND(wanted.size() == records.elements.size(), std::to_string(wanted.size()) + " marks");
  std::vector<std::byte> bytes;
  for_each_list(records, [&](const auto& list) {
    std::decay_t<decltype(list)> chosen;
    std::size_t place = 0;
    for (const auto& record : list) {
      while (place < records.elements.size() && records.elements[place].id < key(record)) ++place;
      DEMAND(place < records.elements.size() && records.elements[place].id == key(record), "element " + std::to_string(key(record)));
      if (wanted[place] != 0) chosen.push_back(record);
    }
    put(chosen, bytes);
  });
  return bytes;
}

void unpack(std::span<const std::byte> bytes, Records& records) {
  std::size_t at = 0;
  for_each_list(records, [&](auto& list) { at = take(bytes, at, list); });
  DEMAND(at == bytes.size(), std::to_string(bytes.size() - at) + " bytes left");
}

void sort(Records& records) {
  for_each_list(records, [](auto& list) {
    const auto before = [](const auto& a, const auto& b) { return key(a) < key(b); };
    if (!std::is_sorted(list.begin(), list.end(), before)) std::stable_sort(list.begin(), list.end(), before);
  });
}

std::vector<std::byte> pack(const WholeModel& whole) {
  std::vector<std::byte> bytes;
  put(std::vector{whole.num_elements, whole.num_joints}, bytes);
  put(std::vector{whole.contactor_size, whole.lightest_node, whole.longest_edge, whole.energy_floor, whole.step_ratio}, bytes);
  put(whole.joint_groups, bytes);
  put(whole.body_length, bytes);
  put(whole.group_length, bytes);
  put(std::vector<char>(whole.source.begin(), whole.source.end()), bytes);
  for (const auto* names : {&whole.volume_groups, &whole.surface_groups}) {
    put(std::vector{names->size()}, bytes);
    for (const std::string& name : *names) put(std::vector<char>(name.begin(), name.end()), bytes);
  }
  return bytes;
}

WholeModel unpack_whole(std::span<const std::byte> bytes) {
  WholeModel whole;
  std::size_t at = 0;
  const auto text = [&] {
    std::vector<char> letters;
    at = take(bytes, at, letters);
    return std::string(letters.begin(), letters.end());
  };
  std::vector<std::int64_t> counts;
  at = take(bytes, at, counts);
  std::vector<double> numbers;
  at = take(bytes, at, numbers);
  DEMAND(counts.size() == 2 && numbers.size() == 5, std::to_string(counts.size()) + ", " + std::to_string(numbers.size()));
  whole.num_elements = counts[0];
  whole.num_joints = counts[1];
  whole.contactor_size = numbers[0];
  whole.lightest_node = numbers[1];
  whole.longest_edge = numbers[2];
  whole.energy_floor = numbers[3];
  whole.step_ratio = numbers[4];
  at = take(bytes, at, whole.joint_groups);
  at = take(bytes, at, whole.body_length);
  at = take(bytes, at, whole.group_length);
  whole.source = text();
  for (auto* names : {&whole.volume_groups, &whole.surface_groups}) {
    std::vector<std::size_t> count;
    at = take(bytes, at, count);
    for (std::size_t i = 0; i < count.at(0); ++i) names->push_back(text());
  }
  return whole;
}

Mesh mesh_of(const Records& records, const WholeModel& whole) {
  Mesh mesh;
  mesh.source = whole.source;
  mesh.volume_groups = whole.volume_groups;
  mesh.surface_groups = whole.surface_groups;
  mesh.num_bodies = static_cast<Index>(whole.body_length.size());
  for (const ElementRecord& r : records.elements) mesh.node_ids.insert(mesh.node_ids.end(), r.vertex.begin(), r.vertex.end());
  std::sort(mesh.node_ids.begin(), mesh.node_ids.end());
  mesh.node_ids.erase(std::unique(mesh.node_ids.begin(), mesh.node_ids.end()), mesh.node_ids.end());
  mesh.nodes.resize(mesh.node_ids.size());
  for (const ElementRecord& r : records.elements) {
    std::array<Index, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c) {
      const auto found = std::lower_bound(mesh.node_ids.begin(), mesh.node_ids.end(), r.vertex[c]);
      corners[c] = static_cast<Index>(found - mesh.node_ids.begin());
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
  for (std::size_t e = 0; e < records.elements.size(); ++e) {
    const ElementRecord& r = records.elements[e];
    for (std::size_t f = 0; f < 4; ++f) {
      FaceLink& link = topology.links[e][f];
      if (r.neighbour[f] < 0) continue;
      const Index place = records.place_of(r.neighbour[f]);
      link = {place >= 0 ? place : FaceLink::kBeyond, r.code[f]};
    }
  }
  topology.surface_groups.resize(mesh.surface_groups.size());
  for (const FaceTag& tag : records.faces) {
    topology.surface_groups[static_cast<std::size_t>(tag.group)].push_back({records.place_of(tag.element), tag.face});
  }
  return topology;
}

}  // namespace breccia
