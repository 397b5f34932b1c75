#include "mesh/finish.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/space_curve.hpp"
#include "mesh/topology.hpp"
#include "sample_meshes.hpp"

namespace breccia::finish_test {
namespace {

using testing::HasSubstr;

/// Two tetrahedra on the face (1 2 3), one body each, the face also a physical surface; node 5 belongs to none.
Mesh two_tetrahedra() {
  Mesh mesh;
  mesh.source = "by_hand.msh";
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {7, 7, 7}};
  mesh.elements = {{0, 1, 2, 3}, {4, 1, 3, 2}};
  mesh.element_group = {1, 0};
  mesh.element_body = {0, 1};
  mesh.element_source_id = {501, 502};
  mesh.surface_faces = {{{1, 2, 3}, 0}, {{0, 1, 2}, 1}};
  mesh.volume_groups = {"second", "first"};
  mesh.surface_groups = {"between", "below"};
  mesh.num_bodies = 2;
  return mesh;
}

std::string refusal_of(Mesh mesh, FinishOptions options = {}) {
  try {
    (void)finish_mesh(std::move(mesh), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Finish, GivesEveryUngluedBodyItsOwnNodesAndItsSideOfTheSurface) {
  const auto [mesh, report] = finish_mesh(two_tetrahedra(), {});
  EXPECT_EQ(mesh.num_nodes(), 8);
  EXPECT_EQ(report.split_nodes, 3);
  EXPECT_EQ(report.orphan_nodes, 1);
  EXPECT_EQ(report.inverted_repaired, 0);
  const Topology topology = build_topology(mesh);
  for (const auto& links : topology.links) {
    for (const auto& link : links) EXPECT_TRUE(link.free());
  }
  std::set<Index> sides;
  for (const auto& [element, face] : topology.surface_groups[0]) sides.insert(element);
  EXPECT_EQ(sides, (std::set<Index>{0, 1}));
  EXPECT_EQ(topology.surface_groups[1].size(), 1u);
  EXPECT_EQ(report.surface_groups[0].count, 2);
}

TEST(Finish, KeepsTheSharedNodesOfGluedBodies) {
  const auto [mesh, report] = finish_mesh(two_tetrahedra(), {.glue = true});
  EXPECT_EQ(mesh.num_nodes(), 5);
  EXPECT_EQ(report.split_nodes, 0);
  const Topology topology = build_topology(mesh);
  int inner = 0;
  for (const auto& links : topology.links) {
    for (const auto& link : links) inner += link.free() ? 0 : 1;
  }
  EXPECT_EQ(inner, 2);
  EXPECT_EQ(topology.surface_groups[0].size(), 2u);
}

TEST(Finish, LeavesOutGroupsOfEveryKindThatNothingIsInAndNamesThem) {
  Mesh mesh = two_tetrahedra();
  const FinishedMesh whole = finish_mesh(two_tetrahedra(), {});
  mesh.volume_groups.insert(mesh.volume_groups.begin(), "no volume");
  for (Index& group : mesh.element_group) ++group;
  mesh.surface_groups.insert(mesh.surface_groups.begin(), "no surface");
  for (auto& face : mesh.surface_faces) ++face.group;
  mesh.node_groups.push_back("no node");
  const auto [finished, report] = finish_mesh(std::move(mesh), {});
  EXPECT_EQ(finished.volume_groups, whole.mesh.volume_groups);
  EXPECT_EQ(finished.element_group, whole.mesh.element_group);
  EXPECT_EQ(finished.surface_groups, whole.mesh.surface_groups);
  EXPECT_EQ(finished.node_groups, whole.mesh.node_groups);
  EXPECT_EQ(report.empty_groups, (std::vector<std::string>{"no volume", "no surface", "no node"}));
}

TEST(Finish, CountsASurfaceTriangleOnceThatStandsTwiceInTheFile) {
  Mesh mesh = two_tetrahedra();
  mesh.surface_faces.push_back({{1, 0, 2}, 1});  // the last one again, the other way round
  const auto [finished, report] = finish_mesh(std::move(mesh), {.glue = true});
  EXPECT_EQ(finished.surface_faces.size(), 2u);
  EXPECT_EQ(report.surface_groups[1].count, 1);
}

TEST(Finish, SortsByGroupAndKeepsWhatBelongsToAnElement) {
  const auto [mesh, report] = finish_mesh(two_tetrahedra(), {.glue = true});
  EXPECT_EQ(mesh.element_group, (std::vector<Index>{0, 1}));
  EXPECT_EQ(mesh.element_source_id, (std::vector<std::int64_t>{502, 501}));
  EXPECT_EQ(mesh.element_volume, (std::vector<Index>{1, 0}));
  EXPECT_EQ(mesh.element_body, (std::vector<Index>{0, 0})) << "glued, they are one body";
  EXPECT_EQ(report.volume_groups[0].name, "second");
  EXPECT_EQ(report.volume_groups[0].count, 1);
}

TEST(Finish, TurnsInvertedElementsOrRefusesThemWithTheirIds) {
  Mesh mesh = two_tetrahedra();
  std::swap(mesh.elements[1][0], mesh.elements[1][1]);
  const auto [repaired, report] = finish_mesh(mesh, {});
  EXPECT_EQ(report.inverted_repaired, 1);
  for (Index e = 0; e < 2; ++e) {
    const auto x = geometry::corners_of(repaired, e);
    EXPECT_GT(geometry::tetra_volume(x[0], x[1], x[2], x[3]), 0);
  }
  EXPECT_THAT(refusal_of(mesh, {.repair_inverted = false}),
              testing::AllOf(HasSubstr("by_hand.msh"), HasSubstr("inverted elements"), HasSubstr("502 (1 element)"),
                             HasSubstr("mesh.inverted = \"repair\"")));
}

TEST(Finish, RefusesCoordinatesAndEdgesThatCannotBeComputedWithAsSuch) {
  for (const double scale : {1e200, 1e-200}) {
    Mesh mesh = two_tetrahedra();
    for (Vec3& x : mesh.nodes) x *= scale;
    EXPECT_THAT(refusal_of(mesh, {}), HasSubstr("of a size or place that cannot be computed with")) << scale;
  }
}

TEST(Finish, RefusesElementsWhoseStrainsAreRoundOffWhereTheyLie) {
  for (const double distance : {1e9, 1e12}) {  // of edges of about 1
    Mesh mesh = two_tetrahedra();
    for (Vec3& x : mesh.nodes) x.y() += distance;
    if (distance < 1e10)
      EXPECT_EQ(refusal_of(mesh, {}), "accepted");
    else
      EXPECT_THAT(refusal_of(mesh, {}), HasSubstr("so far from the origin that their strains are round-off"));
  }
}

TEST(Finish, RefusesFlatElementsWithTheFirstTenIdsAndTheCount) {
  Mesh mesh;
  mesh.source = "flat.msh";
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  for (int e = 0; e < 13; ++e) {
    mesh.elements.push_back({0, 1, 2, 3});
    mesh.element_group.push_back(0);
    mesh.element_body.push_back(0);
    mesh.element_source_id.push_back(100 + e);
  }
  mesh.volume_groups = {"all"};
  mesh.num_bodies = 1;
  EXPECT_THAT(
      refusal_of(mesh),
      HasSubstr("elements of zero volume; allowed: tetrahedra with a volume; given: element 100, 101, 102, 103, "
                "104, 105, 106, 107, 108, 109, ... (13 elements)"));
  mesh.nodes[3].z() = 1e-11;  // a height of 1e-11 edges is flat, whatever the unit of length
  EXPECT_THAT(refusal_of(mesh), HasSubstr("zero volume"));
  mesh.nodes[3].z() = 1e-6;
  EXPECT_THAT(refusal_of(mesh), testing::Not(HasSubstr("zero volume"))) << "thin, but with a volume";
  mesh.nodes[3].z() = 1e-11;
  for (Vec3& node : mesh.nodes) node *= 1e6;
  EXPECT_THAT(refusal_of(mesh), HasSubstr("zero volume"));
}

/// The two tetrahedra with the nodes of their face twice, a hair apart, as parts that were meshed one by one have them.
Mesh doubled(double apart) {
  Mesh mesh = two_tetrahedra();
  mesh.nodes[5] = mesh.nodes[1] + Vec3(apart, 0, 0);
  mesh.nodes.push_back(mesh.nodes[2] - Vec3(0, apart, 0));
  mesh.nodes.push_back(mesh.nodes[3] + Vec3(apart, -apart, apart));
  mesh.elements[1] = {4, 5, 7, 6};
  mesh.surface_faces.push_back({{5, 6, 7}, 0});
  return mesh;
}

TEST(Finish, MergesNodesOfPartsThatAreToBeGluedAndSaysHowMany) {
  constexpr double kApart = 1e-5, kMerge = 2e-5;
  const auto [apart, untouched] = finish_mesh(doubled(kApart), {.glue = true});
  EXPECT_EQ(untouched.merged_nodes, 0);
  EXPECT_EQ(apart.num_bodies, 2);
  const auto [mesh, report] = finish_mesh(doubled(kApart), {.glue = true, .merge_nodes = kMerge});
  EXPECT_EQ(report.merged_nodes, 3);
  EXPECT_EQ(mesh.num_nodes(), 5);
  EXPECT_EQ(mesh.num_bodies, 1);
  EXPECT_EQ(report.surface_groups[0].count, 1) << "the triangle is the same on both sides";
  const auto [short_of, none] = finish_mesh(doubled(kApart), {.glue = true, .merge_nodes = 0.5 * kApart});
  EXPECT_EQ(none.merged_nodes, 0);
}

TEST(Finish, MergesNodesWithinAVolumeOnlyWhereVolumesAreNotGlued) {
  constexpr double kApart = 1e-5, kMerge = 2e-5;
  const auto [parts, of_two] = finish_mesh(doubled(kApart), {.merge_nodes = kMerge});
  EXPECT_EQ(of_two.merged_nodes, 0);
  EXPECT_EQ(parts.num_bodies, 2);
  Mesh one = doubled(kApart);
  one.element_body = {0, 0};
  one.num_bodies = 1;
  const auto [joined, of_one] = finish_mesh(std::move(one), {.merge_nodes = kMerge});
  EXPECT_EQ(of_one.merged_nodes, 3);
  EXPECT_EQ(joined.num_bodies, 1);
}

TEST(Finish, RefusesToMergeNodesWhereAnElementWouldCollapse) {
  for (const double distance : {1.0, 2.0})  // an edge, and all nodes
    EXPECT_THAT(refusal_of(two_tetrahedra(), {.glue = true, .merge_nodes = distance}),
                testing::AllOf(HasSubstr("mesh.merge_nodes: elements would collapse as their nodes are merged"),
                               HasSubstr("far below the shortest edge"), HasSubstr("element 501")));
}

TEST(Finish, AcceptsTinyMeshes) {
  Mesh mesh = two_tetrahedra();
  for (Vec3& node : mesh.nodes) node *= 1e-9;
  EXPECT_EQ(refusal_of(mesh), "accepted");
}

TEST(Finish, RefusesCoordinatesThatAreNotFinite) {
  Mesh mesh = two_tetrahedra();
  mesh.nodes[0].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of(mesh), testing::AllOf(HasSubstr("not finite"), HasSubstr("501 (1 element)")));
  mesh = two_tetrahedra();
  mesh.nodes[1].x() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal_of(mesh), testing::AllOf(HasSubstr("not finite"), HasSubstr("501, 502 (2 elements)")));
  mesh = two_tetrahedra();
  mesh.nodes[5].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of(mesh), "accepted") << "an orphan node does not matter";
}

