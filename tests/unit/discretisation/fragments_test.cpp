#include <gtest/gtest.h>

#include <algorithm>
#include <queue>
#include <random>

#include "base/index.hpp"
#include "discretisation/fragments.hpp"
#include "mesh/raster.hpp"
#include "mesh/topology.hpp"

namespace breccia::fragments_test {
namespace {

Mesh two_boxes() { return make_raster({.cells = {2, 1, 1}, .boxes = {2, 1, 1}, .gap = Vec3(1, 0, 0)}).mesh; }

LocalMesh local_mesh(const Mesh& mesh, Discretisation kind) { return build_local_mesh(mesh, {kind}, {1000.0}); }

using Pairs = std::vector<std::array<Index, 2>>;

/// Smallest element reached from each, by breadth-first search.
std::vector<GlobalId> flooded(Index elements, const Pairs& pairs) {
  std::vector<std::vector<Index>> neighbours(at(elements));
  for (const auto& [a, b] : pairs) {
    neighbours[at(a)].push_back(b);
    neighbours[at(b)].push_back(a);
  }
  std::vector<GlobalId> fragment(at(elements), -1);
  for (Index start = 0; start < elements; ++start) {
    if (fragment[at(start)] >= 0) continue;
    std::queue<Index> queue({start});
    fragment[at(start)] = start;
    for (; !queue.empty(); queue.pop()) {
      for (const Index next : neighbours[at(queue.front())]) {
        if (fragment[at(next)] >= 0) continue;
        fragment[at(next)] = start;
        queue.push(next);
      }
    }
  }
  return fragment;
}

TEST(Fragments, OfOwnNodesWithoutJointsAreTheElements) {
  const LocalMesh mesh = local_mesh(two_boxes(), Discretisation::own_nodes);
  const Fragments fragments = FragmentFinder(mesh).find();
  EXPECT_EQ(fragments.count, 96);
  EXPECT_EQ(fragments.of_slot, mesh.element_of_slot);
}

TEST(Fragments, OfSharedNodesAreTheBodies) {
  const Mesh model = two_boxes();
  const LocalMesh mesh = local_mesh(model, Discretisation::shared_nodes);
  const Fragments fragments = FragmentFinder(mesh).find();
  EXPECT_EQ(fragments.count, 2);
  std::array<GlobalId, 2> lowest{1000, 1000};
  for (Index e = 0; e < 96; ++e) {
    GlobalId& low = lowest[at(model.element_body[at(e)])];
    low = std::min<GlobalId>(low, e);
  }
  for (Index e = 0; e < 96; ++e) {
    EXPECT_EQ(fragments.of_slot[at(mesh.slot_of_element[at(e)])], lowest[at(model.element_body[at(e)])]);
  }
}

TEST(Fragments, AgreeWithAFloodFillInWhateverOrderJointsAreNamed) {
  const Mesh model = two_boxes();
  const LocalMesh mesh = local_mesh(model, Discretisation::own_nodes);
  std::mt19937 random(1);
  for (const int joints : {5, 40, 80, 130, 300}) {
    Pairs pairs;
    for (int k = 0; k < joints; ++k) {
      pairs.push_back({static_cast<Index>(random() % 96), static_cast<Index>(random() % 96)});
    }
    const std::vector<GlobalId> expected = flooded(96, pairs);
    Index count = 0;
    for (Index e = 0; e < 96; ++e) count += expected[at(e)] == e;
    for (int order = 0; order < 3; ++order) {
      std::shuffle(pairs.begin(), pairs.end(), random);
      FragmentFinder finder(mesh);
      for (const auto& [a, b] : pairs) finder.join(mesh.slot_of_element[at(a)], mesh.slot_of_element[at(b)]);
      const Fragments fragments = finder.find();
      EXPECT_EQ(fragments.count, count);
      for (Index e = 0; e < 96; ++e) {
        const std::size_t slot = at(mesh.slot_of_element[at(e)]);
        EXPECT_EQ(fragments.of_slot[slot], expected[at(e)]);
        EXPECT_EQ(fragments.alone[slot] != 0, std::count(expected.begin(), expected.end(), expected[at(e)]) == 1);
      }
    }
  }
}

TEST(Fragments, PassThroughLinkedJointsAndStopAtDetachedOnes) {
  const Mesh model = two_boxes();
  const Topology topology = build_topology(model);
  const LocalMesh mesh = local_mesh(model, Discretisation::own_nodes);
  JointLinks links;
  links.reset(mesh.num_own_slots);
  const Index lonely = 20;  // element whose joints have all failed
  for (Index s = 0; s < mesh.num_own_slots; ++s) {
    for (int f = 0; f < 4; ++f) {
      const GlobalId e = mesh.element_of_slot[at(s)];
      if (e < 0) continue;
      const FaceLink& there = topology.links[static_cast<std::size_t>(e)][at(f)];
      if (there.free() || e == lonely || there.neighbour == lonely) continue;
      links.attach(s, f, mesh.slot_of_element[at(there.neighbour)], there.code);
    }
  }
  FragmentFinder finder(mesh);
  finder.join_linked(links);
  const Fragments fragments = finder.find();
  EXPECT_EQ(fragments.count, 3);
  EXPECT_EQ(fragments.of_slot[at(mesh.slot_of_element[at(lonely)])], lonely);
}

TEST(Fragments, LeavePaddingOut) {
  const LocalMesh mesh = local_mesh(make_raster({.single_tetrahedra = true}).mesh, Discretisation::shared_nodes);
  const Fragments fragments = FragmentFinder(mesh).find();
  EXPECT_EQ(fragments.count, 1);
  EXPECT_EQ(fragments.of_slot, (std::vector<GlobalId>{0, -1, -1, -1, -1, -1, -1, -1}));
}

}  // namespace
}  // namespace breccia::fragments_test
