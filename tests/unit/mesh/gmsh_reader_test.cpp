#include "mesh/gmsh_reader.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <clocale>
#include <iterator>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "mesh/topology.hpp"
#include "sample_meshes.hpp"

#ifdef __SANITIZE_ADDRESS__
/// gmsh does not free what it built of a file it then refuses.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh"; }
#endif

namespace breccia::gmsh_reader_test {
namespace {

using test::refusal_of;
using test::volume_of;
using testing::AllOf;
using testing::HasSubstr;

GmshSource script(const std::string& name, const std::string& text) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("reader_" + name) / "model.geo", text);
  return source;
}

// --- Scripts and their parameters
// -------------------------------------------------------------------------------------

constexpr const char* kParametric = R"(SetFactory("OpenCASCADE");
DefineConstant[ length = 1, size = {0.5, Name "Parameters/size"} ];
If (!Exists(height)) height = 1; EndIf
depth = DefineNumber[ 1, Name "Parameters/depth" ];
Box(1) = {0, 0, 0, length, depth, height};
MeshSize{:} = size;
)";

TEST(GmshReader, SetsParametersOfEveryKindAndForgetsThemAfterwards) {
  constexpr double kRoundOff = 1e-12;
  GmshSource source = script("parameters", kParametric);
  EXPECT_NEAR(volume_of(read_gmsh(source).mesh), 1, kRoundOff);
  source.parameters = {{"length", 2.25}, {"height", 3}, {"Parameters/depth", 0.1}};
  EXPECT_NEAR(volume_of(read_gmsh(source).mesh), 2.25 * 3 * 0.1, kRoundOff);
  const auto coarse = read_gmsh(script("parameters", kParametric));
  EXPECT_NEAR(volume_of(coarse.mesh), 1, kRoundOff) << "a parameter outlived its reading";
  source.parameters = {{"size", 0.25}};
  const auto fine = read_gmsh(source);
  EXPECT_GT(fine.mesh.num_elements(), 2 * coarse.mesh.num_elements());
  source.parameters = {{"Parameters/size", 0.25}};
  EXPECT_EQ(read_gmsh(source).mesh.elements, fine.mesh.elements);
}

TEST(GmshReader, HandsAParameterOverToTheLastBit) {
  GmshSource source = script("bits", kParametric);
  const double length = 1.0 + 1.0 / 3.0;
  source.parameters = {{"length", length}};
  double highest = 0;
  for (const Vec3& node : read_gmsh(source).mesh.nodes) highest = std::max(highest, node.x());
  EXPECT_EQ(highest, length);
}

TEST(GmshReader, MakesTheSameMeshAgain) {
  const Mesh a = test::two_boxes("reader_repeat", 0.2, false).mesh,
             b = test::two_boxes("reader_repeat", 0.2, false).mesh;
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.element_source_id, b.element_source_id);
}

TEST(GmshReader, ReadsGroupsBodiesAndSurfacesOfAScript) {
  const auto [mesh, report] = test::two_boxes("reader_groups", 0.3, false);
  EXPECT_EQ(mesh.volume_groups, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(mesh.surface_groups, (std::vector<std::string>{"interface", "bottom"}));
  EXPECT_EQ(mesh.num_bodies, 2);
  EXPECT_EQ(mesh.element_body, mesh.element_group) << "here every group is one volume";
  EXPECT_GT(report.split_nodes, 0);
  EXPECT_EQ(report.elements, mesh.num_elements());
  EXPECT_EQ(report.volume_groups[0].count + report.volume_groups[1].count, mesh.num_elements());
  EXPECT_EQ(report.inverted_repaired, 0);
  EXPECT_EQ(report.duplicate_nodes, 0);
}

TEST(GmshReader, NamesUnnamedGroupsByTagAndLeavesUngroupedVolumesOut) {
  const std::string boxes =
      "SetFactory(\"OpenCASCADE\");\nBox(7) = {0,0,0,1,1,1};\nBox(9) = {2,0,0,1,1,1};\nMeshSize{:} = 1;\n";
  const auto all = read_gmsh(script("ungrouped", boxes));
  EXPECT_EQ(all.mesh.volume_groups, (std::vector<std::string>{"volume_7", "volume_9"}));
  EXPECT_TRUE(all.mesh.surface_groups.empty());
  EXPECT_NEAR(volume_of(all.mesh), 2, 1e-12);

  const auto one = read_gmsh(script("grouped", boxes + "Physical Volume(31) = {9};\nPhysical Surface(5) = {7};\n"));
  EXPECT_EQ(one.mesh.volume_groups, (std::vector<std::string>{"volume_31"}));
  EXPECT_EQ(one.mesh.surface_groups, (std::vector<std::string>{"surface_5"}));
  EXPECT_NEAR(volume_of(one.mesh), 1, 1e-12);
  EXPECT_EQ(one.report.ungrouped_elements + one.mesh.num_elements(), all.mesh.num_elements());
  EXPECT_GT(one.report.orphan_nodes, 0);
}

TEST(GmshReader, ScalesTheFilesUnits) {
  GmshSource source = script("scale", kParametric);
  source.scale = 1e-3;
  EXPECT_NEAR(volume_of(read_gmsh(source).mesh), 1e-9, 1e-21);
}

TEST(GmshReader, LeavesTheProcessesNumberFormatAlone) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  (void)read_gmsh(script("locale", kParametric));
  EXPECT_EQ(std::setlocale(LC_NUMERIC, nullptr), before);
}

