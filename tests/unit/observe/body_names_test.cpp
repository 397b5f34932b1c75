#include "observe/body_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(BodyNames, AreThoseOfTheirGroupsWithNumbersWhereAGroupHasSeveral) {
  EXPECT_THAT(body_names(std::vector<Index>{1, 0, 1, 2}, {"plate", "blocks", "ball"}),
              ElementsAre("blocks (body 0)", "plate", "blocks (body 2)", "ball"));
}

TEST(BodyNames, AreNumbersWhereThereIsNoGroup) {
  EXPECT_THAT(body_names(std::vector<Index>{-1, 0}, {"plate"}), ElementsAre("body 0", "plate"));
  EXPECT_THAT(body_names(std::vector<Index>{}, {"plate"}), IsEmpty());
}

}  // namespace
}  // namespace breccia
