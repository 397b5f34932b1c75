#include "mesh/raster.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/joints.hpp"
#include "mesh/random_rotation.hpp"
#include "mesh/topology.hpp"
#include "sample_meshes.hpp"

namespace breccia::raster_test {
namespace {

using test::node_of;

constexpr double kRoundOff = 1e-13;  // relative; sums of some thousand doubles

double volume_of(const Mesh& mesh, Index e) {
  const auto x = geometry::corners_of(mesh, e);
  return geometry::tetra_volume(x[0], x[1], x[2], x[3]);
}

std::vector<double> volumes_of_bodies(const Mesh& mesh) {
  std::vector<double> volumes(at(mesh.num_bodies), 0);
  for (Index e = 0; e < mesh.num_elements(); ++e) volumes[at(mesh.element_body[at(e)])] += volume_of(mesh, e);
  return volumes;
}

TEST(Raster, OfTheSlitPlateHas442368ElementsAnd98409Nodes) {
  const Mesh mesh = make_raster({.cells = {48, 48, 8},
                                 .cell_size = Vec3::Constant(1.25e-3),
                                 .slit = {{Vec3(0.02, 0.03, 0), Vec3(0.04, 0.03, 0.01)}}})
                        .mesh;
  EXPECT_EQ(mesh.num_elements(), 48 * 48 * 8 * 24);
  EXPECT_EQ(mesh.num_nodes(), 98409);  // 49 49 9 corners, 48 48 8 centres, 2 x 49 48 8 + 48 48 9 face centres
  const Topology topology = build_topology(mesh);
  EXPECT_EQ(find_joints(mesh, topology).size(), 872448u);  // (4 x 442,368 - 4 x 2 (48 48 + 2 x 48 8)) / 2
  ASSERT_EQ(mesh.surface_groups.back(), "raster.slit");
  EXPECT_EQ(topology.surface_groups.back().size(), 2u * 16 * 8 * 4) << "both sides of 16 x 8 squares of 4 triangles";
}

TEST(Raster, FillsEveryBoxWithPositiveElementsAndKeepsBoxesApart) {
  const auto [mesh, report] = test::raster_box({3, 2, 4}, {2, 3, 2});
  EXPECT_EQ(mesh.num_bodies, 12);
  EXPECT_EQ(mesh.num_elements(), 12 * 24 * 24);
  for (Index e = 0; e < mesh.num_elements(); ++e) EXPECT_GT(volume_of(mesh, e), 0.0);
  for (const double volume : volumes_of_bodies(mesh)) EXPECT_NEAR(volume, 24 * 1.0 * 0.75 * 1.25, 24 * kRoundOff);

  std::map<Index, std::set<Index>> bodies_of_node;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (const Index node : mesh.elements[at(e)]) bodies_of_node[node].insert(mesh.element_body[at(e)]);
  }
  for (const auto& [node, bodies] : bodies_of_node) EXPECT_EQ(bodies.size(), 1u);

  // Box (i, j, k) is body i + 2 (j + 3 k) and starts at (i, j, k) x (size + gap).
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const Index body = mesh.element_body[at(e)];
    const Vec3 lower = Vec3(body % 2, body / 2 % 3, body / 6).cwiseProduct(Vec3(3.5, 1.75, 5.125));
    for (int c = 0; c < 4; ++c) {
      const Vec3 local = node_of(mesh, e, c) - lower;
      EXPECT_GE(local.minCoeff(), 0.0);
      EXPECT_GE((Vec3(3, 1.5, 5) - local).minCoeff(), 0.0);
    }
  }
}

TEST(Raster, CutsACubeIntoTwentyFourEqualTetrahedraAboutItsCentre) {
  const Mesh mesh = make_raster({.cell_size = Vec3::Constant(2), .origin = Vec3(-1, -1, -1)}).mesh;
  EXPECT_EQ(mesh.num_elements(), 24);
  EXPECT_EQ(mesh.num_nodes(), 8 + 6 + 1);
  for (Index e = 0; e < 24; ++e) {
    EXPECT_NEAR(volume_of(mesh, e), 8.0 / 24, kRoundOff);
    int centres = 0, face_centres = 0;
    for (int c = 0; c < 4; ++c) {
      const double distance = node_of(mesh, e, c).squaredNorm();
      centres += distance == 0 ? 1 : 0;
      face_centres += distance == 1 ? 1 : 0;
    }
    EXPECT_EQ(centres, 1);
    EXPECT_EQ(face_centres, 1);
  }
}

