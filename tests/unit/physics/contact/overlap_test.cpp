#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "scene.hpp"

namespace breccia::overlap_test {
namespace {

constexpr double kRoundOff = 1e-13;

const ContactLaw kLaw{1e6, std::numeric_limits<double>::infinity(), 1, 0, 1};

/// Overlap of a place with a whole body, by going through all its elements; -1 outside.
Overlap overlap_of(const test::Scene& scene, const Vec3& x) {
  for (std::size_t c = 0; c < scene.contact.contactors.size(); ++c) {
    const Index slot = scene.contact.contactors[c];
    const PreparedTetra tetra =
        prepare(load_corners(scene.local, scene.state.position.data(), slot), scene.local.volume[at(slot)]);
    const auto lambda = barycentric(tetra, x);
    if (!inside(lambda)) continue;
    return overlap(overlap_shape(scene.params, scene.local, scene.contact, static_cast<Index>(c)), tetra, lambda);
  }
  return {-1, Vec3::Zero()};
}

double overlap_at(const test::Scene& scene, const Vec3& x) { return overlap_of(scene, x).g; }

TEST(Overlap, OfALoneTetrahedronIsFourTimesTheSmallestBarycentricCoordinate) {
  const test::Scene body(test::lone(test::regular_tetra(2.0)), kLaw);
  const test::Scene potential(test::lone(test::regular_tetra(2.0)), kLaw, 1, OverlapField::tet_potential);
  const auto corners = test::regular_tetra(2.0);
  const double inradius = 2.0 / std::sqrt(24.0);
  EXPECT_NEAR(body.contact.body_length[0], inradius, kRoundOff);
  for (const std::array<double, 4>& l :
       {std::array{0.25, 0.25, 0.25, 0.25}, {0.1, 0.3, 0.4, 0.2}, {0.7, 0.1, 0.15, 0.05}, {0.0, 0.5, 0.2, 0.3}}) {
    const Vec3 x = l[0] * corners[0] + l[1] * corners[1] + l[2] * corners[2] + l[3] * corners[3];
    const double d = 4 * std::min({l[0], l[1], l[2], l[3]});
    EXPECT_NEAR(overlap_at(body, x) / inradius, d, kRoundOff);
    EXPECT_NEAR(overlap_at(potential, x) / inradius, d, kRoundOff);
  }
}

TEST(Overlap, ByDistanceIsTheDistanceToTheNearestFace) {
  const test::Scene scene(test::lone(test::regular_tetra(2.0)), kLaw, 1, OverlapField::tet_distance);
  EXPECT_NEAR(overlap_at(scene, {-0.05, 0, 0}), 0.05, kRoundOff);                                    // base in x = 0
  EXPECT_NEAR(overlap_at(scene, {-2.0 / std::sqrt(24.0), 0, 0}), 2.0 / std::sqrt(24.0), kRoundOff);  // incentre
}

TEST(Overlap, IsNothingInAnElementOfLessThanAHundredthOfItsVolume) {
  for (const double share : {0.012, 0.008}) {
    std::array<Vec3, 4> x = test::regular_tetra(2.0);
    const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
    for (Vec3& corner : x) corner[0] *= share;
    const PreparedTetra tetra = prepare(x, volume);
    EXPECT_EQ(inert(tetra), share < 0.01);
    EXPECT_EQ(inside(barycentric(tetra, 0.25 * (x[0] + x[1] + x[2] + x[3]))), share > 0.01);
  }
}

TEST(Overlap, IsOutOfReachForAsFarAsSafeTravelTells) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  constexpr double kReach = 0.01;
  int outside = 0;
  double least_share = 1;
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<Vec3, 4> x{vector(), vector(), vector(), vector()};
    const Vec3 point = 1.5 * vector();
    if ((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) < 0) std::swap(x[2], x[3]);
    const PreparedTetra tetra = prepare(x, 1e-3);
    const auto lambda = barycentric(tetra, point);
    const double safe = inert(tetra) ? 0.0 : safe_travel(tetra, lambda, kReach);
    EXPECT_EQ(safe > 0, !inert(tetra) && smallest(lambda) < -kReach);
    if (!(safe > 0)) continue;
    ++outside;
    for (int way = 0; way < 20; ++way) {
      std::array<Vec3, 4> moved = x;
      for (Vec3& corner : moved) corner += safe * vector().normalized();
      EXPECT_FALSE(smallest(barycentric(prepare(moved, 0), point + safe * vector().normalized())) >= -kReach);
    }
    // The shortest way: face and point straight towards each other.
    const auto k = static_cast<std::size_t>(std::min_element(lambda.begin(), lambda.end()) - lambda.begin());
    const Vec3 a = x[(k + 1) % 4], outward = (x[(k + 2) % 4] - a).cross(x[(k + 3) % 4] - a).normalized();
    const Vec3 towards = outward.dot(point - a) > 0 ? outward : Vec3(-outward);
    for (Vec3& corner : x) corner += safe * towards;
    const double left = barycentric(prepare(x, 0), point - safe * towards)[k];
    EXPECT_LT(left, -kReach);
    least_share = std::min(least_share, 1 - (left + kReach) / (lambda[k] + kReach));
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(least_share, 0.95) << "of the way that is safe";
}

TEST(Overlap, OfABodyIsTheDepthUnderAFlatFace) {
  const test::Scene scene(test::box({4, 4, 4}, 1.0), kLaw);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> inner(1.0, 3.0), depth(0.0, 0.2);
  for (int i = 0; i < 300; ++i) {
    const double d = depth(random);
    EXPECT_NEAR(overlap_at(scene, {inner(random), inner(random), 4 - d}), d, kRoundOff);
  }
}

/// Direction in which a place in a body is pushed; 0 outside.
Vec3 push_at(const test::Scene& scene, const Vec3& x) { return -overlap_of(scene, x).gradient; }

TEST(Overlap, OfAWallOneElementThickIsTheDistanceToTheNearerSideAndPushesStraight) {
  constexpr int kBricks = 6;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2),
      place(2.5, kBricks - 2.5);  // nearer to the rim it counts as well
  for (const double thickness : {0.2, 0.5, 0.9}) {
    Mesh mesh = test::wall(kBricks, thickness);
    for (Vec3& x : mesh.nodes) x += Vec3(jitter(random), jitter(random), 0);
    const test::Scene scene(std::move(mesh), kLaw);
    std::uniform_real_distribution<double> depth(0, thickness);
    for (int i = 0; i < 200; ++i) {
      const double z = depth(random);
      const Vec3 x(place(random), place(random), z);
      EXPECT_NEAR(overlap_at(scene, x), std::min(z, thickness - z), kRoundOff);
      EXPECT_NEAR((push_at(scene, x) - Vec3(0, 0, z < thickness / 2 ? -1 : 1)).norm(), 0, kRoundOff) << x.transpose();
    }
  }
}

