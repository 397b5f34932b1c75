#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <map>

#include "base/index.hpp"
#include "discretisation/local_mesh.hpp"
#include "mesh/raster.hpp"

namespace breccia::local_mesh_test {
namespace {

constexpr double kRounding = 1e-12;

Mesh cubes() { return make_raster({.cells = {1, 2, 1}, .random_orientation = true}).mesh; }

class LocalMeshOf : public testing::TestWithParam<Discretisation> {};
INSTANTIATE_TEST_SUITE_P(Discretisations, LocalMeshOf,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(LocalMeshOf, AModelHasItsMassAndVolume) {
  const LocalMesh mesh = build_local_mesh(cubes(), {GetParam()}, {700.0});
  double volume = 0, mass = 0;
  for (const double v : mesh.volume) volume += v;
  for (Index n = 0; n < mesh.num_nodes; ++n) mass += mesh.node_id[at(n)] < 0 ? 0.0 : mesh.node_mass[at(n)];
  EXPECT_NEAR(volume, 2.0, kRounding);
  EXPECT_NEAR(mass, 1400.0, 1400 * kRounding);
}

TEST_P(LocalMeshOf, AModelMapsEdgesToTheIdentity) {
  const Mesh model = cubes();
  const LocalMesh mesh = build_local_mesh(model, {GetParam()}, {700.0});
  for (Index s = 0; s < mesh.num_slots; ++s) {
    Mat3 inverse, edges;
    for (Eigen::Index i = 0; i < 9; ++i)
      inverse(i / 3, i % 3) = mesh.gradient[at(s) / 8 * 72 + static_cast<std::size_t>(i) * 8 + at(s) % 8];
    for (int c = 1; c < 4; ++c) {
      edges.col(c - 1) = load_node(mesh.reference.data(), mesh.corner_node(s, c)) -
                         load_node(mesh.reference.data(), mesh.corner_node(s, 0));
    }
    EXPECT_LT((edges * inverse - Mat3::Identity()).norm(), 100 * kRounding) << s;
  }
}

TEST_P(LocalMeshOf, AModelKeepsCornersVerticesAndIds) {
  const Mesh model = cubes();
  const LocalMesh mesh = build_local_mesh(model, {GetParam()}, {700.0});
  for (Index e = 0; e < model.num_elements(); ++e) {
    const Index slot = mesh.slot_of_element[at(e)];
    ASSERT_EQ(mesh.element_of_slot[at(slot)], e);
    for (int c = 0; c < 4; ++c) {
      const Index vertex = model.elements[at(e)][at(c)];
      EXPECT_EQ(mesh.vertex[at(slot)][at(c)], vertex);
      EXPECT_EQ(load_node(mesh.reference.data(), mesh.corner_node(slot, c)), model.nodes[at(vertex)]);
      EXPECT_EQ(mesh.node_id[at(mesh.corner_node(slot, c))],
                GetParam() == Discretisation::own_nodes ? 4 * e + c : kFirstSharedNode + vertex);
    }
  }
}

TEST_P(LocalMeshOf, TwoRanksCountsEachNodeOnOneOfThem) {
  const Mesh model = cubes();
  std::map<GlobalId, int> counted;
  for (const std::size_t rank : {0u, 1u}) {
    std::vector<std::uint8_t> original(model.elements.size());
    for (std::size_t e = 0; e < original.size(); ++e) original[e] = (e / 5 % 2 == rank) ? 1 : 0;
    const LocalMesh mesh = build_local_mesh(model, {GetParam()}, {700.0}, original);
    for (Index n = 0; n < mesh.num_nodes; ++n) {
      if (mesh.node_id[at(n)] >= 0) {
        counted[mesh.node_id[at(n)]] += mesh.counted[at(n)];
      } else {
        EXPECT_EQ(mesh.counted[at(n)], 0) << "padding";
      }
    }
  }
  EXPECT_EQ(counted.size(), GetParam() == Discretisation::own_nodes ? 4 * model.elements.size() : model.nodes.size());
  for (const auto& [node, times] : counted) EXPECT_EQ(times, 1) << node;
}

TEST(LocalMesh, PutsOwnNodeGroupsFirstInWholeBlocksOfOneGroup) {
  Mesh model = cubes();  // 48 elements, now of three groups
  model.volume_groups = {"a", "b", "c"};
  for (Index e = 0; e < 48; ++e) model.element_group[at(e)] = e < 9 ? 0 : (e < 20 ? 1 : 2);
  const LocalMesh mesh = build_local_mesh(
      model, {Discretisation::own_nodes, Discretisation::shared_nodes, Discretisation::own_nodes}, {1, 1, 1});
  EXPECT_EQ(mesh.num_own_slots, 16 + 32);
  EXPECT_EQ(mesh.num_slots, 48 + 16);
  EXPECT_EQ(mesh.num_own_nodes(), 4 * 48);
  EXPECT_EQ(mesh.block_group, (std::vector<Index>{0, 0, 2, 2, 2, 2, 1, 1}));
  for (Index s = 0; s < mesh.num_slots; ++s) {
    const GlobalId e = mesh.element_of_slot[at(s)];
    if (e >= 0) {
      EXPECT_EQ(model.element_group[static_cast<std::size_t>(e)], mesh.block_group[at(s) / 8]);
    } else {
      EXPECT_EQ(mesh.volume[at(s)], 0.0);
      for (int c = 0; c < 4; ++c) EXPECT_EQ(mesh.node_mass[at(mesh.corner_node(s, c))], 1.0);
    }
  }
}

}  // namespace
}  // namespace breccia::local_mesh_test
