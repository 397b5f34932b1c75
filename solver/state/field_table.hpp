#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "base/types.hpp"
#include "physics/contact/history.hpp"
#include "physics/joint_history.hpp"

namespace breccia {

/// How a field of the model becomes whole from what the ranks hold of it.
enum class AcrossRanks {
  alike,    ///< the same on all of them
  sum,      ///< each holds a part of a sum
  largest,  ///< the largest counts
  list      ///< each holds a part of a list
};

/// What a field takes part in beside travelling with its element, which all fields do.
struct FieldUse {
  bool hashed = true;  ///< in the state hash. Not: what belongs to the mesh, and what depends on the number of ranks
  AcrossRanks across = AcrossRanks::alike;  ///< of the model
  bool kept = true;                         ///< in checkpoints. Not: requests between ranks, valid for a step or two
};
inline constexpr FieldUse kState{}, kNotHashed{.hashed = false}, kPassing{.hashed = false, .kept = false};
inline constexpr FieldUse kSummed{.across = AcrossRanks::sum}, kSumNotHashed{false, AcrossRanks::sum};
inline constexpr FieldUse kLargest{false, AcrossRanks::largest}, kList{false, AcrossRanks::list};

/// One row of the table of fields: a number, vector or array of a record.
/// @tparam Access  function object that returns a reference to the field of a record, const if the record is
template <class Access>
struct FieldRow {
  const char* name;  ///< unique within its record
  const char* unit;  ///< SI, "1" without one
  FieldUse use;
  Access access;
};
template <class Access>
FieldRow(const char*, const char*, FieldUse, Access) -> FieldRow<Access>;

/// The rows of a record: specialised beside every record, `static constexpr auto rows = std::tuple{FieldRow{...},
/// ...}`.
template <class Record>
struct FieldTable;

/// Calls visit(row, field) for every field of a record, in the order of the table.
template <class Record, class Visit>
inline void for_each_field(Record& record, Visit&& visit) {
  std::apply([&](const auto&... row) { (visit(row, row.access(record)), ...); },
             FieldTable<std::remove_const_t<Record>>::rows);
}

/// Calls f(scalar) for every number of a field: components, elements of arrays, members of a history in the order of
/// its list. Scalars are doubles, integers, bools and enumerations.
template <class T, class F>
inline void for_each_scalar(T& field, F&& f) {
  using Plain = std::remove_const_t<T>;
  if constexpr (std::is_arithmetic_v<Plain> || std::is_enum_v<Plain>) {
    f(field);
  } else if constexpr (std::is_same_v<Plain, Vec3>) {
    for (Eigen::Index i = 0; i < 3; ++i) f(field[i]);
  } else if constexpr (std::is_same_v<Plain, JointHistory<double>>) {
    const auto number = [&](const JointNumber&, auto& value) { f(value); };
    for (auto& point : field.points) for_each_number(number, point);
    for_each_common_number(number, field);
  } else if constexpr (std::is_same_v<Plain, PairHistory<double>>) {
    for_each_pair_number([&](const PairNumber&, auto& value) { f(value); }, field);
  } else {
    for (auto& entry : field) for_each_scalar(entry, f);
  }
}

/// Bytes of a scalar outside memory: enumerations and bools as their underlying integers.
template <class Scalar>
[[nodiscard]] constexpr std::size_t scalar_bytes() {
  return std::is_same_v<Scalar, bool> ? 1 : sizeof(Scalar);
}

/// Bytes of all the fields of a record outside memory.
template <class Record>
[[nodiscard]] std::size_t packed_bytes() {
  std::size_t bytes = 0;
  const Record record{};
  for_each_field(record, [&](const auto&, const auto& field) {
    for_each_scalar(field, [&](const auto& scalar) { bytes += scalar_bytes<std::remove_cvref_t<decltype(scalar)>>(); });
  });
  return bytes;
}

}  // namespace breccia
