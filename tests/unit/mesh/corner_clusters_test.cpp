#include "mesh/corner_clusters.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "mesh/joints.hpp"
#include "sample_meshes.hpp"

namespace breccia::corner_clusters_test {
namespace {

using Broken = std::set<std::pair<Index, int>>;  // (element, face), both sides

/// Cluster ids by definition: from every corner, in ascending order, walk through the unbroken faces that touch its
/// node.
std::vector<Index> flood_fill(const Mesh& mesh, const Topology& topology, const Broken& broken) {
  std::vector<Index> cluster(4 * mesh.elements.size(), -1);
  for (Index start = 0; start < static_cast<Index>(cluster.size()); ++start) {
    if (cluster[at(start)] >= 0) continue;
    const Index node = mesh.elements[at(start / 4)][at(start % 4)];
    std::vector<Index> pending{start};
    cluster[at(start)] = start;
    while (!pending.empty()) {
      const Index element = pending.back() / 4;
      pending.pop_back();
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = topology.links[at(element)][at(f)];
        if (link.free() || broken.count({element, f}) != 0) continue;
        if (mesh.elements[at(element)][at(f)] == node) continue;  // the opposite face does not touch the node
        const auto& others = mesh.elements[at(link.neighbour)];
        const auto corner = static_cast<Index>(std::find(others.begin(), others.end(), node) - others.begin());
        Index& id = cluster[at(4 * link.neighbour + corner)];
        if (id >= 0) continue;
        id = start;
        pending.push_back(4 * link.neighbour + corner);
      }
    }
  }
  return cluster;
}

std::vector<Index> all_clusters(const CornerClusters& clusters, const Mesh& mesh) {
  std::vector<Index> ids;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int c = 0; c < 4; ++c) ids.push_back(clusters.cluster(e, c));
  }
  return ids;
}

std::vector<Topology::Face> shuffled_inner_faces(const Mesh& mesh, const Topology& topology, unsigned seed) {
  std::vector<Topology::Face> faces;
  for (const JointFace& joint : find_joints(mesh, topology)) faces.push_back({joint.a, joint.face_a});
  std::mt19937 random(seed);
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[random() % i]);
  return faces;
}

Broken both_sides(const Topology& topology, std::span<const Topology::Face> faces) {
  Broken broken;
  for (const auto& [element, face] : faces) {
    const FaceLink link = topology.links[at(element)][at(face)];
    broken.insert({element, face});
    broken.insert({link.neighbour, link.face()});
  }
  return broken;
}

class CornerClustersOf : public testing::TestWithParam<bool> {
 protected:
  CornerClustersOf()
      : mesh(GetParam() ? test::two_boxes("clusters", 0.4, true).mesh : test::raster_box({2, 2, 2}, {2, 1, 1}).mesh),
        topology(build_topology(mesh)) {}
  Mesh mesh;
  Topology topology;
};

TEST_P(CornerClustersOf, AgreeWithAFloodFillAfterEveryBreak) {
  CornerClusters clusters(mesh, topology);
  EXPECT_EQ(all_clusters(clusters, mesh), flood_fill(mesh, topology, {}));

  const auto faces = shuffled_inner_faces(mesh, topology, 7);
  std::vector<Index> changed;
  std::size_t changes = 0;
  for (std::size_t done = 0; done < faces.size(); ++done) {
    const auto before = all_clusters(clusters, mesh);
    clusters.break_face(faces[done].element, faces[done].face, changed);
    const auto after = all_clusters(clusters, mesh);
    std::vector<Index> different;
    for (Index c = 0; c < static_cast<Index>(after.size()); ++c) {
      if (before[at(c)] != after[at(c)]) different.push_back(c);
    }
    ASSERT_EQ(changed, different) << "face " << done;
    changes += changed.size();
    if (done % 8 == 0 || done + 1 == faces.size()) {
      ASSERT_EQ(after, flood_fill(mesh, topology, both_sides(topology, std::span(faces).first(done + 1))));
    }
  }
  EXPECT_GT(changes, mesh.elements.size());
  for (Index c = 0; c < 4 * mesh.num_elements(); ++c) EXPECT_EQ(clusters.cluster(c / 4, c % 4), c) << "all is broken";
}

