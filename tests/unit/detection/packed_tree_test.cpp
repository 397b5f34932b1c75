#include <gtest/gtest.h>

#include <string>

#include "detection/point_body/brute_force.hpp"
#include "detection/point_body/packed_tree.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::packed_tree_test {
namespace {

/// Both instruction sets against all pairs, whatever the machine would choose.
class PackedKernels : public testing::TestWithParam<const PackedKernel*> {
 protected:
  void SetUp() override {
    if (GetParam() == &packed_kernel_avx2 && __builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "no AVX2 here";
  }
  void expect_all_pairs(const scenes::Scene& scene, double buffer) {
    std::vector<Couple> expected, found;
    BruteForce().search(scene.points, scene.contactors, buffer, expected);
    search_.search(scene.points, scene.contactors, buffer, found);
    EXPECT_GT(expected.size(), 0u);
    EXPECT_TRUE(found == expected) << scene.points.size() << " points, buffer " << buffer;
  }
  PackedTree search_{*GetParam()};
};

TEST_P(PackedKernels, FindTheCouplesOfAllPairs) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_all_pairs(scenes::cloud(seed, 700, 2, 2), 0.01);
    expect_all_pairs(scenes::cloud(seed, 700, 2, 2), 0);
  }
  expect_all_pairs(scenes::raster(7, 0.8), 0.1);
}

TEST_P(PackedKernels, FillLeavesAndGroupsOfEveryNumberOfPoints) {
  const scenes::Scene scene = scenes::cloud(5, 110, 1, 1);  // 550 points: three levels, the last of one group
  for (std::size_t n = 1; n <= scene.points.size(); n += n < 80 ? 1 : 37) {
    scenes::Scene part = scene;
    part.points.resize(n);
    expect_all_pairs(part, 0.05);
  }
}

TEST_P(PackedKernels, FindTheCouplesOfElementsWithoutAnOutside) {
  scenes::Scene scene = scenes::cloud(6, 200, 1, 1);
  for (Corners& c : scene.contactors) std::swap(c[0], c[1]);
  expect_all_pairs(scene, 0.02);
}

TEST_P(PackedKernels, FindTheCouplesOfAnElementWiderThanAFloatCanTell) {
  scenes::Scene scene = scenes::cloud(6, 20, 1, 1);
  scene.points.resize(3);  // a leaf, and seven places without one
  for (const double sign : {1.0, -1.0}) {
    const double far = 1e100;
    scene.contactors.push_back({Vec3(-far, -far, -far), Vec3(3 * far, -far, -far), Vec3(-far, 3 * far, -far),
                                Vec3(-far, -far, sign * 3 * far)});
  }
  expect_all_pairs(scene, 0.02);
}

std::string name_of(const testing::TestParamInfo<const PackedKernel*>& info) {
  return info.param == &packed_kernel_avx2 ? "avx2" : "sse2";
}

INSTANTIATE_TEST_SUITE_P(All, PackedKernels, testing::Values(&packed_kernel_sse2, &packed_kernel_avx2), name_of);

}  // namespace
}  // namespace breccia::detection::packed_tree_test
