#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "foreign_row.hpp"

// Files as other programs write them: each is read with its volume and groups, or refused with a line that helps.

namespace breccia::foreign_table_test {
namespace {

namespace fs = std::filesystem;
using test::kCorners;
using test::Names;
using test::replaced;
using test::Row;
using test::text;

/// Two unit cubes side by side, "rock" and "steel", with a surface "left" and a point "tip", as gmsh writes them.
std::string by_gmsh(const std::string& name, int order = 1,
                    const std::vector<std::pair<std::string, double>>& options = {}) {
  const fs::path file = test::scratch_folder("by_gmsh") / name;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("cubes");
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1, 1);
  gmsh::model::occ::addBox(1, 0, 0, 1, 1, 1, 2);
  gmsh::vectorpair made;
  std::vector<gmsh::vectorpair> parts;
  if (!name.ends_with(".step") && !name.ends_with(".stl")) gmsh::model::occ::fragment({{3, 1}}, {{3, 2}}, made, parts);
  gmsh::model::occ::synchronize();
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {1}), "rock");
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {2}), "steel");
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), "left");
  gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {1}), "tip");
  for (const char* size : {"Mesh.CharacteristicLengthMin", "Mesh.CharacteristicLengthMax"})
    gmsh::option::setNumber(size, 2);
  for (const char* groups : {"Mesh.SaveGroupsOfNodes", "Mesh.SaveGroupsOfElements"}) gmsh::option::setNumber(groups, 1);
  if (name.ends_with(".step") || name.ends_with(".brep")) {
    testing::internal::CaptureStdout();  // OpenCASCADE tells what it writes
    gmsh::write(file.string());
    (void)testing::internal::GetCapturedStdout();
  } else {
    gmsh::model::mesh::generate(3);
    gmsh::model::mesh::setOrder(order);
    for (const auto& [option, value] : options) gmsh::option::setNumber(option, value);
    gmsh::write(file.string());
  }
  gmsh::finalize();
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string cut(const std::string& text) { return text.substr(0, text.size() * 6 / 10); }

std::function<std::string()> gmsh_file(const std::string& name, int order = 1,
                                       const std::vector<std::pair<std::string, double>>& options = {}) {
  return [=] { return by_gmsh(name, order, options); };
}
std::function<std::string()> msh(double version, int binary, int order = 1) {
  return gmsh_file("a.msh", order, {{"Mesh.MshFileVersion", version}, {"Mesh.Binary", binary}});
}

const Names kRockAndSteel{"rock", "steel"}, kLeft{"left"}, kTip{"tip"};

