#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "unit/detection/scenes.hpp"

namespace {
std::atomic<long> allocations = 0;
}  // namespace

// Every plain allocation of this executable is counted; the tests below compare the count before and after a search.
// Not inlined: the compiler would pair `new` with `free` and warn.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* storage = operator new(size, std::nothrow)) return storage;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* storage) noexcept { std::free(storage); }
[[gnu::noinline]] void operator delete(void* storage, std::size_t) noexcept { operator delete(storage); }
[[gnu::noinline]] void operator delete(void* storage, const std::nothrow_t&) noexcept { operator delete(storage); }

namespace breccia::detection::search_storage_test {
namespace {

class SearchStorage : public testing::TestWithParam<Algorithm> {};

TEST_P(SearchStorage, IsAllocatedByTheFirstSearchAndByNoLaterOne) {
  scenes::Scene scene = scenes::raster(6, 0.8);
  const auto search = make_search(GetParam(), 0);
  std::vector<Couple> couples;
  search->search(scene.points, scene.contactors, 0.05, couples);
  const std::vector<Couple> first = couples;
  for (int k = 0; k < 3; ++k) {
    const long before = allocations;
    search->search(scene.points, scene.contactors, 0.05, couples);
    EXPECT_EQ(allocations - before, 0);
    EXPECT_TRUE(couples == first);
  }
}

std::string name_of(const testing::TestParamInfo<Algorithm>& info) { return scenes::name_of(info.param); }

INSTANTIATE_TEST_SUITE_P(All, SearchStorage,
                         testing::Values(Algorithm::ms, Algorithm::ms_slices, Algorithm::sorted_grid,
                                         Algorithm::packed_tree, Algorithm::brute_force),
                         name_of);

}  // namespace
}  // namespace breccia::detection::search_storage_test
