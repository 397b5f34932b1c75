#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"

namespace breccia::gmsh_groups_test {
namespace {

using test::refusal_of;
using testing::AllOf;
using testing::HasSubstr;

GmshSource script(const std::string& name, const std::string& text) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("groups_" + name) / "model.geo", text);
  return source;
}

/// Meshes a script, divides the mesh into parts as `gmsh -part` does, and writes it.
std::filesystem::path partitioned(const std::filesystem::path& geo, int parts, double version, bool split,
                                  bool ghosts) {
  const std::filesystem::path msh = geo.parent_path() / "parts.msh";
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.PartitionSplitMeshFiles", split ? 1 : 0);
  gmsh::option::setNumber("Mesh.PartitionCreateGhostCells", ghosts ? 1 : 0);
  gmsh::open(geo.string());
  gmsh::model::mesh::generate(3);
  if (parts > 1) gmsh::model::mesh::partition(parts);
  gmsh::write(msh.string());
  gmsh::finalize();
  return msh;
}

TEST(GmshReader, ReadsThePartitionsOfAVolumeAsThatVolume) {
  const auto geo = test::write_file(test::scratch_folder("partitioned") / "model.geo", test::kTwoBoxes);
  for (const double version : {4.1, 4.0, 2.2}) {
    for (const bool ghosts : {false, true}) {
      SCOPED_TRACE(testing::Message() << "format " << version << (ghosts ? " with ghost cells" : ""));
      GmshSource whole, parts;
      whole.file = geo;
      parts.file = partitioned(geo, 5, version, false, ghosts);
      const auto expected = read_gmsh(whole), read = read_gmsh(parts);
      EXPECT_EQ(read.mesh.num_bodies, 2);
      EXPECT_EQ(read.mesh.num_nodes(), expected.mesh.num_nodes()) << "nothing is parted but the two volumes";
      EXPECT_EQ(read.mesh.num_elements(), expected.mesh.num_elements());
      EXPECT_EQ(read.mesh.volume_groups, expected.mesh.volume_groups);
      EXPECT_EQ(read.mesh.element_group, expected.mesh.element_group);
      EXPECT_EQ(read.mesh.element_volume, expected.mesh.element_volume);
      EXPECT_EQ(read.mesh.surface_groups, expected.mesh.surface_groups) << "none of faces between partitions";
      for (std::size_t g = 0; g < expected.report.surface_groups.size(); ++g)
        EXPECT_EQ(read.report.surface_groups[g].count, expected.report.surface_groups[g].count) << g;
    }
  }
}

TEST(GmshReader, RefusesOneFileOfAMeshThatGmshHasSplitIntoSeveral) {
  const auto geo = test::write_file(test::scratch_folder("split") / "model.geo", test::kTwoBoxes);
  (void)partitioned(geo, 3, 4.1, true, false);
  GmshSource source;
  source.file = geo.parent_path() / "parts_2.msh";
  EXPECT_THAT(refusal_of(source),
              AllOf(HasSubstr("holds some partitions of a mesh only"), HasSubstr("the whole mesh in one file")));
}

/// The two boxes with a third physical volume of both.
const std::string kOverlapping = std::string(test::kTwoBoxes) + "Physical Volume(\"both\", 9) = {1, 2};\n";

TEST(GmshReader, MakesAnElementSetOfAPhysicalVolumeThatCarriesNoMaterial) {
  for (const bool first : {true, false}) {
    GmshSource source = script("overlapping", kOverlapping);
    source.materials = first ? std::vector<std::string>{"left", "right"} : std::vector<std::string>{"both"};
    const Mesh mesh = read_gmsh(source).mesh;
    const std::vector<std::string> boxes{"left", "right"}, both{"both"};
    EXPECT_EQ(mesh.volume_groups, first ? boxes : both);
    EXPECT_EQ(mesh.element_sets, first ? both : boxes);
    ASSERT_EQ(std::ssize(mesh.set_elements), mesh.num_elements());
    for (const Mesh::SetElement& one : mesh.set_elements) {
      const bool is_right =
          geometry::corners_of(mesh, one.element)[0].x() + geometry::corners_of(mesh, one.element)[1].x() +
              geometry::corners_of(mesh, one.element)[2].x() + geometry::corners_of(mesh, one.element)[3].x() >
          4;
      EXPECT_EQ(first ? mesh.element_group[at(one.element)] : one.group, is_right ? 1 : 0);
    }
  }
  GmshSource source = script("overlapping", kOverlapping);
  source.materials = {"left", "right", "both"};
  EXPECT_THAT(refusal_of(source), HasSubstr("volume 2: lies in two physical volumes with a material"));
}

TEST(GmshReader, ReadsOverlappingPhysicalVolumesOfEveryFormat) {
  const auto folder = test::scratch_folder("overlapping_formats");
  const auto geo = test::write_file(folder / "model.geo", kOverlapping);
  for (const double version : {4.1, 4.0, 2.2}) {
    GmshSource whole, read;
    whole.file = geo;
    read.file = partitioned(geo, 1, version, false, false);
    whole.materials = read.materials = {"left", "right"};
    const Mesh expected = read_gmsh(whole).mesh, mesh = read_gmsh(read).mesh;
    EXPECT_EQ(mesh.num_elements(), expected.num_elements()) << version;
    EXPECT_EQ(mesh.element_sets, expected.element_sets) << version;
    EXPECT_EQ(mesh.set_elements.size(), expected.set_elements.size()) << version;
  }
}

}  // namespace
}  // namespace breccia::gmsh_groups_test
