#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "state/field_table.hpp"

namespace breccia {

/// 64-bit hash of a sequence of numbers. Depends on every bit and on the order. Not cryptographic.
class SequenceHash {
 public:
  void add(std::uint64_t word) {
    hash_ = (std::rotl(hash_, 27) ^ mixed(word)) * 0x9e3779b97f4a7c15ULL + 0x632be59bd9b4e019ULL;
  }
  /// By bit pattern: 0.0 and -0.0 differ.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }

  [[nodiscard]] std::uint64_t value() const { return mixed(hash_); }

 private:
  /// Two rounds of xor-shift and multiplication: a bijection in which every bit reaches every other.
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
    return x ^ (x >> 32);
  }

  std::uint64_t hash_ = 0x243f6a8885a308d3ULL;
};

/// Hash of the whole state, for "are these two runs the same bits?": the sum of the hashes of its entities, each of
/// which begins with the entity's global id. Independent of the order and of the ranks on which entities are added.
class StateHash {
 public:
  StateHash() = default;
  explicit StateHash(std::uint64_t sum) : sum_(sum) {}

  void add(const SequenceHash& entity) { sum_ += entity.value(); }
  void add(const StateHash& other) { sum_ += other.sum_; }

  [[nodiscard]] std::uint64_t value() const { return sum_; }
  /// 16 lower-case hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t sum_ = 0;
};

/// Hash of a record: every number of its hashed fields, in the order of the table.
template <class Record>
[[nodiscard]] SequenceHash hash_of_record(const Record& record) {
  SequenceHash hash;
  for_each_field(record, [&](const auto& row, const auto& field) {
    if (!row.use.hashed) return;
    for_each_scalar(field, [&](const auto& scalar) {
      if constexpr (std::is_floating_point_v<std::decay_t<decltype(scalar)>>) {
        hash.add(scalar);
      } else {
        hash.add(static_cast<std::uint64_t>(scalar));
      }
    });
  });
  return hash;
}

}  // namespace breccia
