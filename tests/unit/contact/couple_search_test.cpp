#include <gtest/gtest.h>

#include "contact/couple_search.hpp"
#include "unit/contact/breaking_boxes.hpp"

namespace breccia::couple_search_test {
namespace {

using test::BreakingBoxes;
using test::OwnedContact;

TEST(CoupleSearch, SearchesOnlyWhenTheBufferIsUsedUp) {
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.5, 0, 0})));
  model.search.buffer = 0.2;
  model.search.verify = true;
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  EXPECT_EQ(search.num_searches(), 1);
  for (int i = 0; i < 1000; ++i) {  // trembling: 10 m of path, but never away by more than 0.01 m
    model.shift(1, {i % 2 == 0 ? 0.01 : -0.01, 0, 0});
    search.update(model.state, 0.01, 1);
  }
  EXPECT_EQ(search.num_searches(), 1);
  for (int i = 0; i < 60; ++i) {  // through each other: 0.6 m
    model.shift(1, {-0.01, 0, 0});
    search.update(model.state, 0.01, 1);
  }
  EXPECT_GE(search.num_searches(), 1 + 2)
      << "one for every step beyond a buffer, as each moves by half of it against the other";
  EXPECT_LE(search.num_searches(), 1 + 4) << "or three quarters of it";
  EXPECT_GT(search.contact().couples.size(), 0u);
}

TEST(CoupleSearch, IsNotDoneAnewForBodiesThatFlyTogether) {
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.05, 0, 0})));
  model.search.buffer = 0.2;
  model.search.verify = true;
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  for (int i = 0; i < 100; ++i) {  // 5 m
    for (const Index body : {0, 1}) model.shift(body, {0.03, 0.04, 0});
    search.update(model.state, 0.05, 1);
  }
  EXPECT_EQ(search.num_searches(), 1);
  EXPECT_GT(search.contact().couples.size(), 0u);
}

TEST(CoupleSearch, ChoosesALargerBufferWhenASmallOneWouldNotLast) {
  BreakingBoxes model(test::box({1, 1, 1}, 1.0));
  OwnedContact slow = model.make(), fast = model.make();
  slow.update(model.state, 1, 1e-6);
  fast.update(model.state, 1, 1.0);
  EXPECT_GT(slow.buffer(), 0);
  EXPECT_NEAR(fast.buffer() / slow.buffer(), 4, 1e-12);
}

}  // namespace
}  // namespace breccia::couple_search_test