TEST(Finish, RefusesAMeshWithoutTetrahedra) {
  Mesh mesh = two_tetrahedra();
  mesh.elements.clear();
  EXPECT_THAT(refusal_of(mesh), HasSubstr("by_hand.msh: mesh: the mesh has no tetrahedra"));
}

TEST(Finish, RefusesASurfaceOfNoFace) {
  Mesh mesh = two_tetrahedra();
  mesh.surface_faces.push_back({{0, 1, 5}, 1});
  EXPECT_THAT(refusal_of(mesh), testing::AllOf(HasSubstr("surface group \"below\""), HasSubstr("1 such triangles")));
}

TEST(Finish, CountsNodesThatCoincide) {
  Mesh mesh = two_tetrahedra();
  EXPECT_EQ(finish_mesh(mesh, {}).report.duplicate_nodes, 0);
  // The second element gets nodes of its own, a billionth of a millimetre away at most.
  mesh.nodes.push_back(mesh.nodes[1] + Vec3(4e-10, 0, 0));
  mesh.nodes.push_back(mesh.nodes[2] + Vec3(0, -4e-10, 4e-10));
  mesh.elements[1] = {4, 6, 3, 7};
  mesh.surface_faces.clear();
  EXPECT_EQ(finish_mesh(mesh, {}).report.duplicate_nodes, 2);
  mesh.nodes[6].x() += 1e-8;
  EXPECT_EQ(finish_mesh(mesh, {}).report.duplicate_nodes, 1);
}