TEST(Raster, NamesTheSixSidesOfEveryBox) {
  const auto [mesh, report] = test::raster_box({3, 2, 4}, {2, 1, 1});
  const Topology topology = build_topology(mesh);
  ASSERT_EQ(mesh.surface_groups,
            (std::vector<std::string>{"raster.x0", "raster.x1", "raster.y0", "raster.y1", "raster.z0", "raster.z1"}));
  const Vec3 size(3, 1.5, 5);
  std::size_t total = 0;
  for (std::size_t g = 0; g < 6; ++g) {
    const int axis = static_cast<int>(g / 2);
    double area = 0;
    for (const auto& [element, face] : topology.surface_groups[g]) {
      EXPECT_TRUE(topology.links[at(element)][at(face)].free());
      const double offset = mesh.element_body[at(element)] == 1 && axis == 0 ? 3.5 : 0.0;
      const auto& c = kFaceCorners[at(face)];
      for (const int corner : c) {
        EXPECT_EQ(node_of(mesh, element, corner)[axis], offset + (g % 2 == 0 ? 0.0 : size[axis]));
      }
      area += geometry::triangle_area(node_of(mesh, element, c[0]), node_of(mesh, element, c[1]),
                                      node_of(mesh, element, c[2]));
    }
    EXPECT_NEAR(area, 2 * size.prod() / size[axis], 1e-12);
    total += topology.surface_groups[g].size();
  }
  std::size_t free = 0;
  for (const auto& links : topology.links) {
    for (const auto& link : links) free += link.free() ? 1 : 0;
  }
  EXPECT_EQ(total, free);
}

TEST(Raster, FindsASlitGivenInDecimalThoughNodesAreSumsOfBinaryNumbers) {
  const RasterSource::Slit slit{Vec3(0, 0.3, 0), Vec3(0.3, 0.3, 0.2)};  // 3 x 0.1 is above 0.3
  const Mesh mesh = make_raster({.cells = {4, 6, 2}, .cell_size = Vec3::Constant(0.1), .slit = slit}).mesh;
  const Topology topology = build_topology(mesh);
  EXPECT_EQ(topology.surface_groups.back().size(), 3u * 2 * 4 * 2) << "three squares by two, of four triangles, twice";
}

TEST(Raster, MakesRegularTetrahedraCentredInTheirCells) {
  RasterSource source;
  source.boxes = {2, 2, 3};
  source.cell_size = Vec3(0.3, 0.4, 0.5);
  source.gap = Vec3(0.1, 0, 0.25);
  source.origin = Vec3(1, 2, 3);
  source.single_tetrahedra = true;
  for (const bool turned : {false, true}) {
    source.random_orientation = turned;
    const auto [mesh, report] = make_raster(source);
    ASSERT_EQ(mesh.num_elements(), 12);
    EXPECT_EQ(mesh.num_nodes(), 48);
    for (Index e = 0; e < 12; ++e) {
      const auto x = geometry::corners_of(mesh, e);
      for (const auto& [i, j] : geometry::kEdges) EXPECT_NEAR((x[at(i)] - x[at(j)]).norm(), 0.3, kRoundOff);
      EXPECT_GT(volume_of(mesh, e), 0);
      const Index body = mesh.element_body[at(e)];
      const Vec3 centre =
          Vec3(1.15, 2.2, 3.25) + Vec3(body % 2, body / 2 % 2, body / 4).cwiseProduct(Vec3(0.4, 0.4, 0.75));
      EXPECT_LT((0.25 * (x[0] + x[1] + x[2] + x[3]) - centre).norm(), kRoundOff * 10);
    }
  }
}

TEST(Raster, TurnsEveryBoxAboutItsCentreAndRepeatsForTheSameSeed) {
  RasterSource source;
  source.cells = {2, 1, 1};
  source.boxes = {3, 2, 1};
  source.random_orientation = true;
  source.seed = 42;
  const Mesh mesh = make_raster(source).mesh, again = make_raster(source).mesh;
  EXPECT_EQ(mesh.nodes, again.nodes);
  EXPECT_EQ(mesh.elements, again.elements);
  source.seed = 43;
  EXPECT_NE(mesh.nodes, make_raster(source).mesh.nodes);

  for (const double volume : volumes_of_bodies(mesh)) EXPECT_NEAR(volume, 2.0, 2 * kRoundOff);
  std::vector<Vec3> lower(6, Vec3::Constant(1e9)), centroid(6, Vec3::Zero());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    const auto body = at(mesh.element_body[at(e)]);
    centroid[body] += volume_of(mesh, e) / 2.0 * 0.25 * (x[0] + x[1] + x[2] + x[3]);
    for (const Vec3& corner : x) lower[body] = lower[body].cwiseMin(corner);
  }
  for (Index body = 0; body < 6; ++body) {
    const Vec3 centre(1 + 2 * (body % 3), 0.5 + body / 3, 0.5);
    EXPECT_LT((centroid[at(body)] - centre).norm(), 1e-12);
    EXPECT_GT((lower[at(body)] - (centre - Vec3(1, 0.5, 0.5))).norm(), 1e-3) << "not turned";
    if (body == 0) continue;
    const Vec3 below = lower[at(body)] - centroid[at(body)], before = lower[at(body - 1)] - centroid[at(body - 1)];
    EXPECT_GT((below - before).norm(), 1e-3) << "turned as the box before it";
  }
}

