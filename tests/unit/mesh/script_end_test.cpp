#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"

namespace breccia::script_end_test {
namespace {

namespace fs = std::filesystem;
using test::volume_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kBox =
    "SetFactory(\"OpenCASCADE\");\nDefineConstant[ l = 1 ];\nBox(1) = {0,0,0,l,1,1};\nMeshSize{:} = 1;\n"
    "Physical Volume(\"box\") = {1};\n";

GmshSource source(const std::string& name, const std::string& text) {
  GmshSource asked;
  asked.file = test::write_file(test::scratch_folder("script_end_" + name) / "model.geo", text);
  asked.time_limit = 60;
  return asked;
}

constexpr double kRoundOff = 1e-12;

struct End {
  const char* name;
  const char* statements;
};
void PrintTo(const End& one, std::ostream* stream) { *stream << one.name; }

class ScriptEnds : public testing::TestWithParam<End> {};

TEST_P(ScriptEnds, GiveTheMeshOfTheScriptWithoutThemAndWriteNothing) {
  const Mesh expected = read_gmsh(source("plain", kBox)).mesh;
  GmshSource asked = source(GetParam().name, std::string(kBox) + GetParam().statements);
  const Mesh mesh = read_gmsh(asked).mesh;
  EXPECT_EQ(mesh.volume_groups, expected.volume_groups);
  EXPECT_EQ(mesh.elements, expected.elements);
  EXPECT_EQ(mesh.nodes, expected.nodes);
  const fs::directory_iterator files(asked.file.parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  asked.parameters["l"] = 2.5;
  EXPECT_NEAR(volume_of(read_gmsh(asked).mesh), 2.5, kRoundOff);
}

const End kEnds[] = {
    {"Save", "Save \"out.msh\";\n"},
    {"MeshAndSave", "Mesh 3;\nSave \"out.msh\";\n"},
    {"SaveOfAName", "Mesh 3;\nSave StrCat(\"out\", \".msh\");\n"},
    {"SaveWithoutBlank", "Save\"out.msh\";"},
    {"Exit", "Exit;\n"},
    {"SaveAndExit", "Mesh.SaveAll = 1;\nMesh 3;\nSave \"out.msh\";\nExit;\nBox(2) = {9, 9, 9, 1, 1, 1};\n"},
    {"Abort", "Abort;\nnonsense nonsense\n"},
    {"Print", "Print \"out.png\";\n"},
    {"DrawAndSleep", "Draw;\nSleep 0.1;\n"},
    {"SaveInACondition", "If (1)\n  Save \"out.msh\";\nEndIf\n"},
    {"Comments", "/* Save \"a\";\nExit; */ // Exit;\nSave \"out.msh\" /* ; */ ;\n"},
    {"Mesh", "Mesh 3;\n"},
};

INSTANTIATE_TEST_SUITE_P(Ends, ScriptEnds, testing::ValuesIn(kEnds),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(ScriptEnd, FilesBesideTheScriptAreFoundAndErrorsKeepTheirLine) {
  GmshSource asked =
      source("include", "Include \"size.geo\";\nMerge StrCat(CurrentDirectory, \"box.geo\");\nSave \"out.msh\";\n");
  test::write_file(asked.file.parent_path() / "size.geo", "h = 0.5;\n");
  test::write_file(asked.file.parent_path() / "box.geo",
                   "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\nMeshSize{:} = h;\n");
  EXPECT_NEAR(volume_of(read_gmsh(asked).mesh), 1, kRoundOff);
  try {
    (void)read_gmsh(source("line", std::string(kBox) + "Save \"a.msh\";\nnonsense = unknown;\nExit;\n"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("model.geo:7: "), HasSubstr("unknown")));
  }
}

TEST(ScriptEnd, AMeshThatTheScriptHasRefinedIsKept) {
  const Index coarse = read_gmsh(source("coarse", std::string(kBox) + "Mesh 3;\n")).mesh.num_elements();
  EXPECT_EQ(read_gmsh(source("fine", std::string(kBox) + "Mesh 3;\nRefineMesh;\n")).mesh.num_elements(), 8 * coarse);
}

}  // namespace
}  // namespace breccia::script_end_test
