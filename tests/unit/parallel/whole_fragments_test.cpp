#include "parallel/whole_fragments.hpp"

#include <gtest/gtest.h>

#include "mesh/topology.hpp"

namespace breccia::whole_fragments_test {
namespace {

constexpr Index kFree = FaceLink::kFree, kBeyond = FaceLink::kBeyond;

using Neighbours = std::vector<std::array<Index, 4>>;

/// Elements along x, one a metre; those within a fragment hang together as a chain.
struct Chain {
  std::vector<Vec3> centroid;
  Neighbours neighbours;

  explicit Chain(const std::vector<int>& lengths) {
    for (const int length : lengths) {
      for (int i = 0; i < length; ++i) {
        const auto e = static_cast<Index>(centroid.size());
        centroid.emplace_back(static_cast<double>(e), 0.0, 0.0);
        neighbours.push_back({i > 0 ? e - 1 : kFree, kFree, i + 1 < length ? e + 1 : kFree, kFree});
      }
    }
  }
  [[nodiscard]] std::vector<double> places(double fair_share, double reach) const {
    std::vector<double> x;
    for (const Vec3& place : places_of_fragments(centroid, neighbours, fair_share, reach)) x.push_back(place[0]);
    return x;
  }
};

TEST(WholeFragments, LieInTheirMiddle) {
  EXPECT_EQ(Chain({3, 1, 2}).places(1000, 10), (std::vector<double>{1, 1, 1, 3, 4.5, 4.5}));
}

TEST(WholeFragments, LargeOnesMayBeCut) {
  const Chain chain({3, 2});
  EXPECT_EQ(chain.places(48, 10), (std::vector<double>{1, 1, 1, 3.5, 3.5}));
  EXPECT_EQ(chain.places(47, 10), (std::vector<double>{0, 1, 2, 3.5, 3.5})) << "more than a sixteenth of a domain";
}

TEST(WholeFragments, WideOnesMayBeCut) {
  EXPECT_EQ(Chain({3, 2}).places(1000, 1.5), (std::vector<double>{0, 1, 2, 3.5, 3.5})) << "wider than proxies reach";
}

TEST(WholeFragments, ThoseOfSeveralRanksStayAsTheyAre) {
  Chain chain({3, 2});
  chain.neighbours[2][1] = kBeyond;
  EXPECT_EQ(chain.places(1000, 10), (std::vector<double>{0, 1, 2, 3.5, 3.5}));
}

}  // namespace
}  // namespace breccia::whole_fragments_test