/// The same mesh with elements, nodes and surface triangles in another order.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  const auto order_of = [&](std::size_t n) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
  };
  Mesh result = mesh;
  const auto nodes = order_of(mesh.nodes.size()), elements = order_of(mesh.elements.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) result.nodes[at(nodes[n])] = mesh.nodes[n];
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto to = at(elements[e]);
    for (std::size_t c = 0; c < 4; ++c) result.elements[to][c] = nodes[at(mesh.elements[e][c])];
    result.element_group[to] = mesh.element_group[e];
    result.element_body[to] = mesh.element_body[e];
    result.element_source_id[to] = mesh.element_source_id[e];
  }
  for (auto& face : result.surface_faces) {
    for (Index& node : face.nodes) node = nodes[at(node)];
  }
  std::reverse(result.surface_faces.begin(), result.surface_faces.end());
  return result;
}

TEST(Finish, GivesTheSameMeshWhateverTheOrderInTheFile) {
  const Mesh mesh = test::two_boxes("finish_order", 0.3, true).mesh;
  for (const unsigned seed : {1u, 2u}) {
    const Mesh again = finish_mesh(shuffled(mesh, seed), {.glue = true}).mesh;
    EXPECT_EQ(again.elements, mesh.elements);
    EXPECT_EQ(again.nodes, mesh.nodes);
    EXPECT_EQ(again.element_source_id, mesh.element_source_id);
    EXPECT_EQ(again.element_body, mesh.element_body);
    const Topology a = build_topology(mesh), b = build_topology(again);
    ASSERT_EQ(a.surface_groups.size(), b.surface_groups.size());
    for (std::size_t g = 0; g < a.surface_groups.size(); ++g) {
      EXPECT_TRUE(std::equal(a.surface_groups[g].begin(), a.surface_groups[g].end(), b.surface_groups[g].begin(),
                             b.surface_groups[g].end(),
                             [](const auto& x, const auto& y) { return x.element == y.element && x.face == y.face; }));
    }
  }
}

