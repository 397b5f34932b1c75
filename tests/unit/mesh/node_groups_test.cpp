#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"

namespace breccia::node_groups_test {
namespace {

TEST(NodeGroups, AreTheNodesOfCurvesAndPointsInEveryBodyThatHasThem) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("node_groups") / "model.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1, 2}; Delete; }{}
Point(101) = {5, 5, 5};
edge[] = Curve In BoundingBox {0.9, -0.1, -0.1, 1.1, 1.1, 0.1};
Physical Volume("boxes") = {1, 2};
Physical Curve("edge") = {edge[]};
Physical Curve(9) = {edge[]};
Physical Point("corner") = Point In BoundingBox {-0.1, -0.1, -0.1, 0.1, 0.1, 0.1};
Physical Point("edge") = Point In BoundingBox {1.9, -0.1, -0.1, 2.1, 0.1, 0.1};
Physical Point("nowhere") = {101};
MeshSize{:} = 0.5;
)");
  for (const bool glue : {false, true}) {
    source.glue = glue;
    const auto [mesh, report] = read_gmsh(source);
    ASSERT_EQ(mesh.node_groups, (std::vector<std::string>{"edge", "curve_9", "corner"}));
    EXPECT_EQ(report.empty_groups, std::vector<std::string>{"nowhere"});
    std::vector<Index> counts(3, 0);
    for (const Mesh::GroupNode& one : mesh.group_nodes) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(one.node)];
      EXPECT_LT(one.group == 2 ? x.norm() : std::abs(x.x() - 1) + x.z(), one.group == 0 ? 1.1 : 1e-9);
      ++counts[static_cast<std::size_t>(one.group)];
    }
    const Index on_edge = glue ? 3 : 6;
    EXPECT_EQ(counts, (std::vector<Index>{on_edge + 1, on_edge, 1}));
    for (std::size_t g = 0; g < counts.size(); ++g) EXPECT_EQ(report.node_groups[g].count, counts[g]);
  }
}

}  // namespace
}  // namespace breccia::node_groups_test