// --- Mesh files in every format
// ---------------------------------------------------------------------------------------

struct Format {
  double version;
  bool binary;
  std::string name;
};

class GmshReaderFormats : public testing::TestWithParam<Format> {};

/// gmsh writes coordinates with 16 digits in ASCII: one unit in the 16th place.
constexpr double kWrittenDigits = 1e-15;

TEST_P(GmshReaderFormats, ReadBackTheMeshThatGmshWrote) {
  const auto folder = test::scratch_folder("format_" + GetParam().name);
  const auto geo = test::write_file(folder / "model.geo", test::kTwoBoxes);
  const auto msh = folder / "model.msh";
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", GetParam().version);
  gmsh::option::setNumber("Mesh.Binary", GetParam().binary ? 1 : 0);
  gmsh::open(geo.string());
  gmsh::model::mesh::generate(3);
  gmsh::write(msh.string());
  gmsh::finalize();

  for (const bool glue : {false, true}) {
    GmshSource from_script, from_mesh;
    from_script.file = geo;
    from_mesh.file = msh;
    from_script.glue = from_mesh.glue = glue;
    const auto expected = read_gmsh(from_script), read = read_gmsh(from_mesh);
    EXPECT_EQ(read.mesh.volume_groups, expected.mesh.volume_groups);
    EXPECT_EQ(read.mesh.surface_groups, expected.mesh.surface_groups);
    EXPECT_EQ(read.mesh.elements, expected.mesh.elements);
    EXPECT_EQ(read.mesh.element_group, expected.mesh.element_group);
    EXPECT_EQ(read.mesh.element_body, expected.mesh.element_body);
    EXPECT_EQ(read.mesh.num_bodies, glue ? 1 : 2);
    ASSERT_EQ(read.mesh.num_nodes(), expected.mesh.num_nodes());
    for (Index n = 0; n < read.mesh.num_nodes(); ++n) {
      EXPECT_LE((read.mesh.nodes[at(n)] - expected.mesh.nodes[at(n)]).cwiseAbs().maxCoeff(), kWrittenDigits);
    }
    const Topology a = build_topology(read.mesh), b = build_topology(expected.mesh);
    for (std::size_t g = 0; g < 2; ++g) EXPECT_EQ(a.surface_groups[g].size(), b.surface_groups[g].size());
  }
}

// gmsh 4.8 writes an empty file for binary 4.0, so that one format is left out.
INSTANTIATE_TEST_SUITE_P(Msh, GmshReaderFormats,
                         testing::Values(Format{2.2, false, "ascii_22"}, Format{2.2, true, "binary_22"},
                                         Format{4.0, false, "ascii_40"}, Format{4.1, false, "ascii_41"},
                                         Format{4.1, true, "binary_41"}),
                         [](const auto& run) { return run.param.name; });

/// A .msh 2.2 of one or more elements on six nodes: unit tetrahedron 1 2 3 4, node 5 its mirror image of 4, node 6
/// spare.
std::string msh22(const std::string& elements, int count, const std::string& node5 = "0 0 -1",
                  const std::string& version = "2.2") {
  return "$MeshFormat\n" + version + " 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 " + node5 +
         "\n6 9 9 9\n$EndNodes\n$Elements\n" + std::to_string(count) + "\n" + elements + "$EndElements\n";
}

GmshSource mesh_file(const std::string& text) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("reader_file") / "model.msh", text);
  return source;
}

