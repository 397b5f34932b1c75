#include "physics/contact/step/bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace breccia::contact_bound_test {
namespace {

TEST(ContactBound, KeepsWhatHasTheLargestShareOfAnyNode) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  std::bernoulli_distribution damped(0.5);
  for (int round = 0; round < 50; ++round) {
    std::vector<ContactBound> all, kept;
    for (Index i = 0; i < 60; ++i) {
      ContactBound m;
      m.sum = {number(random), number(random), number(random)};
      if (damped(random)) m.decay = {number(random), number(random), number(random)};
      m.against = i;
      all.push_back(m);
      add_bound(m, kept);
    }
    EXPECT_LT(kept.size(), all.size());
    for (int node = 0; node < 20; ++node) {
      const double area = number(random), per_mass = number(random);
      const auto largest = [&](const std::vector<ContactBound>& bounds) {
        double share = 0;
        for (const ContactBound& m : bounds) share = std::max(share, m.share(area, per_mass));
        return share;
      };
      EXPECT_EQ(largest(kept), largest(all));
    }
  }
}

TEST(ContactBound, OfEqualOnesTheFirstIsKept) {
  std::vector<ContactBound> kept;
  for (Index i = 0; i < 3; ++i) {
    ContactBound m;
    m.sum = {1, 2, 3};
    m.against = i;
    add_bound(m, kept);
  }
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.front().against, 0);
}

}  // namespace
}  // namespace breccia::contact_bound_test
