#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesh/gmsh_reader.hpp"
#include "mesh/mesh_bytes.hpp"
#include "sample_meshes.hpp"

namespace breccia::higher_order_test {
namespace {

using test::volume_of;
using testing::ElementsAre;
using testing::IsEmpty;

/// A cylinder with a group of every kind, whose elements are of this order.
FinishedMesh cylinder(int order) {
  GmshSource source;
  source.file = test::write_file(
      test::scratch_folder("order_" + std::to_string(order)) / "model.geo",
      "SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0, 0, 0, 0, 0, 2, 1};\nMeshSize{:} = 0.8;\n"
      "Physical Volume(\"rod\") = {1};\nPhysical Surface(\"side\") = {1};\nPhysical Curve(\"rim\") = {1};\n"
      "Mesh.ElementOrder = " +
          std::to_string(order) + ";\n");
  return read_gmsh(source);
}

class HigherOrder : public testing::TestWithParam<int> {};

TEST_P(HigherOrder, ElementsAreReadByTheirCornersWithAWord) {
  const FinishedMesh first = cylinder(1), higher = cylinder(GetParam());
  EXPECT_THAT(first.report.notes, IsEmpty());
  EXPECT_THAT(higher.report.notes, ElementsAre(kHigherOrderNote));
  EXPECT_EQ(higher.mesh.num_elements(), first.mesh.num_elements());
  EXPECT_EQ(higher.mesh.num_nodes(), first.mesh.num_nodes());
  EXPECT_EQ(higher.report.orphan_nodes, first.report.orphan_nodes) << "nodes between corners are not lost ones";
  EXPECT_EQ(volume_of(higher.mesh), volume_of(first.mesh)) << "that of straight edges";
  EXPECT_EQ(higher.report.surface_groups[0].count, first.report.surface_groups[0].count);
  EXPECT_EQ(higher.report.node_groups[0].count, first.report.node_groups[0].count);
}

INSTANTIATE_TEST_SUITE_P(Orders, HigherOrder, testing::Values(2, 3));

}  // namespace
}  // namespace breccia::higher_order_test
