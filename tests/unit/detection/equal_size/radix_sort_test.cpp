#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "detection/equal_size/radix_sort.hpp"

namespace breccia::detection::radix_sort_test {
namespace {

struct Record {
  std::uint32_t key;
  std::uint32_t number;
  bool operator==(const Record&) const = default;
};

constexpr int digit_bits = 5;

std::vector<Record> sorted_by_radix(RadixSort<Record>& sort, const std::vector<std::uint32_t>& keys, int num_passes) {
  const auto make = [&](std::size_t i) { return Record{keys[i], static_cast<std::uint32_t>(i)}; };
  const auto digit = [](const Record& record, int pass) {
    return static_cast<std::size_t>(record.key >> (pass * digit_bits) & ((1U << digit_bits) - 1));
  };
  const auto sorted = sort.sort(keys.size(), num_passes, digit_bits, make, digit, 3);
  return {sorted.begin(), sorted.end()};
}

std::vector<Record> stably_sorted(const std::vector<std::uint32_t>& keys) {
  std::vector<Record> records;
  for (const std::uint32_t key : keys) records.push_back({key, static_cast<std::uint32_t>(records.size())});
  std::stable_sort(records.begin(), records.end(), [](const Record& a, const Record& b) { return a.key < b.key; });
  return records;
}

TEST(RadixSort, SortsAndKeepsTheOrderOfEqualKeys) {
  RadixSort<Record> sort;
  std::mt19937 random(3);
  for (const std::size_t n : {5000U, 0U, 1U, 2U, 400U}) {
    for (const int num_passes : {1, 2, 5}) {
      std::uniform_int_distribution<std::uint32_t> any(0, (1U << (num_passes * digit_bits)) - 1);
      std::vector<std::uint32_t> keys(n);
      for (std::uint32_t& key : keys) key = any(random);
      EXPECT_EQ(sorted_by_radix(sort, keys, num_passes), stably_sorted(keys)) << n << " records, passes " << num_passes;
    }
  }
}

TEST(RadixSort, SortsWhenSomeDigitsAreTheSameForAll) {
  RadixSort<Record> sort;
  std::mt19937 random(4);
  for (const std::uint32_t varying : {0U, 0x1FU, 0x3E0U, 0x7C00U, 0x7C1FU, 0x7FE0U}) {
    std::vector<std::uint32_t> keys(300);
    for (std::uint32_t& key : keys) key = (static_cast<std::uint32_t>(random()) & varying) | (0x2D6BU & ~varying);
    EXPECT_EQ(sorted_by_radix(sort, keys, 3), stably_sorted(keys)) << "bits that vary: " << varying;
  }
}

}  // namespace
}  // namespace breccia::detection::radix_sort_test
