// Runs the tests on all ranks: the first one reports, the others tell their failures alone; the exit code is the same
// on all.

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

#include "catalyst/world.hpp"

namespace {

breccia::test::World all_ranks;

/// Tells what failed, and on which rank.
class FailureListener final : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (result.failed())
      std::fprintf(stderr, "rank %d: %s:%d: %s\n", all_ranks.rank,
                   result.file_name() == nullptr ? "?" : result.file_name(), result.line_number(), result.message());
  }
};

}  // namespace

const breccia::test::World& breccia::test::world() { return all_ranks; }

void breccia::test::barrier() { MPI_Barrier(MPI_COMM_WORLD); }

int breccia::test::broadcast(int value) {
  MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value;
}

std::filesystem::path breccia::test::fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(BRECCIA_TEST_FOLDER) / (name + "_" + std::to_string(all_ranks.size));
  if (all_ranks.rank == 0) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  barrier();
  return folder;
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  all_ranks.communicator = static_cast<int>(MPI_Comm_c2f(MPI_COMM_WORLD));
  MPI_Comm_rank(MPI_COMM_WORLD, &all_ranks.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &all_ranks.size);
  if (all_ranks.rank != 0) {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailureListener);
  }
  const int mine = RUN_ALL_TESTS();
  int result = 0;
  MPI_Allreduce(&mine, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return result;
}