std::vector<Row> rows_of_gmsh() {
  return {
      {"Msh22", ".msh", msh(2.2, 0), 2, kRockAndSteel, kLeft, kTip, ""},
      {"Msh22Binary", ".msh", msh(2.2, 1), 2, kRockAndSteel, kLeft, kTip, ""},
      {"Msh40", ".msh", msh(4.0, 0), 2, kRockAndSteel, kLeft, kTip, ""},
      {"Msh41", ".msh", msh(4.1, 0), 2, kRockAndSteel, kLeft, kTip, ""},
      {"Msh41Binary", ".msh", msh(4.1, 1), 2, kRockAndSteel, kLeft, kTip, ""},
      {"Msh22SecondOrder", ".msh", msh(2.2, 0, 2), 2, kRockAndSteel, kLeft, kTip, kCorners},
      {"Msh41SecondOrder", ".msh", msh(4.1, 0, 2), 2, kRockAndSteel, kLeft, kTip, kCorners},
      {"Msh41BinarySecondOrder", ".msh", msh(4.1, 1, 2), 2, kRockAndSteel, kLeft, kTip, kCorners},
      {"Msh1", ".msh", text("$NOD\n4\n1 0 0 0\n"), 0, {}, {}, {}, "does not begin with $MeshFormat"},
      {"MshCut", ".msh", [] { return cut(by_gmsh("a.msh")); }, 0, {}, {}, {}, "the file ends within it"},
      {"InpOfGmsh",
       ".inp",
       gmsh_file("a.inp"),
       2,
       kRockAndSteel,
       {"Surface1", "left"},
       {"Volume1", "Volume2", "left", "rock", "steel", "tip"},
       ""},
      {"InpOfGmshSecondOrder",
       ".inp",
       gmsh_file("a.inp", 2),
       2,
       kRockAndSteel,
       {"Surface1", "left"},
       {"Volume1", "Volume2", "left", "rock", "steel", "tip"},
       kCorners},
      {"Unv", ".unv", gmsh_file("a.unv"), 2, kRockAndSteel, kLeft, {"left", "rock", "steel", "tip"}, ""},
      {"UnvSecondOrder",
       ".unv",
       gmsh_file("a.unv", 2),
       2,
       kRockAndSteel,
       kLeft,
       {"left", "rock", "steel", "tip"},
       kCorners},
      {"UnvWithoutGroups",
       ".unv",
       gmsh_file("a.unv", 1, {{"Mesh.SaveGroupsOfNodes", 0}, {"Mesh.SaveGroupsOfElements", 0}}),
       2,
       {"volume_1", "volume_2"},
       {},
       {},
       ""},
      {"UnvMemberMissing",
       ".unv",
       [] {
         return replaced(by_gmsh("a.unv"), "         8        53         0         0",
                         "         8       953         0         0");
       },
       2,
       {"rock", "steel", "rest"},
       kLeft,
       {"left", "rock", "steel", "tip"},
       "group \"steel\" has 1 members that are no node"},
      {"UnvCut", ".unv", [] { return cut(by_gmsh("a.unv")); }, 0, {}, {}, {}, "is cut off: it ends within a dataset"},
      {"UnvNodeMissing",
       ".unv",
       [] {
         return replaced(by_gmsh("a.unv"), "\n        23         1         1        11\n",
                         "\n        99         1         1        11\n");
       },
       0,
       {},
       {},
       {},
       "has a node that the file does not have"},
      {"BdfFree",
       ".bdf",
       gmsh_file("a.bdf", 1, {{"Mesh.BdfFieldFormat", 0}}),
       2,
       {"volume_1", "volume_2"},
       {"surface_1"},
       {},
       ""},
      {"BdfShort",
       ".bdf",
       gmsh_file("a.bdf", 1, {{"Mesh.BdfFieldFormat", 1}}),
       2,
       {"volume_1", "volume_2"},
       {"surface_1"},
       {},
       ""},
      {"BdfLong",
       ".nas",
       gmsh_file("a.bdf", 1, {{"Mesh.BdfFieldFormat", 2}}),
       2,
       {"volume_1", "volume_2"},
       {"surface_1"},
       {},
       ""},
      {"BdfSecondOrder", ".bdf", gmsh_file("a.bdf", 2), 2, {"volume_1", "volume_2"}, {"surface_1"}, {}, kCorners},
      {"BdfCut", ".bdf", [] { return cut(by_gmsh("a.bdf")); }, 0, {}, {}, {}, "does not end with ENDDATA"},
      {"BdfOtherSystem",
       ".bdf",
       [] { return replaced(by_gmsh("a.bdf"), "GRID    5       0 ", "GRID    5       3 "); },
       0,
       {},
       {},
       {},
       "GRID: a grid point in a coordinate system of its own"},
      {"BdfNodeMissing",
       ".bdf",
       [] { return replaced(by_gmsh("a.bdf"), "GRID    5  ", "GRID    99 "); },
       0,
       {},
       {},
       {},
       "BdfNodeMissing"},
      {"BdfHexahedron",
       ".bdf",
       [] { return replaced(by_gmsh("a.bdf"), "ENDDATA", "CHEXA,900,1,1,2,3,4,5,6,+\n+,7,8\nENDDATA"); },
       0,
       {},
       {},
       {},
       "CHEXA: solids of another shape"},
      {"Medit", ".mesh", gmsh_file("a.mesh"), 2, {"volume_1", "volume_2"}, {"surface_1"}, {}, ""},
      {"MeditSecondOrderOfGmsh", ".mesh", gmsh_file("a.mesh", 2), 0, {}, {}, {}, "Triangles holds more than it states"},
      {"MeditSecondOrder",
       ".mesh",
       text("MeshVersionFormatted 2\nDimension\n3\nVertices\n10\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n.5 0 0 0\n.5 .5 0 "
            "0\n0 .5 0 0\n0 0 .5 0\n.5 0 .5 0\n0 .5 .5 0\nTetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 4\nEnd\n"),
       1.0 / 6,
       {"volume_4"},
       {},
       {},
       kCorners},
      {"MeditCut", ".mesh", [] { return cut(by_gmsh("a.mesh")); }, 0, {}, {}, {}, "is cut off"},
      {"MeditMiscount",
       ".mesh",
       text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nTetrahedra\n2\n1 2 "
            "3 4 7\nEnd\n"),
       0,
       {},
       {},
       {},
       "Tetrahedra holds less than it states"},
      {"MeditHexahedra",
       ".mesh",
       text("MeshVersionFormatted 2\nDimension 3\nHexahedra\n1\n1 2 3 4 5 6 7 8 1\nEnd\n"),
       0,
       {},
       {},
       {},
       "of another shape than tetrahedra"},
      {"MeditByHand",
       ".mesh",
       text("MeshVersionFormatted 1 # x\nDimension 3\nVertices 4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nTetrahedra 1\n1 "
            "2 3 4 7\nTriangles 1\n1 2 3 9\nRidges 0\nEnd\n"),
       1.0 / 6,
       {"volume_7"},
       {"surface_9"},
       {},
       ""},
      {"Stl", ".stl", gmsh_file("a.stl", 1, {{"Mesh.SaveAll", 1}}), 2, {}, {}, {}, "", false},
      {"Brep", ".brep", gmsh_file("a.brep"), 2, {"volume_1", "volume_2"}, {}, {}, ""},
      {"Step", ".step", gmsh_file("a.step"), 2e-9, {"volume_1", "volume_2"}, {}, {}, ""},
      {"StepCut", ".stp", [] { return cut(by_gmsh("a.step")); }, 0, {}, {}, {}, "does not end with END-ISO-10303-21"},
  };
}

