#include "domains/piece_mesh.hpp"

#include "base/error.hpp"
#include "domains/mesh_records.hpp"
#include "domains/possible_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "unit/state/sample_records.hpp"

namespace breccia::piece_mesh_test {
namespace {
using test::cubes;
using test::marks;
using test::records_of;

WholeModel whole_of(const Mesh& mesh) {
  WholeModel whole;
  whole.source = mesh.source;
  whole.volume_groups = mesh.volume_groups;
  whole.surface_groups = mesh.surface_groups;
  whole.group_sizes.volume_mass.assign(mesh.volume_groups.size(), 3.0);
  whole.group_sizes.surface_area.assign(mesh.surface_groups.size(), 4.0);
  whole.body_length.assign(at(mesh.num_bodies), 1.0);
  whole.body_extent.assign(at(mesh.num_bodies), 2.0);
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
  whole.node_groups = {"edge", "tip"};
  whole.group_sizes.node_group_mass = {5.0, 6.0};
  whole.joint_groups = {{0, 0, 0.5}, {0, 2, 0.25}};
  whole.step_ratio = 1.75;
  const WholeModel there = unpack_whole(pack(whole));
  EXPECT_EQ(there.volume_groups, whole.volume_groups);
  EXPECT_EQ(there.surface_groups, whole.surface_groups);
  EXPECT_EQ(there.node_groups, whole.node_groups);
  EXPECT_EQ(there.num_elements, 144);
  ASSERT_EQ(there.joint_groups.size(), 2U);
  EXPECT_EQ(there.joint_groups[1].b, 2);
  EXPECT_EQ(there.joint_groups[1].size, 0.25);
  EXPECT_EQ(there.step_ratio, 1.75);
  EXPECT_EQ(there.body_length, whole.body_length);
  EXPECT_EQ(there.body_extent, whole.body_extent);
  EXPECT_EQ(there.group_sizes.volume_mass, whole.group_sizes.volume_mass);
  EXPECT_EQ(there.group_sizes.surface_area, whole.group_sizes.surface_area);
  EXPECT_EQ(there.group_sizes.node_group_mass, whole.group_sizes.node_group_mass);
}

TEST(Records, ThatPointBeyondTheirModelAreNotPossible) {
  const Mesh mesh = cubes();
  const Records sound = records_of(mesh, build_topology(mesh));
  WholeModel whole = whole_of(mesh);
  whole.num_elements = mesh.num_elements();
  whole.joint_groups.push_back({0, 0, 1.0});
  EXPECT_TRUE(are_possible(sound, whole));
  EXPECT_NO_THROW(demand_possible("a.h5", pack(whole), sound));
  const std::vector<std::function<void(Records&)>> faults{
      [](Records& r) { r.elements[2].group = 1; },          [](Records& r) { r.elements[2].group = -1; },
      [](Records& r) { r.elements[2].body = 1000; },        [](Records& r) { r.elements[2].vertex[1] = -7; },
      [](Records& r) { r.elements[2].neighbour[3] = 999; }, [](Records& r) { r.elements[2].code[0] = 12; },
      [](Records& r) { r.joints[1].joint.law = 1; },        [](Records& r) { r.joints[1].joint.face_a = 4; },
      [](Records& r) { r.joints[1].other = -1; },           [](Records& r) { r.holds[1].axis = 3; },
      [](Records& r) { r.holds[1].corner = -1; },           [](Records& r) { r.corners[1].group = 99; },
      [](Records& r) { r.faces.push_back({0, 99, 0}); },    [](Records& r) { r.couples.push_back({0, 999, 0, {}}); }};
  for (std::size_t f = 0; f < faults.size(); ++f) {
    Records changed = sound;
    faults[f](changed);
    EXPECT_FALSE(are_possible(changed, whole)) << f;
    EXPECT_THROW(demand_possible("a.h5", pack(whole), changed), InputError) << f;
  }
  std::vector<std::byte> cut = pack(whole);
  cut.resize(cut.size() / 2);
  EXPECT_THROW(demand_possible("a.h5", cut, sound), InputError);
}

TEST(Records, OfContactAreNotPossibleWithoutTheirPointsOrWithMoreSidesThanAnElementHas) {
  const Mesh mesh = cubes();
  Records sound = records_of(mesh, build_topology(mesh));
  WholeModel whole = whole_of(mesh);
  whole.num_elements = mesh.num_elements();
  whole.joint_groups.push_back({0, 0, 1.0});
  sound.elements[2].contactor = 1;
  sound.elements[2].field.sides = kOwnFaces | with_planes(kMostSides);
  sound.offsets = {{5, 24 * 5, 0.5}, {5, 24 * 5 + 23, 0.5}};
  EXPECT_TRUE(are_possible(sound, whole));
  const std::vector<std::function<void(Records&)>> faults{
      [](Records& r) { r.elements[2].field.sides = with_planes(kMostSides + 1); },
      [](Records& r) { r.elements[2].field.sides = -1; },
      [](Records& r) { r.offsets[0].point = 24 * 5 - 1; },
      [](Records& r) { r.offsets[1].point = 24 * 6; },
      [](Records& r) { r.offsets[0].point = -1; },
      [](Records& r) {
        r.offsets[0] = {999, 24 * 999, 0.5};
      }};
  for (std::size_t f = 0; f < faults.size(); ++f) {
    Records changed = sound;
    faults[f](changed);
    EXPECT_FALSE(are_possible(changed, whole)) << f;
  }
}

TEST(Records, MayHoldNodesByTheConstraintsOfTheirStageAlone) {
  case_::Stage stage;
  stage.constraints.resize(2);
  Records records;
  const auto held_by = [&](Index entry) {
    records.holds = {{0, 0, 0, 0, 0.0, 0.0}, {0, entry, 0, 0, 0.0, 0.0}};
    demand_constraints("a.h5", records, stage);
  };
  EXPECT_NO_THROW(held_by(1));
  for (const Index entry : {-1, 2, 1000000}) EXPECT_THROW(held_by(entry), InputError) << entry;
}

}  // namespace
}  // namespace breccia::piece_mesh_test