TEST(GmshReader, RepairsInvertedElementsOfAFileAndDropsOrphans) {
  GmshSource source = mesh_file(msh22("70 15 2 1 1 6\n71 4 2 1 1 1 2 3 4\n72 4 2 1 1 1 2 3 5\n", 3));
  const auto [mesh, report] = read_gmsh(source);
  EXPECT_EQ(report.inverted_repaired, 1);
  EXPECT_EQ(report.orphan_nodes, 1);
  EXPECT_EQ(mesh.num_nodes(), 5);
  EXPECT_EQ(mesh.num_bodies, 1);
  EXPECT_NEAR(volume_of(mesh), 2.0 / 6, 1e-15);
  EXPECT_THAT(mesh.element_source_id, testing::UnorderedElementsAre(71, 72));
  source.repair_inverted = false;
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("inverted elements"), HasSubstr("72 (1 element)")));
}

// --- Refusals
// ---------------------------------------------------------------------------------------------------------

TEST(GmshReader, ReadsAfterEveryRefusal) {
  const GmshSource good = script("after", kParametric);
  for (const char* bad : {"L = 1;\nBox(1) = {0,0,0,L;\n", "SetFactory(\"OpenCASCADE\");\nBox(1)={0,0,0,0,1,1};\n",
                          "a = {1, 2", "If (1)\nPoint(1) = {0,0,0};\n", "\"never closed\n"}) {
    EXPECT_NE(refusal_of(script("before", bad)), "accepted") << bad;
    EXPECT_EQ(refusal_of(good), "accepted") << "after " << bad;
  }
}

TEST(GmshReader, RefusesParametersTheScriptDoesNotDefine) {
  GmshSource source = script("unknown", kParametric);
  source.parameters = {{"lenght", 2}, {"depth", 2}, {"size", std::numeric_limits<double>::infinity()}};
  EXPECT_THAT(refusal_of(source),
              AllOf(HasSubstr("mesh.parameters.lenght: the script defines no such parameter"),
                    HasSubstr("allowed: height, length, size, Parameters/depth, Parameters/size"),
                    HasSubstr("mesh.parameters.depth"), HasSubstr("mesh.parameters.size: is not finite")));
  source = script("none", "Point(1) = {0, 0, 0};");
  source.parameters = {{"x", 1}};
  EXPECT_THAT(refusal_of(source), HasSubstr("none: it has no DefineConstant"));
}

TEST(GmshReader, RefusesFilesThatCannotBeRead) {
  const auto folder = test::scratch_folder("reader_missing");
  GmshSource source;
  source.file = folder / "missing.geo";
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("missing.geo"), HasSubstr("the file does not exist")));
  source.file = test::write_file(folder / "part.obj", "ISO-10303-21;");
  EXPECT_THAT(refusal_of(source),
              AllOf(HasSubstr("allowed: .geo, .msh of format 2.2 to 4.1, .inp"), HasSubstr("given: .obj")));
  std::filesystem::create_directories(folder / "folder.msh");
  source.file = folder / "folder.msh";
  EXPECT_THAT(refusal_of(source), HasSubstr("is a folder"));
}

TEST(GmshReader, RefusesParametersWithAMeshFileAndAScaleThatIsNone) {
  GmshSource source = mesh_file(msh22("1 4 2 1 1 1 2 3 4\n", 1));
  source.parameters["size"] = 1;
  source.scale = 0;
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("a mesh file takes no parameters"), HasSubstr("mesh.scale")));
}

struct BadScript {
  const char* name;
  const char* text;
  const char* message;
};

class GmshReaderRefusesScripts : public testing::TestWithParam<BadScript> {};