TEST(Overlap, BesideTheEdgeOfAWallOneElementThickIsAShareOfTheDistanceToTheNearestSide) {
  constexpr double kThickness = 0.5;
  constexpr double kLeast = kThickness / 1.0;  // what lies behind a node beside the edge over its distance to the edge
  const test::Scene scene(test::wall(5, kThickness), kLaw);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(1.5, 3.5), depth(0, 0.5), height(0, kThickness);
  for (int i = 0; i < 200; ++i) {
    const double x = depth(random), z = height(random), nearest = std::min({x, z, kThickness - z});
    const double g = overlap_at(scene, {x, place(random), z});
    EXPECT_LE(g, nearest + kRoundOff);
    EXPECT_GE(g, kLeast * nearest - kRoundOff);
  }
}

TEST(Overlap, OfABodyIsContinuousAcrossItsElements) {
  // Irregular bodies: corners between the elements are moved at random.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1), place(0.3, 1.7);
  for (const Mesh& regular : {test::box({2, 2, 2}, 1.0), test::wall(2, 0.6)}) {
    const test::Scene scene(
        test::moved(regular,
                    [&](const Vec3& x) { return Vec3(x + Vec3(jitter(random), jitter(random), jitter(random))); }),
        kLaw);
    const double top = regular.nodes.back()[2];
    constexpr double step = 1e-6, steepest = 10;  // no height is below a tenth of the largest depth
    for (int line = 0; line < 10; ++line) {
      Vec3 x(place(random), place(random), 0.1 * top);
      const Vec3 direction = Vec3(place(random) - 1, place(random) - 1, 0.7 * top).normalized();
      for (int i = 0; i < 400; ++i, x += 0.003 * direction) {
        const double here = overlap_at(scene, x), next = overlap_at(scene, x + step * direction);
        if (here < 0 || next < 0) continue;  // outside
        EXPECT_LT(std::abs(next - here), steepest * step) << x.transpose();
      }
    }
  }
}

/// Force against a central difference of the stored energy over all coordinates of all nodes.
void expect_force_is_gradient(test::Scene& scene, const char* what) {
  constexpr double step = 1e-6;       // of bodies of size 1
  constexpr double tolerance = 1e-7;  // relative to the largest force: step^2 of a smooth energy and round-off / step
  scene.evaluate(1e-6);
  ASSERT_GT(scene.work.touching, 0) << what;
  const NodalForces forces = scene.forces;
  double largest = 0;
  for (Index n = 0; n < scene.local.num_nodes; ++n) largest = std::max(largest, forces.get(n).norm());
  for (Index n = 0; n < scene.local.num_nodes; ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      double& x = scene.state.position[nodal(n, axis)];
      const double x0 = x;
      x = x0 + step;
      scene.evaluate(1e-6);
      const double up = scene.work.stored.value();
      x = x0 - step;
      scene.evaluate(1e-6);
      const double down = scene.work.stored.value();
      x = x0;
      EXPECT_NEAR(forces.get(n)[axis], -(up - down) / (2 * step), tolerance * largest) << what << ", node " << n;
    }
  }
}

TEST(ContactForces, AreTheGradientOfTheStoredEnergyAtAllSevenNodes) {
  std::mt19937_64 random(11);
  for (const OverlapField field : {OverlapField::body, OverlapField::tet_potential, OverlapField::tet_distance}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Mat3 turn = test::random_rotation(random);
      // One corner of the target dips into the contactor so that a face's point does.
      const auto target = test::moved(test::lone(test::regular_tetra(1.0)),
                                      [&](const Vec3& x) { return Vec3(turn * x + Vec3(-0.45, 0.05, 0.02)); });
      test::Scene scene(test::joined(test::lone(test::regular_tetra(1.4)), target), kLaw, 3, field);
      expect_force_is_gradient(scene, "lone tetrahedra");
    }
  }
}

TEST(ContactForces, OfABodyOfManyElementsAreTheGradientOfTheStoredEnergy) {
  std::mt19937_64 random(12);
  const Mat3 turn = test::random_rotation(random);
  const auto target = test::moved(test::lone(test::regular_tetra(0.8)),
                                  [&](const Vec3& x) { return Vec3(turn * x + Vec3(0.8, 0.7, 1.35)); });
  for (const Discretisation kind : {Discretisation::own_nodes, Discretisation::shared_nodes}) {
    test::Scene scene(test::joined(test::box({1, 1, 1}, 1.3), target), kLaw, 6, OverlapField::body, kind);
    expect_force_is_gradient(scene, "cube and tetrahedron");
  }
}

}  // namespace
}  // namespace breccia::overlap_test