TEST(RandomRotation, IsAProperRotationUniformOverAllRotations) {
  constexpr int kDraws = 40000;
  constexpr double kFiveSigma = 5.0 / 200.0;  // 5 / sqrt(kDraws), for a mean of terms of standard deviation below 1
  Mat3 sum = Mat3::Zero(), squares = Mat3::Zero();
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Mat3 r = random_rotation(9, n);
    ASSERT_LT((r * r.transpose() - Mat3::Identity()).norm(), 1e-14);
    ASSERT_GT(r.col(0).cross(r.col(1)).dot(r.col(2)), 0);
    sum += r;
    squares += r.cwiseProduct(r);
  }
  EXPECT_LT((sum / kDraws).cwiseAbs().maxCoeff(), kFiveSigma);  // every entry has mean 0 and mean square 1/3
  EXPECT_LT((squares / kDraws - Mat3::Constant(1.0 / 3)).cwiseAbs().maxCoeff(), kFiveSigma);
}

TEST(RandomRotation, DrawsDifferentNumbersForEverySeedStreamAndPlace) {
  std::set<std::uint64_t> drawn;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t stream = 0; stream < 10; ++stream) {
      for (std::uint64_t k = 0; k < 10; ++k) drawn.insert(random_bits(seed, stream, k));
    }
  }
  EXPECT_EQ(drawn.size(), 1000u);
}

struct BadRaster {
  const char* name;
  void (*spoil)(RasterSource&);
  const char* message;
};

class RasterRefuses : public testing::TestWithParam<BadRaster> {};

TEST_P(RasterRefuses, WithAMessageThatNamesTheKey) {
  RasterSource source;
  GetParam().spoil(source);
  try {
    (void)make_raster(source);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Raster, RasterRefuses,
    testing::Values(
        BadRaster{"NoCells", [](RasterSource& s) { s.cells[1] = 0; },
                  "mesh.raster.cells: needs at least one cell along each axis; allowed: >= 1; given: [1, 0, 1]"},
        BadRaster{"NoBoxes", [](RasterSource& s) { s.boxes[2] = -3; }, "mesh.raster.boxes: needs at least one box"},
        BadRaster{"FlatCells", [](RasterSource& s) { s.cell_size.z() = 0; }, "mesh.raster.cell_size: is no size"},
        BadRaster{"InfiniteOrigin", [](RasterSource& s) { s.origin.x() = std::numeric_limits<double>::infinity(); },
                  "mesh.raster.origin: is no point"},
        BadRaster{"NegativeGap", [](RasterSource& s) { s.gap.y() = -0.1; }, "would make boxes overlap"},
        BadRaster{"TooMany",
                  [](RasterSource& s) {
                    s.cells = {2000, 2000, 2000};
                  },
                  "makes too many tetrahedra"},
        BadRaster{"TetrahedraInCells", [](RasterSource& s) { s.single_tetrahedra = true, s.cells[0] = 2; },
                  "a box of a single tetrahedron is one cell"},
        BadRaster{"SlitWithVolume",
                  [](RasterSource& s) {
                    s.slit = RasterSource::Slit{Vec3(0, 0, 0), Vec3(1, 1, 1)};
                  },
                  "mesh.raster.slit: is no plane rectangle"},
        BadRaster{"SlitBesideTheFaces",
                  [](RasterSource& s) {
                    s.slit = RasterSource::Slit{Vec3(0, 0.3, 0), Vec3(1, 0.3, 1)};
                  },
                  "mesh.raster.slit: meets no face of the raster"}),
    [](const auto& run) { return run.param.name; });

TEST(Raster, NamesAllProblemsAtOnce) {
  RasterSource source;
  source.cells[0] = 0;
  source.gap.x() = -1;
  try {
    (void)make_raster(source);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
  }
}

}  // namespace
}  // namespace breccia::raster_test
