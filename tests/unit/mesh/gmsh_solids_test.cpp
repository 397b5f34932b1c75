#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"

namespace breccia::gmsh_solids_test {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;
using test::volume_of;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kRoundOff = 1e-9;  // of lengths that went through the text of a STEP file

/// What gmsh writes of some solids into a file.
fs::path made_by_gmsh(const std::string& name, const std::function<void()>& shapes, bool triangles = false) {
  const fs::path file = test::scratch_folder("solids_" + name) / name;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("solids");
  shapes();
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Mesh.CharacteristicLengthMax", 3);
  if (triangles) gmsh::model::mesh::generate(2);
  testing::internal::CaptureStdout();  // OpenCASCADE tells what it writes
  gmsh::write(file.string());
  (void)testing::internal::GetCapturedStdout();
  gmsh::finalize();
  return file;
}

void beam_and_rod() {
  gmsh::model::occ::addBox(0, 0, 0, 60, 20, 10);
  gmsh::model::occ::addBox(80, 0, 0, 10, 10, 30);
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

GmshSource source(const fs::path& file) {
  GmshSource asked;
  asked.file = file;
  asked.time_limit = 120;
  return asked;
}

TEST(GmshSolids, AStepFileInMillimetresComesInMetresWithItsNames) {
  const fs::path file = made_by_gmsh("two.step", beam_and_rod);
  const std::string text = text_of(file);
  ASSERT_THAT(text, HasSubstr("SI_UNIT(.MILLI.,.METRE.)"));
  const std::regex of_a_part(R"(Open CASCADE STEP translator [0-9.]+ 1\.[12])");
  const std::string named = std::regex_replace(text, of_a_part, "beam");
  ASSERT_NE(named, text);
  const auto [mesh, report] = read_gmsh(source(test::write_file(file.parent_path() / "named.stp", named)));
  EXPECT_NEAR(volume_of(mesh), 1e-9 * (60 * 20 * 10 + 10 * 10 * 30), kRoundOff * 1e-9 * 15000);
  EXPECT_THAT(mesh.volume_groups, ElementsAre("beam", "beam_2"));
  EXPECT_EQ(mesh.surface_groups.size(), 12U);
  EXPECT_EQ(mesh.num_bodies, 2);
}

TEST(GmshSolids, VolumesAndFacesWithoutANameAreNumberedAndTheSizeIsKept) {
  GmshSource asked = source(made_by_gmsh("plain.brep", beam_and_rod));
  asked.scale = 0.001;
  const auto coarse = read_gmsh(asked);
  EXPECT_THAT(coarse.mesh.volume_groups, ElementsAre("volume_1", "volume_2"));
  EXPECT_EQ(coarse.mesh.surface_groups.front(), "surface_1");
  EXPECT_NEAR(volume_of(coarse.mesh), 1.5e-5, kRoundOff * 1.5e-5) << "mesh.scale holds for what states no unit";
  asked.size = 0.0025;
  const auto fine = read_gmsh(asked);
  EXPECT_GT(fine.mesh.num_elements(), 2 * coarse.mesh.num_elements());
  EXPECT_EQ(read_gmsh(asked).mesh.elements, fine.mesh.elements) << "the same file, the same mesh";
}

TEST(GmshSolids, GluedVolumesThatTouchShareTheirInterface) {
  GmshSource asked = source(made_by_gmsh("touch.step", [] {
    gmsh::model::occ::addBox(0, 0, 0, 10, 10, 10);
    gmsh::model::occ::addBox(10, 2, 2, 10, 6, 6);
  }));
  const Mesh apart = read_gmsh(asked).mesh;
  asked.glue = true;
  const Mesh glued = read_gmsh(asked).mesh;
  EXPECT_EQ(apart.surface_groups.size(), 12U);
  EXPECT_EQ(glued.surface_groups.size(), 12U) << "6 + 6 faces, less one that is shared, and one cut in two";
  Index shared = 0;
  std::vector<Index> body_of(glued.nodes.size(), -1);
  for (Index e = 0; e < glued.num_elements(); ++e)
    for (const Index node : glued.elements[static_cast<std::size_t>(e)]) {
      Index& body = body_of[static_cast<std::size_t>(node)];
      shared += body >= 0 && body != glued.element_volume[static_cast<std::size_t>(e)] ? 1 : 0;
      body = glued.element_volume[static_cast<std::size_t>(e)];
    }
  EXPECT_GT(shared, 0);
  EXPECT_NEAR(volume_of(glued), volume_of(apart), kRoundOff * volume_of(apart));
}

TEST(GmshSolids, VolumesThatOverlapAreNotGlued) {
  GmshSource asked = source(made_by_gmsh("overlap.brep", [] {
    gmsh::model::occ::addBox(0, 0, 0, 10, 10, 10);
    gmsh::model::occ::addBox(9, 0, 0, 10, 10, 10);
  }));
  asked.glue = true;
  EXPECT_THAT(refusal_of(asked), HasSubstr("the volumes \"volume_1\" and \"volume_2\" overlap"));
}

// --- STL
// -----------------------------------------------------------------------------------------------------

/// The text of an STL file of a box; `left_out` triangles are missing at its end.
std::string stl_box(const std::string& name, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
                    std::size_t left_out = 0) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  std::string text = "solid " + name + "\n";
  std::size_t left = 2 * kFaces.size() - left_out;
  for (const auto& f : kFaces)
    for (const std::array<int, 3>& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
      if (left == 0) break;
      --left;
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int i : t) {
        text += "vertex";
        for (int a = 0; a < 3; ++a) {
          const auto axis = static_cast<std::size_t>(a);
          text += " " + std::to_string((i >> a & 1) != 0 ? upper[axis] : lower[axis]);
        }
        text += "\n";
      }
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid " + name + "\n";
}

fs::path stl_file(const std::string& name, const std::string& text) {
  return test::write_file(test::scratch_folder("solids_" + name) / (name + ".stl"), text);
}

TEST(GmshSolids, TheSolidsOfAnStlAreVolumesAndTheirSidesSurfaces) {
  GmshSource asked =
      source(stl_file("named", stl_box("beam", {0, 0, 0}, {30, 10, 10}) + stl_box("pad", {0, 20, 0}, {10, 30, 10})));
  asked.scale = 0.001;
  asked.size = 0.004;
  const Mesh mesh = read_gmsh(asked).mesh;
  EXPECT_THAT(mesh.volume_groups, ElementsAre("beam", "pad"));
  EXPECT_EQ(mesh.surface_groups.size(), 12U);
  EXPECT_NEAR(volume_of(mesh), 4e-6, 1e-9 * 4e-6);
}

TEST(GmshSolids, ABinaryStlIsReadAndACutOneRefused) {
  const fs::path file = made_by_gmsh(
      "binary.stl",
      [] {
        gmsh::option::setNumber("Mesh.Binary", 1);
        gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 20, 5);
      },
      true);
  const Mesh mesh = read_gmsh(source(file)).mesh;
  EXPECT_THAT(mesh.volume_groups, ElementsAre("volume_1"));
  EXPECT_EQ(mesh.surface_groups.size(), 3U) << "two ends and the side, though gmsh cuts the side in two";
  const std::string text = text_of(file);
  EXPECT_THAT(refusal_of(source(test::write_file(file.parent_path() / "cut.stl", text.substr(0, text.size() / 2)))),
              HasSubstr("is no STL file, or it is cut off"));
}

