#include "run_folder/bodies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia::run_folder::bodies_test {
namespace {

using testing::ElementsAre;
using testing::Optional;

TEST(Bodies, AreNamedInTheOrderOfTheirNumbers) {
  EXPECT_THAT(parse_bodies("body,name\n0,plate\n1,\"a, b\"\n"), Optional(ElementsAre("plate", "a, b")));
  EXPECT_THAT(parse_bodies("body,name\n"), Optional(ElementsAre()));
}

TEST(Bodies, ALastLineThatIsNotWholeIsLeftOut) {
  EXPECT_THAT(parse_bodies("body,name\n0,plate\n1,ba"), Optional(ElementsAre("plate")));
}

TEST(Bodies, OfAnotherTableAreNone) {
  for (const char* text : {"", "body,name", "body\n0\n", "name,body\n", "body,name\n0,plate\n2,ball\n",
                           "body,name\n0,plate,x\n", "body,name\n0,plate\n\n"}) {
    EXPECT_FALSE(parse_bodies(text)) << text;
  }
}

}  // namespace
}  // namespace breccia::run_folder::bodies_test
