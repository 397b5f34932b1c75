#include <gtest/gtest.h>
#include <bit>
#include <set>

#include "state/records.hpp"
#include "state/state_hash.hpp"

namespace breccia::state_hash_test {
namespace {

TEST(StateHash, IsSixteenHexadecimalDigitsOfItsValue) {
  SequenceHash number;
  number.add(1.5);
  StateHash hash;
  hash.add(number);
  EXPECT_EQ(hash.text().size(), 16U);
  EXPECT_EQ(std::stoull(hash.text(), nullptr, 16), hash.value());
}

/// Flips the last bit of a number, or the truth of a bool.
template <class Scalar>
void change(Scalar& x) {
  if constexpr (std::is_same_v<Scalar, bool>) {
    x = !x;
  } else if constexpr (std::is_same_v<Scalar, double>) {
    x = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ 1);
  } else {
    x = static_cast<Scalar>(static_cast<std::uint64_t>(x) ^ 1);
  }
}

/// Every number of every hashed field of a record counts, and no other.
template <class Record>
void expect_hash_of_all_fields() {
  Record record{};
  const std::uint64_t before = hash_of_record(record).value();
  for_each_field(record, [&](const auto& row, auto& field) {
    for_each_scalar(field, [&](auto& scalar) {
      const auto kept = scalar;
      change(scalar);
      EXPECT_EQ(hash_of_record(record).value() != before, row.use.hashed) << row.name;
      scalar = kept;
    });
  });
  EXPECT_EQ(hash_of_record(record).value(), before);
}

TEST(StateHash, OfAnElementChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<ElementRecord>(); }
TEST(StateHash, OfAJointChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<JointRecord>(); }
TEST(StateHash, OfAReleasedJointChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<ReleasedRecord>(); }
TEST(StateHash, OfACoupleChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<CoupleRecord>(); }
TEST(StateHash, OfAnOffsetChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<OffsetRecord>(); }
TEST(StateHash, OfAHoldChangesWithTheLastBitOfAnyField) { expect_hash_of_all_fields<HoldRecord>(); }

TEST(SequenceHash, DependsOnTheOrderAndCountOfNumbers) {
  const auto of = [](std::vector<double> values) {
    SequenceHash hash;
    hash.add(values);
    return hash.value();
  };
  EXPECT_NE(of({1, 2}), of({2, 1}));
  EXPECT_NE(of({0}), of({0, 0}));
  EXPECT_NE(of({0.0}), of({-0.0}));
  EXPECT_EQ(of({1, 2}), of({1, 2}));
}

TEST(SequenceHash, SpreadsASingleBitOverHalfOfThem) {
  double flipped = 0;
  std::set<std::uint64_t> seen;
  const auto of = [](std::uint64_t word) {
    SequenceHash hash;
    hash.add(word);
    hash.add(std::uint64_t{77});
    return hash.value();
  };
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t changed = of(1ULL << bit);
    flipped += std::popcount(changed ^ of(0));
    seen.insert(changed);
  }
  EXPECT_EQ(seen.size(), 64U);
  EXPECT_NEAR(flipped / 64, 32, 2.5);  // five deviations of a mean of 64 binomials
}

}  // namespace
}  // namespace breccia::state_hash_test