TEST(Finish, NumbersNodesInTheOrderTheElementsTouchThem) {
  const Mesh mesh = test::raster_box({3, 2, 2}, {2, 1, 1}).mesh;
  Index next = 0;
  for (const auto& corners : mesh.elements) {
    for (const Index node : corners) {
      ASSERT_LE(node, next);
      if (node == next) ++next;
    }
  }
  EXPECT_EQ(next, mesh.num_nodes());
}

TEST(Finish, KeepsNeighboursNearInTheOrder) {
  // Consecutive elements of a raster of n^3 cubes lie in the same cube or in one nearby: the mean distance of
  // consecutive centroids must be a fraction of a cube, where a random order would give about half of the box.
  const Mesh mesh = finish_mesh(shuffled(test::raster_box({8, 8, 8}).mesh, 3), {}).mesh;
  const auto centroid = [&](Index e) {
    const auto x = geometry::corners_of(mesh, e);
    return Vec3(0.25 * (x[0] + x[1] + x[2] + x[3]));
  };
  double sum = 0;
  for (Index e = 1; e < mesh.num_elements(); ++e) sum += (centroid(e) - centroid(e - 1)).norm();
  EXPECT_LT(sum / (mesh.num_elements() - 1), 1.0);
}

TEST(Finish, PreservesTheVolumeOfTheBoxes) {
  for (const bool glue : {false, true}) {
    const Mesh mesh = test::two_boxes("finish_volume", 0.25, glue).mesh;
    std::map<Index, double> volume;
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      const auto x = geometry::corners_of(mesh, e);
      const double v = geometry::tetra_volume(x[0], x[1], x[2], x[3]);
      EXPECT_GT(v, 0);
      volume[mesh.element_group[at(e)]] += v;
    }
    EXPECT_NEAR(volume[0], 1.0, 1e-12);
    EXPECT_NEAR(volume[1], 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace breccia::finish_test
