#include "base/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace breccia::disjoint_sets_test {
namespace {

TEST(DisjointSets, BeginWithEachNumberAlone) {
  DisjointSets sets(3);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(sets.root(i), i);
}

TEST(DisjointSets, KnowTheirSmallestMemberWhateverTheOrder) {
  DisjointSets sets(6);
  sets.join(5, 4);
  sets.join(2, 3);
  sets.join(4, 3);
  for (const Index i : {2, 3, 4, 5}) EXPECT_EQ(sets.root(i), 2);
  EXPECT_EQ(sets.root(0), 0);
  EXPECT_EQ(sets.root(1), 1);
}

TEST(DisjointSets, ForgetWhenReset) {
  DisjointSets sets(2);
  sets.join(0, 1);
  sets.reset(4);
  for (Index i = 0; i < 4; ++i) EXPECT_EQ(sets.root(i), i);
}

}  // namespace
}  // namespace breccia::disjoint_sets_test
