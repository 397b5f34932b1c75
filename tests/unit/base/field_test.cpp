#include "base/field.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace breccia::field_test {
namespace {

template <class T>
bool starts_a_cache_line(const Field<T>& field) {
  return reinterpret_cast<std::uintptr_t>(field.data()) % 64 == 0;
}

TEST(Field, StartsOnACacheLineWhateverItsSizeAndType) {
  for (std::size_t size = 1; size < 200; size += 7) {
    EXPECT_TRUE(starts_a_cache_line(Field<double>(size))) << size << " doubles";
    EXPECT_TRUE(starts_a_cache_line(Field<float>(size))) << size << " floats";
    EXPECT_TRUE(starts_a_cache_line(Field<char>(size))) << size << " bytes";
  }
}

TEST(Field, StaysOnACacheLineWhileItGrows) {
  Field<double> field;
  for (int i = 0; i < 1000; ++i) {
    field.push_back(i);
    ASSERT_TRUE(starts_a_cache_line(field)) << "after " << i + 1 << " values";
  }
  EXPECT_EQ(field[0], 0.0);
  EXPECT_EQ(field[999], 999.0);
}

TEST(Field, KeepsAlignmentAndValuesInCopiesAndMoves) {
  const Field<double> field(17, 2.5);
  Field<double> copy = field;
  EXPECT_TRUE(starts_a_cache_line(copy));
  EXPECT_NE(copy.data(), field.data());
  const Field<double> moved = std::move(copy);
  EXPECT_TRUE(starts_a_cache_line(moved));
  EXPECT_EQ(moved, field);
}

}  // namespace
}  // namespace breccia::field_test
