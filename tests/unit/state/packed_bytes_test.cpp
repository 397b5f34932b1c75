#include "state/packed_bytes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace breccia::packed_bytes_test {
namespace {

std::vector<int> values_of(const std::vector<std::byte>& bytes) {
  std::vector<int> values;
  for (const std::byte b : bytes) values.push_back(std::to_integer<int>(b));
  return values;
}

TEST(PackedBytes, AreLittleEndianAndAsWideAsTheNumber) {
  PackedBytes bytes;
  bytes.put(std::uint8_t{0x7F});
  bytes.put(std::int32_t{-2});
  bytes.put(std::uint64_t{0x0102030405060708});
  bytes.put(1.0);
  EXPECT_EQ(values_of(bytes.take()),
            (std::vector<int>{0x7F, 0xFE, 0xFF, 0xFF, 0xFF, 8, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F}));
}

TEST(PackedBytes, ComeBackAsTheyWerePut) {
  enum class Colour : std::uint8_t { red = 1, green = 2 };
  const double quiet = std::numeric_limits<double>::quiet_NaN();
  PackedBytes bytes;
  bytes.put(true);
  bytes.put(Colour::green);
  bytes.put_list(std::vector<double>{-0.0, 5e-324, std::numeric_limits<double>::infinity(), quiet});
  bytes.put_text("case \"a\"\n");
  const std::vector<std::byte> packed = bytes.take();
  PackedReader reader(packed);
  EXPECT_TRUE(reader.take<bool>());
  EXPECT_EQ(reader.take<Colour>(), Colour::green);
  const std::vector<double> list = reader.take_list<double>();
  ASSERT_EQ(list.size(), 4u);
  EXPECT_TRUE(std::signbit(list[0]));
  EXPECT_EQ(list[1], 5e-324);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(list[3]), std::bit_cast<std::uint64_t>(quiet));
  EXPECT_EQ(reader.take_text(), "case \"a\"\n");
  EXPECT_EQ(reader.left(), 0u);
}

TEST(PackedReader, ThrowsAtTheEndOfTheBytesAndAllocatesNothingThatCannotBeThere) {
  PackedBytes bytes;
  bytes.put(std::uint64_t{1} << 60);
  const std::vector<std::byte> packed = bytes.take();
  EXPECT_THROW((void)PackedReader(packed).take_list<double>(), InternalError);
  PackedReader reader(packed);
  (void)reader.take<std::uint64_t>();
  EXPECT_THROW((void)reader.take<std::uint8_t>(), InternalError);
}

}  // namespace
}  // namespace breccia::packed_bytes_test
