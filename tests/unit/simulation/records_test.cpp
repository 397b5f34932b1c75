#include <gtest/gtest.h>
#include <algorithm>
#include <tuple>
#include <vector>

#include "base/error.hpp"
#include "mesh/raster.hpp"
#include "simulation/records.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Mesh cubes() {
  RasterSource source;
  source.cells = {3, 2, 1};
  source.group = "block";
  return make_raster(source).mesh;
}

/// Bare records of a whole mesh, with one tag, joint and hold for every third element.
Records records_of(const Mesh& mesh, const Topology& topology) {
  Records records;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    ElementRecord record;
    record.id = e;
    record.group = mesh.element_group[at(e)];
    record.body = mesh.element_body[at(e)];
    record.source_id = mesh.element_source_id[at(e)];
    for (std::size_t c = 0; c < 4; ++c) {
      record.vertex[c] = mesh.elements[at(e)][c];
      const Vec3& x = mesh.nodes[at(mesh.elements[at(e)][c])];
      record.reference[c] = record.position[c] = {x[0], x[1], x[2]};
    }
    for (std::size_t f = 0; f < 4; ++f) {
      record.neighbour[f] = topology.links[at(e)][f].neighbour;
      record.code[f] = topology.links[at(e)][f].code;
    }
    records.elements.push_back(record);
    if (e % 3 != 0) continue;
    records.corners.push_back({e, 0, 5});
    records.holds.push_back({e, 1, 2, 0, 0.5, -0.25});
    records.joints.push_back({e, e + 1, {}});
    records.joints.back().joint.mode_1 = 0.125 * e;
  }
  for (std::size_t g = 0; g < topology.surface_groups.size(); ++g) {
    for (const Topology::Face& face : topology.surface_groups[g])
      records.faces.push_back({face.element, static_cast<Index>(g), face.face});
  }
  std::stable_sort(records.faces.begin(), records.faces.end(),
                   [](const FaceTag& p, const FaceTag& q) { return p.element < q.element; });
  return records;
}

WholeModel whole_of(const Mesh& mesh) {
  WholeModel whole;
  whole.source = mesh.source;
  whole.volume_groups = mesh.volume_groups;
  whole.surface_groups = mesh.surface_groups;
  whole.body_length.assign(at(mesh.num_bodies), 1.0);
  return whole;
}

/// Marks of the elements for which wanted(id) holds.
template <class Wanted>
std::vector<std::uint8_t> marks(const Records& records, Wanted&& wanted) {
  std::vector<std::uint8_t> list;
  for (const ElementRecord& record : records.elements) list.push_back(wanted(record.id) ? 1 : 0);
  return list;
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

/// Equal member by member; the bytes between members are nobody's.
void expect_equal(const Records& a, const Records& b) {
  const auto each = [](const auto& left, const auto& right, auto&& members) {
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_EQ(members(left[i]), members(right[i]));
  };
  each(a.elements, b.elements, [](const ElementRecord& e) {
    return std::tuple(e.id, e.source_id, e.group, e.body, e.vertex, e.neighbour, e.code, e.reference, e.position);
  });
  each(a.joints, b.joints, [](const JointRecord& j) { return std::tuple(j.element, j.other, j.joint.mode_1); });
  each(a.holds, b.holds,
       [](const HoldRecord& h) { return std::tuple(h.element, h.entry, h.corner, h.axis, h.start, h.velocity); });
  each(a.faces, b.faces, [](const FaceTag& f) { return std::tuple(f.element, f.group, f.face); });
  each(a.corners, b.corners, [](const CornerTag& c) { return c.element; });
}

TEST(Records, SentAwayAndMergedAgainAreComplete) {
  const Mesh mesh = cubes();
  const Records all = records_of(mesh, build_topology(mesh));
  const auto odd = marks(all, [](GlobalId id) { return id % 2 != 0; });
  const auto even = marks(all, [](GlobalId id) { return id % 2 == 0; });
  Records back = all;
  keep(back, even);
  EXPECT_EQ(back.elements.size(), all.elements.size() / 2);
  Records arrivals;
  unpack(pack(all, odd), arrivals);
  merge(back, std::move(arrivals));
  expect_equal(back, all);
}

TEST(Records, RefuseBytesThatAreCutOff) {
  const Mesh mesh = cubes();
  const Records all = records_of(mesh, build_topology(mesh));
  std::vector<std::byte> bytes = pack(all, std::vector<std::uint8_t>(all.elements.size(), 1));
  bytes.resize(bytes.size() - 5);
  Records records;
  EXPECT_THROW(unpack(bytes, records), InternalError);
}

TEST(WholeModel, ArrivesAsItWasSent) {
  WholeModel whole = whole_of(cubes());
  whole.num_elements = 144;
  whole.joint_groups = {{0, 0, 0.5}, {0, 2, 0.25}};
  whole.lightest_node = 1e-3;
  whole.step_ratio = 1.75;
  const WholeModel there = unpack_whole(pack(whole));
  EXPECT_EQ(there.volume_groups, whole.volume_groups);
  EXPECT_EQ(there.surface_groups, whole.surface_groups);
  EXPECT_EQ(there.num_elements, 144);
  ASSERT_EQ(there.joint_groups.size(), 2U);
  EXPECT_EQ(there.joint_groups[1].b, 2);
  EXPECT_EQ(there.joint_groups[1].size, 0.25);
  EXPECT_EQ(there.lightest_node, 1e-3);
  EXPECT_EQ(there.step_ratio, 1.75);
  EXPECT_EQ(there.body_length, whole.body_length);
}

}  // namespace
}  // namespace breccia
