#include "domains/piece_mesh.hpp"

#include "domains/mesh_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/state/sample_records.hpp"

namespace breccia {
namespace {

using test::at;
using test::cubes;
using test::marks;
using test::records_of;

WholeModel whole_of(const Mesh& mesh) {
  WholeModel whole;
  whole.source = mesh.source;
  whole.volume_groups = mesh.volume_groups;
  whole.surface_groups = mesh.surface_groups;
  whole.body_length.assign(at(mesh.num_bodies), 1.0);
  return whole;
}

TEST(Records, OfAWholeMeshMakeThatMeshAgain) {
  const Mesh mesh = cubes();
  const Topology topology = build_topology(mesh);
  const Records records = records_of(mesh, topology);
  const Mesh again = mesh_of(records, whole_of(mesh));
  EXPECT_EQ(again.elements, mesh.elements);
  ASSERT_EQ(again.nodes.size(), mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) EXPECT_EQ(again.nodes[n], mesh.nodes[n]);
  EXPECT_EQ(again.volume_groups, mesh.volume_groups);
  const Topology links = topology_of(records, again);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (std::size_t f = 0; f < 4; ++f) {
      EXPECT_EQ(links.links[at(e)][f].neighbour, topology.links[at(e)][f].neighbour);
      EXPECT_EQ(links.links[at(e)][f].code, topology.links[at(e)][f].code);
    }
  }
  for (std::size_t g = 0; g < topology.surface_groups.size(); ++g) {
    EXPECT_EQ(links.surface_groups[g].size(), topology.surface_groups[g].size());
  }
}

TEST(Records, OfAPieceKeepIdsAndTellFreeFacesFromElementsBeyond) {
  const Mesh mesh = cubes();
  const Topology topology = build_topology(mesh);
  Records piece = records_of(mesh, topology);
  keep(piece, marks(piece, [](GlobalId id) { return id % 5 != 0; }));
  const Mesh part = mesh_of(piece, whole_of(mesh));
  const Topology links = topology_of(piece, part);
  EXPECT_TRUE(std::is_sorted(part.element_ids.begin(), part.element_ids.end()));
  EXPECT_TRUE(std::is_sorted(part.node_ids.begin(), part.node_ids.end()));
  Index beyond = 0;
  for (Index e = 0; e < part.num_elements(); ++e) {
    const auto id = static_cast<std::size_t>(part.element_id(e));
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(part.node_id(part.elements[at(e)][c]), mesh.elements[id][c]);
    for (std::size_t f = 0; f < 4; ++f) {
      const FaceLink& there = links.links[at(e)][f];
      const Index expected = topology.links[id][f].neighbour;
      if (expected < 0) {
        EXPECT_TRUE(there.free());
      } else if (expected % 5 == 0) {
        EXPECT_EQ(there.neighbour, FaceLink::kBeyond);
        ++beyond;
      } else {
        EXPECT_EQ(part.element_id(there.neighbour), expected);
      }
    }
  }
  EXPECT_GT(beyond, 10);
}

TEST(Records, MadeOfAPieceStillKnowTheNeighboursBeyondIt) {
  const Mesh mesh = cubes();
  Records piece = records_of(mesh, build_topology(mesh));
  keep(piece, marks(piece, [](GlobalId id) { return id % 5 != 0; }));
  const Mesh part = mesh_of(piece, whole_of(mesh));
  const Topology links = topology_of(piece, part);
  for (Index e = 0; e < part.num_elements(); ++e) {
    const ElementRecord again = mesh_record(part, links, e);
    EXPECT_EQ(again.neighbour, piece.elements[at(e)].neighbour);
    EXPECT_EQ(again.code, piece.elements[at(e)].code);
  }
}

TEST(WholeModel, ArrivesAsItWasSent) {
  WholeModel whole = whole_of(cubes());
  whole.num_elements = 144;
  whole.joint_groups = {{0, 0, 0.5}, {0, 2, 0.25}};
  whole.step_ratio = 1.75;
  const WholeModel there = unpack_whole(pack(whole));
  EXPECT_EQ(there.volume_groups, whole.volume_groups);
  EXPECT_EQ(there.surface_groups, whole.surface_groups);
  EXPECT_EQ(there.num_elements, 144);
  ASSERT_EQ(there.joint_groups.size(), 2U);
  EXPECT_EQ(there.joint_groups[1].b, 2);
  EXPECT_EQ(there.joint_groups[1].size, 0.25);
  EXPECT_EQ(there.step_ratio, 1.75);
  EXPECT_EQ(there.body_length, whole.body_length);
}

}  // namespace
}  // namespace breccia
