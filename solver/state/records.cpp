#include "state/records.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <type_traits>

#include "base/error.hpp"
#include "state/packed_bytes.hpp"

namespace breccia {
namespace {

GlobalId key(const ElementRecord& record) { return record.id; }
template <class T>
GlobalId key(const T& record) {
  return record.element;
}

/// Appends a list: its length, then field by field.
template <class T>
void put_list(const std::vector<T>& list, PackedBytes& bytes) {
  bytes.put(static_cast<std::uint64_t>(list.size()));
  bytes.reserve(list.size() * packed_bytes<T>());
  std::apply(
      [&](const auto&... row) {
        const auto put_column = [&](const auto& field_row) {
          for (const T& entry : list) for_each_scalar(field_row.access(entry), [&](const auto& x) { bytes.put(x); });
        };
        (put_column(row), ...);
      },
      FieldTable<T>::rows);
}

template <class T>
void take_list(PackedReader& bytes, std::vector<T>& list) {
  const auto count = bytes.take<std::uint64_t>();
  DEMAND(count <= bytes.left() / packed_bytes<T>(),
         std::to_string(count) + " records in " + std::to_string(bytes.left()) + " bytes");
  const std::size_t before = list.size();
  list.resize(before + count);
  std::apply(
      [&](const auto&... row) {
        const auto take_column = [&](const auto& field_row) {
          for (std::size_t i = before; i < list.size(); ++i)
            for_each_scalar(field_row.access(list[i]), [&](auto& x) { x = bytes.take<std::decay_t<decltype(x)>>(); });
        };
        (take_column(row), ...);
      },
      FieldTable<T>::rows);
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
  PackedBytes bytes;
  for_each_list(records, [&](const char*, const auto& list) {
    std::decay_t<decltype(list)> chosen;
    if constexpr (std::is_same_v<decltype(chosen), std::vector<ElementRecord>>) {
      chosen.reserve(static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), std::uint8_t{1})));
    }
    for_each_wanted(records.elements, wanted, list, [&](const auto& entry) { chosen.push_back(entry); });
    put_list(chosen, bytes);
  });
  return bytes.take();
}

void keep(Records& records, std::span<const std::uint8_t> wanted) {
  DEMAND(wanted.size() == records.elements.size(), std::to_string(wanted.size()) + " marks");
  std::vector<ElementRecord> elements;
  elements.swap(records.elements);  // the others are identified by it
  for_each_list(records, [&](const char*, auto& list) { erase_unwanted(elements, wanted, list); });
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
  PackedReader reader(bytes);
  for_each_list(records, [&](const char*, auto& list) { take_list(reader, list); });
  DEMAND(reader.left() == 0, std::to_string(reader.left()) + " bytes left");
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
  std::apply([&](const auto&... row) { (merge_list(records.*row.second, arrivals.*row.second), ...); }, kRecordLists);
}

}  // namespace breccia
