#include "mesh/surface_depth.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/geometry.hpp"
#include "sample_meshes.hpp"

namespace breccia::surface_depth_test {
namespace {

constexpr double kRoundOff = 1e-12;
const std::vector<bool> kWhole{false};  ///< one group, which cannot break

bool on_border(const Vec3& x, const Vec3& size) {
  return (x.array() < kRoundOff).any() || (x.array() > size.array() - kRoundOff).any();
}

TEST(SurfaceDepth, NamesTheCornersOfAnElementThatLieOnOneFreeFace) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const Topology topology = build_topology(box);
  const SurfaceDepth depth = surface_depth(kWhole, box, topology);
  for (Index e = 0; e < box.num_elements(); ++e) {
    const CornerSets sets = depth.sets[at(e)];
    unsigned seen = 0;
    for_each_set(sets, [&](unsigned set) {
      seen |= set;
      // The corners lie on one side of the box.
      std::array<bool, 6> on;
      on.fill(true);
      for (int c = 0; c < 4; ++c) {
        if ((set >> c & 1U) == 0) continue;
        const Vec3 x = test::node_of(box, e, c);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<Eigen::Index>(axis);
          on[axis] = on[axis] && x[k] < kRoundOff;
          on[3 + axis] = on[3 + axis] && x[k] > size[k] - kRoundOff;
        }
      }
      EXPECT_TRUE(std::any_of(on.begin(), on.end(), [](bool side) { return side; }))
          << "element " << e << ", set " << set;
      EXPECT_FALSE(covers(sets & ~(1 << set), set)) << "element " << e << ", set " << set;
    });
    for (int c = 0; c < 4; ++c) {
      const Vec3 x = test::node_of(box, e, c);
      EXPECT_EQ(seen >> c & 1U, on_border(x, size) ? 1U : 0U);
      EXPECT_EQ(depth.on_surface[at(box.elements[at(e)][at(c)])], on_border(x, size) ? 1 : 0);
      const unsigned face = 15U ^ 1U << c;
      if (topology.links[at(e)][at(c)].free()) {
        EXPECT_TRUE((sets >> face & 1) != 0) << "a face of its own";
      }
    }
  }
}

/// An element that meets the surface with an edge or a corner alone: it lies as that side of the box does.
TEST(SurfaceDepth, KnowsHowTheSurfaceLiesAroundAnEdgeOrACornerOfAnElement) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const SurfaceDepth depth = surface_depth({true}, box, build_topology(box));
  int tested = 0;
  for (Index e = 0; e < box.num_elements(); ++e) {
    for_each_side(depth.sets[at(e)], [&](unsigned set, int place) {
      if (place < 0) return;
      ASSERT_LT(at(place), kMostSides);
      for (int side = 0; side < 6; ++side) {  // of the box: lower and upper, axis by axis
        const auto behind = [&](int corner) {
          const double x = test::node_of(box, e, corner)[side / 2];
          return side % 2 == 0 ? x : size[side / 2] - x;
        };
        bool on = true;
        for (int c = 0; c < 4; ++c) on = on && ((set >> c & 1U) == 0 || behind(c) < kRoundOff);
        if (!on) continue;
        ++tested;
        for (int c = 0; c < 4; ++c)
          EXPECT_NEAR(depth.sides[at(e)][at(place)][at(c)], behind(c), kRoundOff) << "element " << e << ", set " << set;
      }
    });
  }
  EXPECT_GT(tested, 100);
}

TEST(SurfaceDepth, OfAnElementThatCannotBreakHasTheDistancesToAllSidesThatItMeets) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const SurfaceDepth depth = surface_depth(kWhole, box, build_topology(box));
  int exact = 0;
  for (Index e = 0; e < box.num_elements(); ++e) {
    std::array<std::array<double, 4>, 6> behind{};  // sides of the box: lower and upper, axis by axis
    std::size_t met = 0, own = 0;
    for (std::size_t side = 0; side < 6; ++side) {
      const auto axis = static_cast<Eigen::Index>(side / 2);
      int on = 0;
      for (int c = 0; c < 4; ++c) {
        const double x = test::node_of(box, e, c)[axis];
        behind[side][at(c)] = side % 2 == 0 ? x : size[axis] - x;
        on += behind[side][at(c)] < kRoundOff ? 1 : 0;
      }
      met += on > 0 ? 1 : 0;
      own += on == 3 ? 1 : 0;
    }
    const CornerSets sets = depth.sets[at(e)];
    EXPECT_EQ((sets & kExact) != 0, met > 0);
    if (met == 0) continue;
    ASSERT_EQ(num_planes(sets), met - own) << "element " << e;
    for (std::size_t k = 0; k < num_planes(sets); ++k) {
      const bool is_side = std::any_of(behind.begin(), behind.end(), [&](const std::array<double, 4>& side) {
        double off = 0;
        for (std::size_t c = 0; c < 4; ++c) off = std::max(off, std::abs(side[c] - depth.sides[at(e)][k][c]));
        return off < kRoundOff;
      });
      EXPECT_TRUE(is_side) << "element " << e;
      ++exact;
    }
  }
  EXPECT_GT(exact, 100);
}

