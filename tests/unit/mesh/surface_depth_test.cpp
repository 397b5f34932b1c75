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

TEST(SurfaceDepth, NamesTheFacesOfAnElementThatAreFreeAndItsNodesOnTheSurface) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  const Topology topology = build_topology(box);
  const SurfaceDepth depth = surface_depth(kWhole, box, topology);
  for (Index e = 0; e < box.num_elements(); ++e) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_EQ(depth.on_surface[at(box.elements[at(e)][at(c)])], on_border(test::node_of(box, e, c), size) ? 1 : 0);
      EXPECT_EQ(has_face(depth.sides[at(e)], at(c)), topology.links[at(e)][at(c)].free());
    }
    EXPECT_FALSE(is_fractured(depth.sides[at(e)]));
  }
}

TEST(SurfaceDepth, OfAnElementHasTheDistancesToAllSidesThatItMeetsWhetherItCanBreakOrNot) {
  const Vec3 size(3 * 1.0, 2 * 0.75, 2 * 1.25);
  const Mesh box = test::raster_box({3, 2, 2}).mesh;
  for (const bool breakable : {false, true}) {
    const SurfaceDepth depth = surface_depth({breakable}, box, build_topology(box));
    int found = 0;
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
      ASSERT_EQ(num_faces(depth.sides[at(e)]), own) << "element " << e;
      ASSERT_EQ(num_planes(depth.sides[at(e)]), met - own) << "element " << e;
      for (std::size_t k = 0; k < met - own; ++k) {
        const bool is_side = std::any_of(behind.begin(), behind.end(), [&](const std::array<double, 4>& side) {
          double off = 0;
          for (std::size_t c = 0; c < 4; ++c) off = std::max(off, std::abs(side[c] - depth.planes[at(e)][k][c]));
          return off < kRoundOff;
        });
        EXPECT_TRUE(is_side) << "element " << e;
        ++found;
      }
    }
    EXPECT_GT(found, 100);
  }
}

/// A steep pyramid of nine sides, in elements around its axis: each meets eight further sides at the apex.
TEST(SurfaceDepth, LeavesOutNoSideThatIsNearerThanThoseStoredWhereAnElementMeetsMore) {
  constexpr Index sides = 9;
  Mesh pyramid;
  pyramid.nodes = {Vec3(0, 0, 4), Vec3(0, 0, 0)};
  for (Index i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    pyramid.nodes.emplace_back(std::cos(angle), std::sin(angle), 0);
    pyramid.elements.push_back({1, 2 + i, 2 + (i + 1) % sides, 0});
  }
  pyramid.volume_groups = {"pyramid"};
  pyramid.element_group.assign(at(sides), 0);
  pyramid.element_body.assign(at(sides), 0);
  pyramid.num_bodies = 1;
  for (Index e = 0; e < sides; ++e) pyramid.element_source_id.push_back(1 + e);
  const SurfaceDepth depth = surface_depth(kWhole, pyramid, build_topology(pyramid));
  const auto behind = [&](Index side, const Vec3& x) {  // m, of the plane of a side
    const Vec3 &a = pyramid.nodes[at(2 + side)], &b = pyramid.nodes[at(2 + (side + 1) % sides)];
    return (b - a).cross(pyramid.nodes[0] - a).normalized().dot(a - x);
  };
  for (Index e = 0; e < sides; ++e) {
    const std::size_t planes = num_planes(depth.sides[at(e)]);
    ASSERT_EQ(planes, kMostSides);
    for (Index side = 0; side < sides; ++side) {
      if (side == e) continue;  // its own face
      const bool is_there = std::any_of(depth.planes[at(e)].begin(), depth.planes[at(e)].end(), [&](const auto& row) {
        bool no_farther = true;
        for (int c = 0; c < 4; ++c)
          no_farther = no_farther && row[at(c)] <= behind(side, test::node_of(pyramid, e, c)) + kRoundOff;
        return no_farther;
      });
      EXPECT_TRUE(is_there) << "side " << side << " of element " << e;
    }
  }
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
