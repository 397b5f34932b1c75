#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "end_to_end/program.hpp"

namespace breccia::test::solid_test {
namespace {

using nlohmann::json;

constexpr double kRoundOff = 1e-12;  // gmsh lays the corners out anew on its surfaces

/// An STL of a beam of 60 x 20 x 10, drawn in millimetres.
std::string beam() {
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  constexpr int kSize[3] = {60, 20, 10};
  std::string text = "solid beam\n";
  for (const auto& face : kFaces)
    for (const int half : {0, 1}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : {0, 1 + half, 2 + half}) {
        text += "vertex";
        for (int a = 0; a < 3; ++a) text += " " + std::to_string((face[corner] >> a & 1) != 0 ? kSize[a] : 0);
        text += "\n";
      }
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid beam\n";
}

const std::string kCase = R"(title = "beam"
[mesh]
file = "beam.stl"
scale = 0.001
size = "6 mm"
[[material]]
group = "beam"
young = "40 GPa"
poisson = 0.2
density = 2400
joints = "none"
[[stage]]
end = "2 us"
[[stage.constraint]]
group = "surface_1"
fixed = "xyz"
)";

TEST(Solid, ALibraryOfGmshThatCannotBeLoadedIsNamedOnce) {
  const Scratch scratch;
  scratch.write("beam.stl", beam());
  scratch.write("libbreccia_gmsh.so", "no library");
  const std::string file = scratch.write("case.toml", kCase),
                    environment = "LD_LIBRARY_PATH='" + scratch.path("").string() + "'";
  const std::string run = "run " + file + " -o ", words = "the library that reads meshes with gmsh cannot be loaded";
  for (const Outcome& outcome :
       {call("check " + file, environment), call(run + scratch.path("one").string(), environment),
        call_ranks(2, run + scratch.path("two").string(), environment)}) {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(words), outcome.err.rfind(words)) << "twice: " << outcome.err;
  }
}

TEST(Solid, ACaseOfAnStlIsCheckedAndRunWithTheSameBitsOnTwoRanks) {
  const Scratch scratch;
  scratch.write("beam.stl", beam());
  const std::string file = scratch.write("case.toml", kCase);
  const Outcome checked = call("check " + file);
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  for (const char* words : {"box           0.06 x 0.02 x 0.01 m", "a length of 1 is mesh.scale metres", "surface_6"})
    EXPECT_NE(checked.out.find(words), std::string::npos) << words << " in\n" << checked.out;
  std::array<json, 2> summary;
  for (const int ranks : {1, 2}) {
    const std::string folder = scratch.path("run" + std::to_string(ranks)).string();
    const Outcome run = call_ranks(ranks, "run " + file + " --progress none -o '" + folder + "'");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    summary[static_cast<std::size_t>(ranks - 1)] = json::parse(read_text(folder + "/summary.json"));
  }
  EXPECT_EQ(summary[0]["state_hash"], summary[1]["state_hash"]);
}

TEST(Solid, WhoseLengthsLookLikeMillimetresTakenForMetresIsAskedAbout) {
  const Scratch scratch;
  scratch.write("beam.stl", beam());
  const std::string file = scratch.write("case.toml", kCase);
  const Outcome checked = call("check " + file + " --set mesh.scale=1 --set mesh.size=6");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("states no unit, and the model is 60 x 20 x 10 m large"), std::string::npos)
      << checked.out;
}

TEST(Geometry, WithTheNumbersThatACaseMaySetTellsThemWithoutMeshing) {
  const Scratch scratch;
  const std::string file = scratch.write("bar.geo", "DefineConstant[ h = 2e-3, // element size\n n ];\n");
  const json wanted = {{{"names", {"h"}}, {"default", "2e-3"}, {"words", "element size"}},
                       {{"names", {"n"}}, {"default", ""}, {"words", ""}}};
  EXPECT_EQ(json::parse(call("mesh " + file + " --parameters").out)["parameters"], wanted);
  std::string text = kCase;
  text.replace(text.find("beam.stl"), 8, "bar.geo");
  for (const char* key : {"scale", "size"})
    if (const auto at = text.find(std::string(key) + " ="); at != std::string::npos)
      text.erase(at, text.find('\n', at) + 1 - at);
  const Outcome of_case = call("mesh " + scratch.write("bar.toml", text) + " --parameters");
  EXPECT_EQ(of_case.exit_code, 0) << of_case.out;
  EXPECT_EQ(json::parse(of_case.out)["parameters"], wanted);
  scratch.write("beam.stl", beam());
  const Outcome of_solid = call("mesh " + scratch.write("case.toml", kCase) + " --parameters");
  EXPECT_EQ(json::parse(of_solid.out)["parameters"], json::array());
}

