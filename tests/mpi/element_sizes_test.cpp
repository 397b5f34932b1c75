#include "domains/element_sizes.hpp"

#include <gtest/gtest.h>

#include "mpi/world.hpp"

namespace breccia::element_sizes_test {
namespace {

using test::world;

/// Elements in a row, each of which shares one vertex with the next; element e has the size 1, but for a large one.
class RowOfElements : public testing::Test {
 protected:
  static constexpr int kElements = 40, kLarge = 17;

  RowOfElements() {
    for (int e = 0; e < kElements; ++e) {
      if (e % world().size() != world().rank()) continue;  // neighbours lie on different ranks
      mine_.push_back(e);
      vertices_.push_back({3 * e, 3 * e + 1, 3 * e + 2, 3 * e + 3});
      sizes_.push_back(e == kLarge ? 10.0 : 1.0);
    }
  }
  [[nodiscard]] std::vector<int> within(int rings) const {
    std::vector<int> large;
    const std::vector<double> around = sizes_around(world(), vertices_, sizes_, rings);
    for (std::size_t i = 0; i < around.size(); ++i) {
      EXPECT_TRUE(around[i] == 1.0 || around[i] == 10.0);
      if (around[i] == 10.0) large.push_back(mine_[i]);
    }
    return large;
  }

  std::vector<int> mine_;
  std::vector<std::array<GlobalId, 4>> vertices_;
  std::vector<double> sizes_;
};

TEST_F(RowOfElements, SeesTheLargestElementAsManyRingsAway) {
  for (const int rings : {0, 1, 3}) {
    std::vector<int> expected;
    for (const int e : mine_) {
      if (std::abs(e - kLarge) <= rings) expected.push_back(e);
    }
    EXPECT_EQ(within(rings), expected) << rings << " rings";
  }
}

TEST_F(RowOfElements, HasOneMeanAndOneLargestOnAllRanks) {
  const Sizes sizes = sizes_of_all(world(), sizes_);
  EXPECT_EQ(sizes.largest, 10.0);
  EXPECT_DOUBLE_EQ(sizes.mean, 49.0 / kElements);
}

TEST(ElementSizes, MayBeOfRanksWithoutElements) {
  std::vector<std::array<GlobalId, 4>> vertices;
  std::vector<double> sizes;
  if (world().is_root()) {
    vertices.push_back({0, 1, 2, GlobalId{1} << 40});
    sizes.push_back(2.0);
  }
  EXPECT_EQ(sizes_around(world(), vertices, sizes, 2), sizes);
  EXPECT_EQ(sizes_of_all(world(), sizes).mean, 2.0);
}

}  // namespace
}  // namespace breccia::element_sizes_test
