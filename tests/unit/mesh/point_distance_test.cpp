#include "mesh/point_distance.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mesh/geometry.hpp"
#include "mesh/triangle_tree.hpp"
#include "sample_meshes.hpp"

namespace breccia::point_distance_test {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }
  Vec3 point() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

TEST(PointTriangleDistance, IsThatOfItsInsideEdgesAndCorners) {
  const Triangle t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 3, 0)};
  constexpr double kRoundOff = 1e-15;
  EXPECT_NEAR(point_triangle_distance(Vec3(1, 1, -2), t), 2, kRoundOff);               // above the inside
  EXPECT_NEAR(point_triangle_distance(Vec3(1, 1, 0), t), 0, kRoundOff);                // in it
  EXPECT_NEAR(point_triangle_distance(Vec3(2, -3, 4), t), 5, kRoundOff);               // edge along x
  EXPECT_NEAR(point_triangle_distance(Vec3(-12, 1, 5), t), 13, 4 * kRoundOff);         // edge along y
  EXPECT_NEAR(point_triangle_distance(Vec3(2 + 3, 1.5 + 4, 0), t), 5, 4 * kRoundOff);  // hypotenuse, normal (3, 4)
  EXPECT_NEAR(point_triangle_distance(Vec3(-2, -3, 6), t), 7, kRoundOff);              // corner 0
  EXPECT_NEAR(point_triangle_distance(Vec3(7, -4, 0), t), 5, kRoundOff);               // corner 1
  EXPECT_NEAR(point_triangle_distance(Vec3(0, 4, 0), t), 1, kRoundOff);                // corner 2
}

TEST(PointTriangleDistance, OfATriangleWithoutAreaIsThatOfItsLongestEdge) {
  const Triangle t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(4, 0, 0)};
  EXPECT_DOUBLE_EQ(point_triangle_distance(Vec3(3, 2, 0), t), 2);
  EXPECT_DOUBLE_EQ(point_triangle_distance(Vec3(7, 4, 0), t), 5);
  EXPECT_DOUBLE_EQ(point_triangle_distance(Vec3(0, 2, 0), {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)}), 2);
}

TEST(PointTriangleDistance, IsNeverBeatenByAPointOfTheTriangle) {
  Random random(5);
  constexpr int kSteps = 60;
  for (int n = 0; n < 300; ++n) {
    const Triangle t{random.point(), random.point(), random.point()};
    const Vec3 p = 3 * random.point() - Vec3::Constant(1);
    double nearest = 1e9, longest = 0;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
        nearest = std::min(nearest, (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - p).norm());
      }
    }
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, (t[i] - t[(i + 1) % 3]).norm());
    const double distance = point_triangle_distance(p, t);
    EXPECT_LE(distance, nearest + 1e-14);
    EXPECT_GE(distance, nearest - longest / kSteps);
  }
}

TEST(TriangleTree, FindsTheSmallestDistanceOfAllTriangles) {
  Random random(6);
  for (const std::size_t count : {1u, 3u, 5u, 40u, 1000u}) {
    std::vector<Triangle> triangles;
    for (std::size_t n = 0; n < count; ++n) {
      const Vec3 place = random.point();
      triangles.push_back({place, place + 0.1 * random.point(), place + 0.1 * random.point()});
    }
    const TriangleTree tree(triangles);
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = 2 * random.point() - Vec3::Constant(0.5);
      double nearest = 1e9;
      for (const auto& t : triangles) nearest = std::min(nearest, point_triangle_distance(p, t));
      EXPECT_EQ(tree.distance(p, std::numeric_limits<double>::infinity()), nearest);
      EXPECT_EQ(tree.distance(p, 0.05), std::min(nearest, 0.05));
    }
  }
  EXPECT_EQ(TriangleTree({}).distance(Vec3(0, 0, 0), 2.5), 2.5);
}

/// Exact distance of every node to the free faces of its body by looking at all of them; also_free counts for its own
/// body.
std::vector<double> by_brute_force(const Mesh& mesh, const Topology& topology, bool glued) {
  struct Free {
    Triangle triangle;
    Index body;
  };
  std::vector<Free> surface;
  const auto add = [&](Index e, int f) {
    const auto& c = kFaceCorners[at(f)];
    surface.push_back({{test::node_of(mesh, e, c[0]), test::node_of(mesh, e, c[1]), test::node_of(mesh, e, c[2])},
                       glued ? 0 : mesh.element_body[at(e)]});
  };
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (topology.links[at(e)][at(f)].free()) add(e, f);
    }
  }
  std::vector<Index> body(mesh.nodes.size(), 0);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (const Index node : mesh.elements[at(e)]) body[at(node)] = glued ? 0 : mesh.element_body[at(e)];
  }
  std::vector<double> distance(mesh.nodes.size(), 1e9);
  for (std::size_t n = 0; n < distance.size(); ++n) {
    for (const auto& [triangle, owner] : surface) {
      if (owner == body[n]) distance[n] = std::min(distance[n], point_triangle_distance(mesh.nodes[n], triangle));
    }
  }
  return distance;
}

