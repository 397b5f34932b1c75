#include "output/folder/bodies_sink.hpp"

#include <gtest/gtest.h>

#include "unit/output/temporary_folder.hpp"

namespace breccia::bodies_test {
namespace {

TEST(BodiesSinkTest, WritesALineABodyWithQuotesAroundNamesThatNeedThem) {
  const test::TemporaryFolder folder;
  RunStart run;
  run.bodies = {"plate", "a, \"b\"", "blocks (body 2)"};
  BodiesSink(folder / "bodies.csv").start(run);
  EXPECT_EQ(test::content_of(folder / "bodies.csv"), "body,name\n0,plate\n1,\"a, \"\"b\"\"\"\n2,blocks (body 2)\n");
}

}  // namespace
}  // namespace breccia::bodies_test