TEST(Geometry, InPlaceOfACaseIsRefusedWithWhatACaseWouldSay) {
  const Scratch scratch;
  const std::string file = scratch.write("bar.geo", "Point(1) = {0, 0, 0};\n");
  for (const char* command : {"check ", "run "}) {
    const Outcome refused = call(command + file);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(
        refused.err.find("is a geometry or a mesh, not a case; allowed: a case (.toml) that names it: [mesh] with "
                         "file = \"bar.geo\""),
        std::string::npos)
        << refused.err;
  }
}

/// An Abaqus file of two tetrahedra, the second of which is a set of its own.
constexpr const char* kPair =
    "*NODE, NSET=all\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n*ELEMENT, TYPE=C3D4, ELSET=rock\n1,1,2,3,4\n"
    "*ELEMENT, TYPE=C3D4, ELSET=steel\n2,2,3,4,5\n*SURFACE, NAME=base\n1, S1\n";

TEST(Solid, AnyMeshIsReportedWithoutACaseAndWithWhatOneBeginsWith) {
  const Scratch scratch;
  const Outcome mesh = call("mesh " + scratch.write("pair.inp", kPair));
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  for (const char* words : {"2 elements, 8 nodes", "volume  rock", "surface base", "nodes   all", "radius ratio",
                            "file = \"pair.inp\"", "scale = 0.001", "group = \"steel\""})
    EXPECT_NE(mesh.out.find(words), std::string::npos) << words << " in\n" << mesh.out;
  const Outcome script = call("mesh " + scratch.write("box.geo",
                                                      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\n"
                                                      "Mesh 3;\nSave \"box.msh\";\nExit;\n"));
  EXPECT_EQ(script.exit_code, 0) << script.err;
  EXPECT_FALSE(std::filesystem::exists(scratch.path("box.msh")));
  const Outcome other = call("mesh " + scratch.write("grid.vtu", "<VTKFile>"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("meshio convert"), std::string::npos) << other.err;
}

TEST(Solid, GroupsWithoutElementsAreRefusedUnderEveryKeyThatNamesOne) {
  const Scratch scratch;
  scratch.write("empty.msh",
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"rock\"\n3 2 \"lost\"\n2 3 \"no_face\"\n"
                "$EndPhysicalNames\n$Entities\n0 0 1 2\n1 0 0 0 1 1 1 1 3 0\n1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n"
                "$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
                "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n");
  const auto material = [](const std::string& group) {
    return "[[material]]\ngroup = \"" + group +
           "\"\nyoung = \"1 GPa\"\npoisson = 0.2\ndensity = 1000\njoints = \"none\"\n";
  };
  const std::string head = "[mesh]\nfile = \"empty.msh\"\n" + material("rock"), stage = "[[stage]]\nend = \"1 us\"\n";
  const std::array cases{
      std::pair{head + material("lost") + stage, "lost"},
      std::pair{head + stage + "[[stage.constraint]]\ngroup = \"lost\"\nfixed = \"x\"\n", "lost"},
      std::pair{head + stage + "[[stage.pressure]]\nsurface = \"no_face\"\nvalue = 1\n", "no_face"},
      std::pair{head + stage + "[output]\ngauges = [\"lost\"]\n", "lost"},
  };
  for (const auto& [text, group] : cases) {
    const Outcome checked = call("check " + scratch.write("case.toml", text));
    EXPECT_EQ(checked.exit_code, 2) << text;
    EXPECT_NE(checked.err.find("the group \"" + std::string(group) + "\" of the mesh holds no element"),
              std::string::npos)
        << checked.err;
  }
  EXPECT_EQ(call("check " + scratch.write("case.toml", head + stage)).exit_code, 0);
}

TEST(Solid, WithoutACaseIsMeshedAndItsGroupsAndBoxTold) {
  const Scratch scratch;
  const std::string file = scratch.write("beam.stl", beam());
  const Outcome outcome = call("mesh " + file + " --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json told = json::parse(outcome.out);
  EXPECT_EQ(told["groups"]["volumes"][0]["name"], "beam");
  EXPECT_EQ(told["groups"]["surfaces"].size(), 6U);
  constexpr std::array<double, 3> kUpper{60, 20, 10};
  for (std::size_t a = 0; a < kUpper.size(); ++a)
    EXPECT_NEAR(told["box"]["upper"][a].get<double>(), kUpper[a], kRoundOff * kUpper[a]);
  const Outcome refused = call("mesh " + file + " --set mesh.size=1");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("is no case file: a geometry is meshed without a case"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace breccia::test::solid_test