/// Exact beside the surface, a positive lower bound deeper inside; returns how many nodes are of either kind.
std::pair<int, int> compare(const Mesh& mesh, const std::vector<double>& distance, const std::vector<double>& exact,
                            double round_off) {
  std::vector<char> beside(mesh.nodes.size(), 0);
  for (const auto& corners : mesh.elements) {
    const bool touches =
        std::any_of(corners.begin(), corners.end(), [&](Index n) { return exact[at(n)] <= round_off; });
    for (const Index node : corners) beside[at(node)] |= touches ? 1 : 0;
  }
  int inner = 0, deep = 0;
  for (std::size_t n = 0; n < distance.size(); ++n) {
    if (exact[n] <= round_off) {
      EXPECT_EQ(distance[n], 0.0) << "on the surface";
    } else if (beside[n] != 0) {
      ++inner;
      EXPECT_NEAR(distance[n], exact[n], round_off);
    } else {
      ++deep;
      EXPECT_GT(distance[n], 0.0);
      EXPECT_LE(distance[n], exact[n] + round_off);
    }
  }
  return {inner, deep};
}

constexpr double kRoundOff = 1e-13;  // coordinates of order 1

TEST(NodalSurfaceDistance, IsExactBesideTheSurfaceAndABoundInside) {
  for (const bool glue : {false, true}) {
    const Mesh mesh = test::two_boxes("distance", 0.15, glue).mesh;
    const Topology topology = build_topology(mesh);
    const auto distance = nodal_surface_distance(mesh, topology);
    const auto [inner, deep] = compare(mesh, distance, by_brute_force(mesh, topology, glue), kRoundOff);
    EXPECT_GT(inner, 50);
    EXPECT_GT(deep, 5);
  }
}

TEST(NodalSurfaceDistance, OfABoxIsTheDistanceToItsNearestSide) {
  const Mesh mesh = test::raster_box({4, 4, 4}, {2, 1, 1}).mesh;
  const Topology topology = build_topology(mesh);
  std::vector<double> exact;
  for (const Vec3& x : mesh.nodes) {
    const Vec3 local(x.x() > 4.25 ? x.x() - 4.5 : x.x(), x.y(), x.z());
    exact.push_back(std::min(local.minCoeff(), (Vec3(4, 3, 5) - local).minCoeff()));
  }
  const auto [inner, deep] = compare(mesh, nodal_surface_distance(mesh, topology), exact, kRoundOff);
  EXPECT_GT(inner, 0);
  EXPECT_GT(deep, 0);
}

TEST(NodalSurfaceDistance, IsABoundUnderThinLayersToo) {
  Mesh mesh = make_raster({.cells = {5, 5, 6}}).mesh;
  for (Vec3& x : mesh.nodes) x.z() = x.z() < 2 ? 0.05 * x.z() : x.z() - 1.9;  // two thin layers above thick ones
  const Topology topology = build_topology(mesh);
  const auto exact = by_brute_force(mesh, topology, false);
  const auto [inner, deep] = compare(mesh, nodal_surface_distance(mesh, topology), exact, kRoundOff);
  EXPECT_GT(inner, 0);
  EXPECT_GT(deep, 0);
}

TEST(NodalSurfaceDistance, CountsFacesThatAreCutAsFree) {
  const Mesh mesh = make_raster({.cells = {6, 6, 4}, .slit = {{Vec3(2, 3, 0), Vec3(4, 3, 4)}}}).mesh;
  const Topology whole = build_topology(mesh);
  Topology cut = whole;
  for (const Topology::Face& face : whole.surface_groups.back())
    cut.links[at(face.element)][at(face.face)] = FaceLink();
  const auto distance = nodal_surface_distance(mesh, cut);
  compare(mesh, distance, by_brute_force(mesh, cut, false), kRoundOff);
  const auto without = nodal_surface_distance(mesh, whole);
  bool nearer = false;
  for (std::size_t n = 0; n < distance.size(); ++n) nearer |= distance[n] == 0 && without[n] > 0.4;
  EXPECT_TRUE(nearer);
}

}  // namespace
}  // namespace breccia::point_distance_test
