#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace breccia::detection {

/// Sorts records that are made on the fly by the digits of their keys, the least significant digit first.
///
/// One reading of the input counts every digit of every record, so a digit that is the same for all costs no pass; the
/// first pass writes the records where their lowest digit puts them. O(passes (n + 2^digit_bits)); two arrays of
/// records and the counters are kept from call to call.
template <class Record>
class RadixSort {
 public:
  /// Digits wide enough for few passes, yet with buckets that stay in the first cache, and not more than there are
  /// records.
  static int widest_digit(std::size_t num_records) {
    return std::clamp(static_cast<int>(std::bit_width(num_records)), 4, 11);
  }

  /// The sorted records, valid until the next call; records with equal digits keep the order in which they were made.
  /// @param make(i)              record i; called twice for each i
  /// @param digit(record, pass)  a number below 2^digit_bits
  /// @param padding              writable records behind the sorted ones
  /// @pre num_passes > 0, num_records < 2^32. Throws std::bad_alloc.
  template <class Make, class Digit>
  std::span<Record> sort(std::size_t num_records, int num_passes, int digit_bits, Make make, Digit digit,
                         std::size_t padding);

  [[nodiscard]] std::size_t bytes() const {
    return (sorted_.capacity() + spare_.capacity()) * sizeof(Record) + next_place_.capacity() * sizeof(std::uint32_t);
  }

 private:
  bool to_first_places(std::uint32_t* count, std::size_t num_buckets, std::size_t num_records);

  std::vector<Record> sorted_, spare_;
  std::vector<std::uint32_t> next_place_;  ///< (pass, digit)
};

template <class Record>
template <class Make, class Digit>
std::span<Record> RadixSort<Record>::sort(std::size_t num_records, int num_passes, int digit_bits, Make make,
                                          Digit digit, std::size_t padding) {
  const std::size_t num_buckets = std::size_t{1} << digit_bits;
  const auto passes = static_cast<std::size_t>(num_passes);
  sorted_.resize(num_records + padding);
  spare_.resize(num_records + padding);
  next_place_.assign(passes * num_buckets, 0);
  std::uint32_t* const places = next_place_.data();
  for (std::size_t i = 0; i < num_records; ++i) {
    const Record record = make(i);
    std::uint32_t* count = places;
    for (int pass = 0; pass < num_passes; ++pass, count += num_buckets) ++count[digit(record, pass)];
  }

  to_first_places(places, num_buckets, num_records);
  Record* const made = sorted_.data();
  for (std::size_t i = 0; i < num_records; ++i) {
    const Record record = make(i);
    made[places[digit(record, 0)]++] = record;
  }
  for (int pass = 1; pass < num_passes; ++pass) {
    std::uint32_t* const place = places + static_cast<std::size_t>(pass) * num_buckets;
    if (to_first_places(place, num_buckets, num_records)) continue;
    const Record* const from = sorted_.data();
    Record* const to = spare_.data();
    for (std::size_t i = 0; i < num_records; ++i) to[place[digit(from[i], pass)]++] = from[i];
    std::swap(sorted_, spare_);
  }
  return {sorted_.data(), num_records};
}

/// Turns the counts of a digit into the first place of each bucket; true if all records are in one bucket.
template <class Record>
bool RadixSort<Record>::to_first_places(std::uint32_t* count, std::size_t num_buckets, std::size_t num_records) {
  std::uint32_t sum = 0;
  bool constant = false;
  for (std::size_t bucket = 0; bucket < num_buckets; ++bucket) {
    const std::uint32_t in_bucket = count[bucket];
    constant = constant || in_bucket == num_records;
    count[bucket] = sum;
    sum += in_bucket;
  }
  return constant;
}

}  // namespace breccia::detection