TEST_P(GmshReaderRefusesScripts, WithAMessageThatSaysWhatAndWhere) {
  EXPECT_THAT(refusal_of(script("bad", GetParam().text)), AllOf(HasSubstr("model.geo"), HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, GmshReaderRefusesScripts,
    testing::Values(
        BadScript{"Syntax", "L = 1;\nBox(1) = {0, 0, 0, L;\n", "model.geo:2: gmsh: syntax error"},
        BadScript{"UnknownVariable", "SetFactory(\"OpenCASCADE\");\n\nBox(1) = {0, 0, 0, width, 1, 1};\n",
                  "model.geo:3: gmsh: Unknown variable 'width'"},
        BadScript{"DegenerateBox", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0, 1, 1};\n", "Degenerate box"},
        BadScript{"Empty", "", "the file is empty"},
        BadScript{"NothingButAComment", "// nothing\n", "the mesh has no tetrahedra"},
        BadScript{"OnlyASurface", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n",
                  "the mesh has no tetrahedra"},
        BadScript{"RunsAProgram", "SystemCall \"true\";\n",
                  "model.geo:1: SystemCall: a mesh script may not run programs"},
        BadScript{"EndsTheProcess", "If (1)\nExit;\nEndIf\n", "model.geo:2: Exit: a mesh script may not"},
        BadScript{
            "MeshesThatDifferEachTime",
            "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\nMesh.Algorithm3D = 10;\n",
            "model.geo: Mesh.Algorithm3D: selects HXT, which makes another mesh each time; allowed: 1 (Delaunay)"},
        BadScript{"Hexahedra",
                  "SetFactory(\"OpenCASCADE\");\nBox(3) = {0,0,0,1,1,1};\nTransfinite Curve{:} = 2;\n"
                  "Transfinite Surface{:};\nRecombine Surface{:};\nTransfinite Volume{:};\n",
                  "given: 1 of Hexahedron 8"},
        BadScript{"SurfaceOfAnUngroupedVolume",
                  "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\nBox(2) = {2,0,0,1,1,1};\n"
                  "Physical Volume(\"a\") = {1};\nPhysical Surface(\"far\") = {8};\n",
                  "surface group \"far\": holds triangles that are no face of any element"},
        BadScript{"NotchThatEndsInsideAnExtrudedLayer",
                  "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0,-1,0,2,2};\nPoint(100) = {0,0,0};\n"
                  "Point(101) = {1,0,0};\nLine(100) = {100,101};\n"
                  "BooleanFragments{ Surface{1}; Delete; }{ Line{100}; Delete; }\ns() = Surface{:};\n"
                  "Extrude {0,0,0.5} { Surface{s()}; Layers{1}; }\nPhysical Volume(\"plate\") = Volume{:};\n"
                  "Physical Surface(\"notch\") = Surface In BoundingBox {-0.1,-0.1,-0.1,1.1,0.1,0.6};\n"
                  "MeshSize{:} = 0.5;\n",
                  "cut the surface in two along the line and on from its tip to the border"},
        BadScript{"InterfaceThatIsExtrudedTwice",
                  "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0,-1,0,2,1};\nRectangle(2) = {0,0,0,2,1};\n"
                  "BooleanFragments{ Surface{1,2}; Delete; }{ }\na[] = Extrude {0,0,0.5} { Surface{1}; Layers{1}; };\n"
                  "b[] = Extrude {0,0,0.5} { Surface{2}; Layers{1}; };\nPhysical Volume(\"lower\") = {a[1]};\n"
                  "Physical Volume(\"upper\") = {b[1]};\n"
                  "Physical Surface(\"mid\") = Surface In BoundingBox {-0.1,-0.1,-0.1,2.1,0.1,0.6};\n"
                  "MeshSize{:} = 0.5;\n",
                  "extruded by two Extrude commands"},
        BadScript{"OpenShell",
                  "Point(1)={0,0,0,.5};Point(2)={1,0,0,.5};Point(3)={0,1,0,.5};Point(4)={0,0,1,.5};\n"
                  "Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};Line(4)={1,4};Line(5)={2,4};Line(6)={3,4};\n"
                  "Curve Loop(1)={1,2,3};Curve Loop(2)={1,5,-4};Curve Loop(3)={2,6,-5};\n"
                  "Plane Surface(1)={1};Plane Surface(2)={2};Plane Surface(3)={3};\n"
                  "Surface Loop(1)={1,2,3};Volume(1)={1};\n",
                  "gmsh: No elements in volume 1"},
        BadScript{"ItsOwnError", "Error(\"radius must exceed %g\", 3);\n", "gmsh: radius must exceed 3"}),
    [](const auto& run) { return run.param.name; });

struct BadFile {
  const char* name;
  std::string text;
  const char* message;
};

class GmshReaderRefusesFiles : public testing::TestWithParam<BadFile> {};

TEST_P(GmshReaderRefusesFiles, WithAMessageThatSaysWhat) {
  EXPECT_THAT(refusal_of(mesh_file(GetParam().text)), AllOf(HasSubstr("model.msh"), HasSubstr(GetParam().message)));
}

const std::string kOne = "71 4 2 1 1 1 2 3 4\n";

INSTANTIATE_TEST_SUITE_P(
    Files, GmshReaderRefusesFiles,
    testing::Values(
        BadFile{"Empty", "", "the file is empty"}, BadFile{"Blank", "\n\n", "does not begin with $MeshFormat"},
        BadFile{"NoMesh", "<html></html>", "does not begin with $MeshFormat"},
        BadFile{"OldFormat", msh22(kOne, 1, "0 0 -1", "1.0"),
                "the mesh format is not supported; allowed: 2.2 to 4.1; given: 1.0"},
        BadFile{"FutureFormat", msh22(kOne, 1, "0 0 -1", "5.0"), "given: 5.0"},
        BadFile{"NoElements", msh22("", 0), "the mesh has no tetrahedra"},
        BadFile{"OnlyTriangles", msh22("1 2 2 1 1 1 2 3\n", 1), "the mesh has no tetrahedra"},
        BadFile{"Truncated", msh22(kOne, 3), "$Elements: it holds less than its heading states"},
        BadFile{"MissingNode", msh22("71 4 2 1 1 1 2 3 44\n", 1), "gmsh: "},
        BadFile{"NotFinite", msh22(kOne + "72 4 2 1 1 1 3 2 5\n", 2, "0 nan -1"), "72 (1 element)"},
        BadFile{"ZeroVolume", msh22(kOne + "72 4 2 1 1 1 3 2 5\n", 2, "1 1 0"), "elements of zero volume"},
        BadFile{
            "ElementsOfOneNumber", msh22(kOne + kOne + "72 4 2 1 1 1 3 2 5\n", 3),
            "mesh.file: elements share a number: gmsh would keep one of them; allowed: a number of its own for each "
            "of the 3 elements; given: elements 71, and 2 different numbers"},
        BadFile{
            "NodesOfOneNumber",
            std::string(msh22(kOne, 1, "0 0 -1\n4 0 0 2")).replace(msh22(kOne, 1).find("6\n1 0 0 0"), 1, "7"),
            "nodes share a number: gmsh would keep one of them; allowed: a number of its own for each of the 7 nodes"},
        BadFile{"NodesOfOneNumberInFormat4",
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 5 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 "
                "1\n3 2 0 1\n4\n0 0 2\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n",
                "node 4: stands twice, at different places"},
        BadFile{"Prism", msh22("71 6 2 1 5 1 2 3 4 5 6\n", 1), "given: 1 of Prism 6"},
        BadFile{"StraySurface", msh22(kOne + "80 2 2 6 3 1 2 6\n", 2), "surface group \"surface_6\": holds triangles"}),
    [](const auto& run) { return run.param.name; });

template <class... Parts>
std::string bytes(Parts... parts) {
  return (std::string(reinterpret_cast<const char*>(&parts), sizeof parts) + ...);
}

/// A binary .msh 2.2 of two tetrahedra, the numbers of one node and one element of which can be chosen.
std::string binary_msh22(std::int32_t last_node, std::int32_t last_element) {
  std::string nodes;
  for (std::int32_t n = 1; n <= 4; ++n) nodes += bytes(n, n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0);
  return "$MeshFormat\n2.2 1 8\n" + bytes(1) + "\n$EndMeshFormat\n$Nodes\n5\n" + nodes +
         bytes(last_node, 0.0, 0.0, -1.0) + "\n$EndNodes\n$Elements\n2\n" + bytes(4, 2, 2, 1, 1, 1, 1, 2, 3, 4) +
         bytes(last_element, 1, 1, 1, 3, 2, 5) + "\n$EndElements\n";
}

TEST(GmshReader, RefusesBinaryFilesInWhichNodesOrElementsShareANumber) {
  EXPECT_EQ(refusal_of(mesh_file(binary_msh22(5, 2))), "accepted");
  EXPECT_THAT(refusal_of(mesh_file(binary_msh22(5, 1))), HasSubstr("given: elements 1, and 1 different numbers"));
  EXPECT_THAT(refusal_of(mesh_file(binary_msh22(4, 2))), HasSubstr("given: nodes 4, and 4 different numbers"));
}

TEST(GmshReader, RefusesTruncatedMeshFiles) {
  const auto folder = test::scratch_folder("reader_truncated");
  const auto geo = test::write_file(folder / "model.geo", test::kTwoBoxes);
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open(geo.string());
  gmsh::model::mesh::generate(3);
  std::vector<std::string> names;
  for (const auto& [version, binary] : {std::pair{2.2, false}, {2.2, true}, {4.0, false}, {4.1, false}, {4.1, true}}) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
    names.push_back(std::to_string(names.size()) + ".msh");
    gmsh::write((folder / names.back()).string());
  }
  gmsh::finalize();
  for (const std::string& name : names) {
    std::ifstream in(folder / name, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    for (int percent = 0; percent < 100; percent += 7) {
      GmshSource source;
      source.file =
          test::write_file(folder / "cut.msh", whole.substr(0, whole.size() * static_cast<std::size_t>(percent) / 100));
      EXPECT_NE(refusal_of(source), "accepted") << name << " cut at " << percent << " %";
    }
  }
}

}  // namespace
}  // namespace breccia::gmsh_reader_test
