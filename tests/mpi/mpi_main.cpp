// Runs the tests on all ranks: the first one reports, the others tell their failures alone; the exit code is the same
// on all.

#include <gtest/gtest.h>

#include <cstdio>

#include "mpi/world.hpp"
#include "parallel/mpi_session.hpp"

namespace {

breccia::Communicator all_ranks;

/// Tells what failed, and on which rank.
class FailureListener final : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::fprintf(stderr, "rank %d: %s:%d: %s\n", all_ranks.rank(),
                 result.file_name() == nullptr ? "?" : result.file_name(), result.line_number(), result.message());
  }
};

}  // namespace

const breccia::Communicator& breccia::test::world() { return all_ranks; }

int main(int argc, char** argv) {
  breccia::MpiSession session(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  all_ranks = session.world();
  if (!all_ranks.is_root()) {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailureListener);
  }
  const auto result = static_cast<int>(all_ranks.max(std::int64_t{RUN_ALL_TESTS()}));
  all_ranks = {};
  return result;
}