std::vector<Row> rows_of_others() {
  const auto bad = [](const std::string& extension, const std::string& stated) {
    std::string name = "Other" + extension.substr(1);
    std::replace(name.begin(), name.end(), '_', 'U');
    return Row{name, extension, text("anything"), 0, {}, {}, {}, stated};
  };
  return {bad(".vtu", "meshio convert"),
          bad(".vtk", "meshio convert"),
          bad(".med", "meshio convert"),
          bad(".cgns", "meshio convert"),
          bad(".exo", "meshio convert"),
          bad(".xdmf", "meshio convert"),
          bad(".igs", "save it as STEP"),
          bad(".IGES", "save it as STEP"),
          bad(".cdb", "write it as .inp, .bdf or .unv"),
          bad(".k", "write it as .inp, .bdf or .unv"),
          bad(".dat", "name it .bdf"),
          bad(".obj", "save it as STL"),
          bad(".ply", "save it as STL"),
          bad(".xyz", "is no kind of mesh file")};
}

std::vector<Row> all_rows() {
  std::vector<Row> rows = rows_of_gmsh();
  const std::vector<Row> more = rows_of_others();
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

class ForeignFiles : public testing::TestWithParam<Row> {};

TEST_P(ForeignFiles, AreReadWholeOrRefusedWithALineThatHelps) { test::check_row(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Table, ForeignFiles, testing::ValuesIn(all_rows()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace breccia::foreign_table_test
