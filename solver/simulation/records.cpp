#include "simulation/records.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
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

/// Appends a list behind its length. Records are plain numbers; Eigen's small vectors in them are arrays of doubles
/// that only lack the name of being trivially copyable.
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
  DEMAND(count <= (bytes.size() - at) / sizeof(T),
         std::to_string(count) + " records in " + std::to_string(bytes.size()) + " bytes");
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

namespace {

/// Calls visit(entry) for the entries of a list whose elements are marked.
template <class List, class Visit>
void for_each_wanted(const std::vector<ElementRecord>& elements, std::span<const std::uint8_t> wanted, List& list,
                     Visit&& visit) {
  std::size_t place = 0;
  for (auto& entry : list) {
    while (place < elements.size() && elements[place].id < key(entry)) ++place;
    DEMAND(place < elements.size() && elements[place].id == key(entry), "element " + std::to_string(key(entry)));
    if (wanted[place] != 0) visit(entry);
  }
}

template <class T>
void erase_unwanted(const std::vector<ElementRecord>& elements, std::span<const std::uint8_t> wanted,
                    std::vector<T>& list) {
  std::size_t kept = 0;
  for_each_wanted(elements, wanted, list, [&](T& entry) {
    if (&list[kept] != &entry) list[kept] = entry;
    ++kept;
  });
  list.resize(kept);
}

}  // namespace

std::vector<std::byte> pack(const Records& records, std::span<const std::uint8_t> wanted) {
  DEMAND(wanted.size() == records.elements.size(), std::to_string(wanted.size()) + " marks");
  std::vector<std::byte> bytes;
  for_each_list(records, [&](const auto& list) {
    std::decay_t<decltype(list)> chosen;
    if constexpr (std::is_same_v<decltype(chosen), std::vector<ElementRecord>>) {
      chosen.reserve(static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), std::uint8_t{1})));
    }
    for_each_wanted(records.elements, wanted, list, [&](const auto& entry) { chosen.push_back(entry); });
    put(chosen, bytes);
  });
  return bytes;
}

void keep(Records& records, std::span<const std::uint8_t> wanted) {
  DEMAND(wanted.size() == records.elements.size(), std::to_string(wanted.size()) + " marks");
  std::vector<ElementRecord> elements;
  elements.swap(records.elements);  // the others are told by it
  for_each_list(records, [&](auto& list) { erase_unwanted(elements, wanted, list); });
  std::size_t kept = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (wanted[e] == 0) continue;
    if (kept != e) elements[kept] = elements[e];
    ++kept;
  }
  elements.resize(kept);
  records.elements.swap(elements);
}

void unpack(std::span<const std::byte> bytes, Records& records) {
  std::size_t at = 0;
  for_each_list(records, [&](auto& list) { at = take(bytes, at, list); });
  DEMAND(at == bytes.size(), std::to_string(bytes.size() - at) + " bytes left");
}

namespace {

template <class T>
void merge_list(std::vector<T>& list, std::vector<T>& arrivals) {
  const auto before = [](const T& a, const T& b) { return key(a) < key(b); };
  if (!std::is_sorted(arrivals.begin(), arrivals.end(), before))
    std::stable_sort(arrivals.begin(), arrivals.end(), before);
  if (list.empty()) return list.swap(arrivals);
  if (arrivals.empty()) return;
  std::vector<T> merged;
  merged.reserve(list.size() + arrivals.size());
  std::merge(list.begin(), list.end(), arrivals.begin(), arrivals.end(), std::back_inserter(merged), before);
  list.swap(merged);
}

}  // namespace

void merge(Records& records, Records arrivals) {
  merge_list(records.elements, arrivals.elements);
  merge_list(records.joints, arrivals.joints);
  merge_list(records.released, arrivals.released);
  merge_list(records.couples, arrivals.couples);
  merge_list(records.ramps, arrivals.ramps);
  merge_list(records.offsets, arrivals.offsets);
  merge_list(records.holds, arrivals.holds);
  merge_list(records.faces, arrivals.faces);
  merge_list(records.corners, arrivals.corners);
}

std::vector<std::byte> pack(const WholeModel& whole) {
  std::vector<std::byte> bytes;
  put(std::vector{whole.num_elements, whole.num_joints}, bytes);
  put(std::vector{whole.contactor_size, whole.lightest_node, whole.longest_edge, whole.energy_floor, whole.step_ratio},
      bytes);
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
  DEMAND(counts.size() == 2 && numbers.size() == 5,
         std::to_string(counts.size()) + ", " + std::to_string(numbers.size()));
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
    }
  }
  topology.surface_groups.resize(mesh.surface_groups.size());
  for (const FaceTag& tag : records.faces) {
    topology.surface_groups[static_cast<std::size_t>(tag.group)].push_back({place(tag.element), tag.face});
  }
  return topology;
}

}  // namespace breccia