TEST_P(CornerClustersOf, DoNotDependOnTheOrderNorTheBatchesOfBreaking) {
  auto faces = shuffled_inner_faces(mesh, topology, 11);
  faces.resize(faces.size() / 2);
  CornerClusters one_by_one(mesh, topology), at_once(mesh, topology), backwards(mesh, topology);
  std::vector<Index> changed;
  for (const auto& [element, face] : faces) one_by_one.break_face(element, face, changed);
  at_once.break_faces(faces, changed);
  for (auto face = faces.rbegin(); face != faces.rend(); ++face) {  // named from the other side
    const FaceLink link = topology.links[at(face->element)][at(face->face)];
    backwards.break_face(link.neighbour, link.face(), changed);
  }
  EXPECT_EQ(all_clusters(one_by_one, mesh), all_clusters(at_once, mesh));
  EXPECT_EQ(all_clusters(one_by_one, mesh), all_clusters(backwards, mesh));
}

TEST_P(CornerClustersOf, CallElementsBondedExactlyWhenAClusterHoldsCornersOfBoth) {
  CornerClusters clusters(mesh, topology);
  auto faces = shuffled_inner_faces(mesh, topology, 3);
  faces.resize(2 * faces.size() / 3);
  std::vector<Index> changed;
  clusters.break_faces(faces, changed);
  const auto ids = flood_fill(mesh, topology, both_sides(topology, faces));
  std::map<Index, std::set<Index>> elements_of;  // by cluster
  for (Index c = 0; c < static_cast<Index>(ids.size()); ++c) elements_of[ids[at(c)]].insert(c / 4);
  std::set<std::pair<Index, Index>> bonded;
  for (const auto& [id, elements] : elements_of) {
    for (const Index a : elements) {
      for (const Index b : elements) bonded.insert({a, b});
    }
  }
  for (Index a = 0; a < mesh.num_elements(); ++a) {
    for (Index b = 0; b < mesh.num_elements(); ++b) {
      ASSERT_EQ(clusters.bonded(a, b), bonded.count({a, b}) != 0) << a << ' ' << b;
    }
  }
}

TEST_P(CornerClustersOf, IgnoreASecondBreakAndAFreeFace) {
  CornerClusters clusters(mesh, topology);
  const auto face = shuffled_inner_faces(mesh, topology, 5).front();
  std::vector<Index> changed;
  clusters.break_face(face.element, face.face, changed);
  EXPECT_TRUE(clusters.broken(face.element, face.face));
  const auto before = all_clusters(clusters, mesh);
  clusters.break_face(face.element, face.face, changed);
  EXPECT_TRUE(changed.empty());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (!topology.links[at(e)][at(f)].free()) continue;
      clusters.break_face(e, f, changed);
      EXPECT_TRUE(changed.empty());
      EXPECT_FALSE(clusters.broken(e, f));
    }
  }
  EXPECT_EQ(all_clusters(clusters, mesh), before);
}

TEST_P(CornerClustersOf, ListTheCornersAtEachNode) {
  const CornerClusters clusters(mesh, topology);
  std::vector<std::vector<Index>> expected(mesh.nodes.size());
  for (Index c = 0; c < 4 * mesh.num_elements(); ++c) expected[at(mesh.elements[at(c / 4)][at(c % 4)])].push_back(c);
  for (Index node = 0; node < mesh.num_nodes(); ++node) {
    const auto corners = clusters.corners_at(node);
    EXPECT_EQ(std::vector<Index>(corners.begin(), corners.end()), expected[at(node)]);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, CornerClustersOf, testing::Bool(),
                         [](const auto& run) { return run.param ? "Unstructured" : "Raster"; });

}  // namespace
}  // namespace breccia::corner_clusters_test
