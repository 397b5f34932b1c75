#include "model/plane.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "model/model.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::plane_test {
namespace {

using testing::HasSubstr;

/// A raster of cubes of 10 mm. @param cells  "[3, 1, 2]";  @param axis  of the plane model
case_::Case layer(const std::string& cells, const std::string& axis, const std::string& kind = "strain",
                  const std::string& more = "") {
  return case_::read_text(case_::minimal + more + "[plane]\nkind = \"" + kind + "\"\naxis = \"" + axis + "\"\n",
                          {"mesh.raster.cells=" + cells});
}

std::string fault_of(const case_::Case& input) {
  try {
    (void)build_bare_model(input);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Plane, ModelIsRefusedUnlessItsMeshIsOneFlatLayer) {
  EXPECT_EQ(fault_of(layer("[3, 1, 2]", "y")), "");
  for (const char* cells : {"[3, 2, 2]", "[3, 3, 2]"})
    EXPECT_THAT(fault_of(layer(cells, "y")), HasSubstr("plane: the mesh is not one flat layer across y"));
}

std::string fault_of_geometry(const std::string& geometry) {
  const case_::CaseFolder folder;
  folder.write("layer.geo", geometry);
  std::string text = case_::minimal.substr(case_::minimal.find("[[material]]"));
  text = "[mesh]\nfile = \"layer.geo\"\n[plane]\nkind = \"strain\"\n" + text;
  return fault_of(case_::read_case(folder.write("case.toml", text)));
}

TEST(Plane, ModelMayBeExtrudedInOneLayerButNotInTwoNorAskew) {
  const auto extruded = [](const std::string& along, const std::string& layers) {
    return "Point(1) = {0, 0, 0, 1}; Point(2) = {4, 0, 0, 1}; Point(3) = {4, 3, 0, 1}; Point(4) = {0, 3, 0, 1};\n"
           "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
           "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\n"
           "v[] = Extrude {" +
           along + "} { Surface{1}; Layers{" + layers +
           "}; };\n"
           "Physical Volume(\"raster\") = {v[1]};\n";
  };
  EXPECT_EQ(fault_of_geometry(extruded("0, 0, 1", "1")), "");
  EXPECT_THAT(fault_of_geometry(extruded("0, 0, 1", "2")), HasSubstr("another one above or below it"));
  EXPECT_THAT(fault_of_geometry(extruded("0.5, 0, 1", "1")), HasSubstr("neither lies on a side nor stands upright"));
}

TEST(Plane, ModelKnowsItsThicknessAndTheWidthOfItsElements) {
  const Model model = build_bare_model(layer("[3, 1, 2]", "y"));
  const Layer found = layer_of(model.mesh, 1);
  EXPECT_NEAR(found.thickness, 0.01, 1e-12);
  // A square cut by its diagonals: edges of 10 mm and of 7.07 mm, the latter two of three.
  EXPECT_NEAR(found.edge, 0.01 / std::sqrt(2.0), 1e-9);
}

TEST(Plane, OutlineIsTheSurfaceWithoutTheSides) {
  const Model model = build_bare_model(layer("[3, 1, 2]", "y"));
  const Topology outline = without_sides(model.mesh, model.topology, 1);
  int free = 0, all = 0;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      all += model.topology.links[at(e)][at(f)].free() ? 1 : 0;
      free += outline.links[at(e)][at(f)].free() ? 1 : 0;
      EXPECT_EQ(outline.links[at(e)][at(f)].inner(), model.topology.links[at(e)][at(f)].inner());
    }
  }
  constexpr int kSquares = 2 * (3 + 2), kSides = 2 * 3 * 2;
  EXPECT_EQ(free, 4 * kSquares);
  EXPECT_EQ(all, 4 * (kSquares + kSides));
}

TEST(Plane, ModelKnowsItsLowerSide) {
  const case_::Case input = case_::read_text(case_::minimal + "[plane]\nkind = \"stress\"\naxis = \"y\"\n",
                                             {"mesh.raster.cells=[3, 1, 2]", "mesh.raster.origin=[0, -1, 0]"});
  EXPECT_NEAR(build_bare_model(input).whole.lower_side, -1.0, 1e-12);
}

}  // namespace
}  // namespace breccia::plane_test
