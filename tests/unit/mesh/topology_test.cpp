#include "mesh/topology.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/joints.hpp"
#include "sample_meshes.hpp"

namespace breccia::topology_test {
namespace {

using test::node_of;

struct Sample {
  std::string name;
  Mesh mesh;
};

std::vector<Sample> samples() {
  std::vector<Sample> all;
  all.push_back({"unstructured, glued", test::two_boxes("topology_glued", 0.35, true).mesh});
  all.push_back({"unstructured, parted", test::two_boxes("topology_parted", 0.35, false).mesh});
  all.push_back({"raster", test::raster_box({3, 2, 2}, {2, 1, 1}).mesh});
  return all;
}

/// Sorted nodes of a face by hand: all corners but the opposite one.
std::array<Index, 3> nodes_without(const Mesh& mesh, Index element, int corner) {
  std::array<Index, 3> nodes{};
  std::size_t k = 0;
  for (int c = 0; c < 4; ++c) {
    if (c != corner) nodes[k++] = mesh.elements[static_cast<std::size_t>(element)][static_cast<std::size_t>(c)];
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

using FaceOwners = std::map<std::array<Index, 3>, std::vector<std::pair<Index, int>>>;

FaceOwners face_owners(const Mesh& mesh) {
  FaceOwners owners;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) owners[nodes_without(mesh, e, f)].emplace_back(e, f);
  }
  return owners;
}

FaceLink link_of(const Topology& topology, Index element, int face) {
  return topology.links[static_cast<std::size_t>(element)][static_cast<std::size_t>(face)];
}

TEST(Topology, LinksExactlyTheFacesThatShareThreeNodes) {
  for (const auto& [name, mesh] : samples()) {
    SCOPED_TRACE(name);
    const Topology topology = build_topology(mesh);
    ASSERT_EQ(topology.links.size(), mesh.elements.size());
    int inner = 0, free = 0;
    for (const auto& [nodes, owners] : face_owners(mesh)) {
      if (owners.size() == 1) {
        ++free;
        EXPECT_TRUE(link_of(topology, owners[0].first, owners[0].second).free());
        continue;
      }
      ++inner;
      ASSERT_EQ(owners.size(), 2u);
      for (int side = 0; side < 2; ++side) {
        const auto [own, own_face] = owners[static_cast<std::size_t>(side)];
        const auto [other, other_face] = owners[static_cast<std::size_t>(1 - side)];
        const FaceLink link = link_of(topology, own, own_face);
        EXPECT_EQ(link.neighbour, other);
        EXPECT_EQ(link.face(), other_face);
      }
    }
    EXPECT_GT(inner, 0);
    EXPECT_GT(free, 0);
  }
}

TEST(Topology, MatchingCornersCoincide) {
  for (const auto& [name, mesh] : samples()) {
    SCOPED_TRACE(name);
    const Topology topology = build_topology(mesh);
    std::set<int> codes;
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = link_of(topology, e, f);
        if (link.free()) continue;
        codes.insert(link.code);
        for (int i = 0; i < 3; ++i) {
          const int own = kFaceCorners[static_cast<std::size_t>(f)][static_cast<std::size_t>(i)];
          EXPECT_EQ(node_of(mesh, e, own), node_of(mesh, link.neighbour, matching_corner(link.code, i)));
        }
      }
    }
    EXPECT_GE(codes.size(), 3u) << "the sample must exercise several rotations";
  }
}

TEST(Topology, FacesTurnCounterClockwiseSeenFromOutside) {
  const Mesh mesh = test::two_boxes("topology_outside", 0.5, true).mesh;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      const auto& c = kFaceCorners[static_cast<std::size_t>(f)];
      const Vec3 x0 = node_of(mesh, e, c[0]), x1 = node_of(mesh, e, c[1]), x2 = node_of(mesh, e, c[2]);
      EXPECT_LT((x1 - x0).cross(x2 - x0).dot(node_of(mesh, e, f) - x0), 0.0);
    }
  }
}

TEST(Topology, NamesBothSidesOfAGluedInterfaceAndOneSideOfAnOuterFace) {
  const Mesh mesh = test::two_boxes("topology_surfaces", 0.35, true).mesh;
  const Topology topology = build_topology(mesh);
  ASSERT_EQ(mesh.surface_groups, (std::vector<std::string>{"interface", "bottom"}));

  std::map<Index, double> interface_area;  // by volume
  for (const auto& [element, face] : topology.surface_groups[0]) {
    EXPECT_FALSE(link_of(topology, element, face).free());
    const auto& c = kFaceCorners[static_cast<std::size_t>(face)];
    for (const int corner : c) EXPECT_NEAR(node_of(mesh, element, corner).x(), 1.0, 1e-12);
    interface_area[mesh.element_volume[static_cast<std::size_t>(element)]] += geometry::triangle_area(
        node_of(mesh, element, c[0]), node_of(mesh, element, c[1]), node_of(mesh, element, c[2]));
  }
  ASSERT_EQ(interface_area.size(), 2u);
  EXPECT_NEAR(interface_area[0], 1.0, 1e-12);
  EXPECT_NEAR(interface_area[1], 1.0, 1e-12);

  double bottom_area = 0;
  for (const auto& [element, face] : topology.surface_groups[1]) {
    EXPECT_TRUE(link_of(topology, element, face).free());
    const auto& c = kFaceCorners[static_cast<std::size_t>(face)];
    bottom_area += geometry::triangle_area(node_of(mesh, element, c[0]), node_of(mesh, element, c[1]),
                                           node_of(mesh, element, c[2]));
  }
  EXPECT_NEAR(bottom_area, 1.5, 1e-12);
}

