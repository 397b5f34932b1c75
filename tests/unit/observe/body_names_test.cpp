#include "observe/body_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia::body_names_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(BodyNames, AreThoseOfTheirGroupsWithNumbersWhereAGroupHasSeveral) {
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{{1}, {0}, {1}, {2}}, {"plate", "blocks", "ball"}),
              ElementsAre("blocks (body 0)", "plate", "blocks (body 2)", "ball"));
}

TEST(BodyNames, AreNumbersWhereThereIsNoGroup) {
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{{}, {0}}, {"plate"}), ElementsAre("body 0", "plate"));
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{}, {"plate"}), IsEmpty());
}

TEST(BodyNames, AreThoseOfAllGroupsThatABodyConsistsOf) {
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{{0, 2}, {1}, {2}}, {"core", "plate", "shell"}),
              ElementsAre("core + shell (body 0)", "plate", "shell (body 2)"))
      << "the shell is in two bodies";
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{{0, 1, 2}}, {"a", "b", "c"}), ElementsAre("a + b + c"));
  EXPECT_THAT(body_names(std::vector<std::vector<Index>>{{0, 1, 2, 3, 4}}, {"a", "b", "c", "d", "e"}),
              ElementsAre("a + b + 3 other groups"));
}

}  // namespace
}  // namespace breccia::body_names_test