TEST(GmshSolids, AnOpenOrCrossingStlIsRefusedInPlainWords) {
  EXPECT_THAT(refusal_of(source(stl_file("open", stl_box("box", {0, 0, 0}, {3, 1, 1}, 1)))),
              AllOf(HasSubstr("open.stl: mesh.file: the surface is open: 3 edges belong to one triangle only"),
                    HasSubstr("mend it in the program that it comes from")));
  EXPECT_THAT(
      refusal_of(source(stl_file("cross", stl_box("a", {0, 0, 0}, {6, 4, 4}) + stl_box("b", {1, 1, 1}, {2, 6, 2})))),
      HasSubstr("the surface goes through itself"));
}

// --- What is no solid
// -----------------------------------------------------------------------------------------------------

TEST(GmshSolids, FilesThatAreCutOffOrOfAnotherKindAreRefused) {
  const fs::path step = made_by_gmsh("whole.step", beam_and_rod), brep = made_by_gmsh("whole.brep", beam_and_rod);
  const auto half = [](const fs::path& file) { return text_of(file).substr(0, text_of(file).size() / 2); };
  const fs::path folder = test::scratch_folder("solids_broken");
  const auto refusal = [&](const std::string& name, const std::string& text) {
    return refusal_of(source(test::write_file(folder / name, text)));
  };
  EXPECT_THAT(refusal("cut.step", half(step)), HasSubstr("does not end with END-ISO-10303-21"));
  EXPECT_THAT(refusal("cut.brep", half(brep)), HasSubstr("is cut off: shapes are missing at its end"));
  EXPECT_THAT(refusal("other.step", "hello"), HasSubstr("is no STEP file"));
  EXPECT_THAT(refusal("other.brep", "hello"), HasSubstr("is no BREP file"));
  EXPECT_THAT(refusal("other.stl", "hello"), HasSubstr("is no STL file"));
  EXPECT_THAT(refusal("empty.stp", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("junk.step", "ISO-10303-21;\njunk\nEND-ISO-10303-21;\n"), Not(HasSubstr("accepted")));
  EXPECT_THAT(refusal("name.Step", text_of(step)), HasSubstr("is no kind of mesh file that can be read"))
      << "gmsh takes such a name for a script";
}

TEST(GmshSolids, FacesWithoutASolidAreRefused) {
  EXPECT_THAT(refusal_of(source(made_by_gmsh("face.step", [] { gmsh::model::occ::addRectangle(0, 0, 0, 1, 1); }))),
              HasSubstr("holds no solid, only 1 faces"));
}

TEST(GmshSolids, ASizeOrParametersWhereNoneBelongAreRefused) {
  GmshSource asked = source(made_by_gmsh("sized.brep", beam_and_rod));
  asked.parameters = {{"h", 1}};
  EXPECT_THAT(refusal_of(asked), HasSubstr("mesh.parameters"));
  asked.parameters.clear();
  asked.size = -1;
  EXPECT_THAT(refusal_of(asked), HasSubstr("mesh.size: is no length"));
  asked.file = test::write_file(test::scratch_folder("solids_script") / "box.geo", test::kTwoBoxes);
  asked.size = 0.1;
  EXPECT_THAT(refusal_of(asked), HasSubstr("a .geo sets its own"));
}

}  // namespace
}  // namespace breccia::gmsh_solids_test