/// Tetrahedra (0 1 2 3), (0 2 1 4) and (0 2 1 5) on the common face (0 1 2): the last two overlap.
Mesh on_one_face(int count) {
  Mesh mesh;
  mesh.source = "by hand";
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.2, 0.2, -1}};
  const std::array<std::array<Index, 4>, 3> elements{{{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 2, 1, 5}}};
  for (int e = 0; e < count; ++e) {
    mesh.elements.push_back(elements[static_cast<std::size_t>(e)]);
    mesh.element_group.push_back(0);
    mesh.element_body.push_back(0);
    mesh.element_source_id.push_back(100 + e);
  }
  mesh.volume_groups = {"all"};
  mesh.num_bodies = 1;
  return mesh;
}

std::string message_of(const Mesh& mesh) {
  try {
    const Topology topology = build_topology(mesh);
    return "no error, " + std::to_string(topology.links.size()) + " elements";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Topology, RefusesThreeElementsOnOneFace) {
  EXPECT_EQ(message_of(on_one_face(2)), "no error, 2 elements");
  EXPECT_THAT(message_of(on_one_face(3)),
              testing::AllOf(testing::HasSubstr("element 100"), testing::HasSubstr("more than one other element"),
                             testing::HasSubstr("element 102")));
}

TEST(Topology, NamesTwoElementsOnTheSameFourNodesOnce) {
  Mesh mesh = on_one_face(2);
  mesh.elements[1] = mesh.elements[0];
  const std::string message = message_of(mesh);
  EXPECT_THAT(message, testing::HasSubstr("same side"));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Topology, RefusesTwoElementsOnTheSameSideOfTheirFace) {
  Mesh mesh = on_one_face(3);
  mesh.elements.erase(mesh.elements.begin());
  mesh.element_group.pop_back();
  mesh.element_body.pop_back();
  mesh.element_source_id.erase(mesh.element_source_id.begin());
  EXPECT_THAT(message_of(mesh), testing::AllOf(testing::HasSubstr("element 101"), testing::HasSubstr("same side"),
                                               testing::HasSubstr("element 102")));
}

TEST(Topology, RefusesASurfaceTriangleThatIsNoFace) {
  Mesh mesh = on_one_face(2);
  mesh.surface_groups = {"good", "stray"};
  mesh.surface_faces = {{{2, 0, 1}, 0}, {{1, 3, 4}, 1}};
  EXPECT_THAT(message_of(mesh),
              testing::AllOf(testing::HasSubstr("surface group \"stray\""), testing::HasSubstr("1 such triangles"),
                             testing::Not(testing::HasSubstr("good"))));
}

TEST(Joints, AreEveryInnerFaceOnceWithItsAreaAndMeanEdge) {
  constexpr double kRoundOff = 1e-14;  // sums of three lengths of order 1
  for (const auto& [name, mesh] : samples()) {
    SCOPED_TRACE(name);
    const auto joints = find_joints(mesh, build_topology(mesh));
    std::size_t inner = 0;
    for (const auto& [nodes, owners] : face_owners(mesh)) inner += owners.size() == 2 ? 1 : 0;
    EXPECT_EQ(joints.size(), inner);
    EXPECT_TRUE(std::is_sorted(joints.begin(), joints.end(), [](const JointFace& x, const JointFace& y) {
      return std::pair{x.a, x.face_a} < std::pair{y.a, y.face_a};
    }));
    for (const JointFace& joint : joints) {
      EXPECT_LT(joint.a, joint.b);
      const auto& c = kFaceCorners[static_cast<std::size_t>(joint.face_a)];
      std::array<Vec3, 3> x{};
      for (int i = 0; i < 3; ++i) {
        x[static_cast<std::size_t>(i)] = node_of(mesh, joint.a, c[static_cast<std::size_t>(i)]);
        EXPECT_EQ(x[static_cast<std::size_t>(i)], node_of(mesh, joint.b, matching_corner(joint.code, i)));
      }
      const double p = (x[1] - x[0]).norm(), q = (x[2] - x[1]).norm(), r = (x[0] - x[2]).norm();
      EXPECT_NEAR(joint.size, (p + q + r) / 3, kRoundOff);
      const double s = (p + q + r) / 2;  // Heron
      EXPECT_NEAR(joint.area, std::sqrt(s * (s - p) * (s - q) * (s - r)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace breccia::topology_test