TEST(SurfaceDepth, HasMeanNormalsThatDoNotDependOnHowSidesAreCutIntoTriangles) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  Mesh box = test::raster_box({3, 2, 2}).mesh;
  for (Vec3& x : box.nodes) {  // unevenly, along each side
    for (int i = 0; i < 3; ++i) x[i] += 0.05 * std::sin(5 * x[(i + 1) % 3]) * x[i] * (size[i] - x[i]);
  }
  const SurfaceDepth depth = surface_depth(kWhole, box, build_topology(box));
  for (std::size_t n = 0; n < box.nodes.size(); ++n) {
    Vec3 expected = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      if (box.nodes[n][i] < kRoundOff) expected[i] = -1;
      if (box.nodes[n][i] > size[i] - kRoundOff) expected[i] = 1;
    }
    const double sides = expected.cwiseAbs().sum();
    if (sides > 0) expected /= sides;
    EXPECT_NEAR((depth.normal[n] - expected).norm(), 0, 1e-9) << box.nodes[n].transpose();
  }
}

TEST(SurfaceDepth, OfANodeOnTheSurfaceIsWhatLiesBehindIt) {
  constexpr double kLeastHeight = 0.2;  // of the elements of a cell of 1 x 0.75 x 1.25, rounded down
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const Topology topology = build_topology(box);
  const SurfaceDepth depth = surface_depth(kWhole, box, topology);
  for (Index n = 0; n < box.num_nodes(); ++n) {
    const Vec3& x = box.nodes[at(n)];
    const double d = depth.depth[at(n)];
    EXPECT_GT(d, 0);
    if (!on_border(x, size)) continue;
    // The distance to the nearest side of the box that it does not lie on, where that is not beyond its longest edge.
    double nearest = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
      for (const double away : {x[axis], size[axis] - x[axis]}) {
        if (away > kRoundOff) nearest = std::min(nearest, away);
      }
    }
    EXPECT_LE(d, nearest + kRoundOff) << x.transpose();
    EXPECT_TRUE(std::abs(d - nearest) < kRoundOff || d >= kLeastHeight - kRoundOff) << x.transpose() << ": " << d;
  }
}

TEST(SurfaceDepth, OfNodesInsideIsTheirDistanceToTheSurface) {
  const Mesh box = test::raster_box({1, 1, 1}).mesh;
  const SurfaceDepth depth = surface_depth(kWhole, box, build_topology(box));
  int inside = 0;
  for (Index n = 0; n < box.num_nodes(); ++n) {
    if (depth.on_surface[at(n)] != 0) continue;
    ++inside;
    EXPECT_NEAR(depth.depth[at(n)], 0.375, kRoundOff) << "the centre of a box of 1 x 0.75 x 1.25";
  }
  EXPECT_EQ(inside, 1);
}

TEST(SurfaceDepth, OfANodeOfWhatCanBreakIsItsLeastHeight) {
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const SurfaceDepth depth = surface_depth({true}, box, build_topology(box));
  std::vector<double> least(box.nodes.size(), std::numeric_limits<double>::max());
  for (Index e = 0; e < box.num_elements(); ++e) {
    for (int c = 0; c < 4; ++c) {
      double& height = least[at(box.elements[at(e)][at(c)])];
      height = std::min(height, geometry::height(geometry::corners_of(box, e), c));
    }
  }
  EXPECT_EQ(depth.depth, least);
}

}  // namespace
}  // namespace breccia::surface_depth_test
