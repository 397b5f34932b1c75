#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/mesh_bytes.hpp"
#include "sample_meshes.hpp"
#include "system/child_process.hpp"

namespace breccia::hostile_mesh_test {
namespace {

using test::refusal_of;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\nMeshSize{:} = 1;\nPhysical Volume(\"box\") = {1};\n";

/// Whether a child can be kept from reading.
bool test_kernel_limits_files() {
  const ChildEnd end = run_in_child(
      {.readable = {"/usr"}}, [] {},
      [] { return std::vector<std::byte>(std::ifstream("/proc/self/status").good() ? 1 : 0); });
  return end.result.empty();
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

// --- Scripts that want more than to be read
// ---------------------------------------------------------------------------

/// A statement that would leave a file OUT behind, and what is said about it.
struct Attack {
  const char* name;
  std::string statement;
  const char* said;
  const char* or_said = said;  ///< by other versions of gmsh
};

void PrintTo(const Attack& attack, std::ostream* stream) { *stream << attack.name; }

class MeshScripts : public testing::TestWithParam<Attack> {};

TEST_P(MeshScripts, DoNothingButMakeAMesh) {
  const auto folder = test::scratch_folder(std::string("attack_") + GetParam().name);
  const std::string out = (folder / "stolen").string();
  std::string statement = GetParam().statement;
  for (std::size_t at = 0; (at = statement.find("OUT", at)) != std::string::npos; at += out.size())
    statement.replace(at, 3, out);
  GmshSource source;
  source.file = test::write_file(folder / "model.geo", kBox + statement + "\n");
  source.time_limit = 30;
  EXPECT_THAT(refusal_of(source),
              AllOf(HasSubstr("model.geo"), AnyOf(HasSubstr(GetParam().said), HasSubstr(GetParam().or_said))));
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"model.geo"});
}

const Attack kAttacks[] = {
    {"SystemCall", "SystemCall \"touch OUT\";", "model.geo:5: SystemCall: a mesh script may not run programs"},
    {"NonBlockingSystemCall", "NonBlockingSystemCall \"touch OUT\";", "model.geo:5: NonBlockingSystemCall"},
    {"System", "System \"touch OUT\";", "run a program"},
    {"SystemOfAVariable", "c = \"touch OUT\";\nSystem Str(c);", "model.geo"},
    {"ExternalProcess", "Field[1] = ExternalProcess;\nField[1].CommandLine = \"touch OUT\";\nBackground Field = 1;",
     "start a process", "run a program"},
    {"PrintfIntoAFile", "Printf(\"x\") > \"OUT\";", "open a file for writing"},
    {"PrintfBehindAFile", "Printf(\"x\") >> \"OUT\";", "open a file for writing"},
    {"SaveInACondition", "If (1)\nSave StrCat(\"OUT\", \".msh\") ;\nExit;\nEndIf", "model.geo:7: Exit"},
    {"CreateDir", "CreateDir \"OUT\";", "make a folder"},
    {"DeleteFile", "DeleteFile \"OUT\";", "model.geo"},
    {"Exit", "If (1)\nExit;\nEndIf", "model.geo:6: Exit"},
    {"Abort", "For i In {1:2}\nAbort;\nEndFor", "model.geo:6: Abort"},
    {"OnelabRun", "OnelabRun(\"c\", \"touch OUT\");", "model.geo"},
};

INSTANTIATE_TEST_SUITE_P(Attacks, MeshScripts, testing::ValuesIn(kAttacks),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(HostileMesh, AComputedIncludeRunsNoProgram) {
  const auto folder = test::scratch_folder("computed_include");
  test::write_file(folder / "part.geo", "SystemCall \"touch " + (folder / "stolen").string() + "\";\n");
  GmshSource source;
  source.file = test::write_file(folder / "model.geo",
                                 std::string(kBox) + "n = StrCat(CurrentDirectory, \"part.geo\");\nMerge Str(n);\n");
  EXPECT_THAT(refusal_of(source), HasSubstr("model.geo"));
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"model.geo", "part.geo"}));
}

TEST(HostileMesh, AnOptionFileBesideAMeshIsRefusedUnlessTrusted) {
  const auto folder = test::scratch_folder("options_beside");
  GmshSource source;
  source.file = test::write_file(folder / "model.geo", kBox);
  const Index expected = read_gmsh(source).mesh.num_elements();
  test::write_file(folder / "model.geo.opt", "Mesh.MeshSizeFactor = 0.2;\n");
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("model.geo.opt"), HasSubstr("--trust-geometry")));
  source.trust = true;
  EXPECT_GT(read_gmsh(source).mesh.num_elements(), expected);
}

TEST(HostileMesh, ATrustedScriptMayRunPrograms) {
  const auto folder = test::scratch_folder("trusted");
  GmshSource source;
  source.file = test::write_file(folder / "model.geo",
                                 std::string(kBox) + "SystemCall \"touch " + (folder / "made").string() + "\";\n");
  EXPECT_THAT(refusal_of(source), HasSubstr("--trust-geometry"));
  source.trust = true;
  EXPECT_GT(read_gmsh(source).mesh.num_elements(), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "made"));
}

TEST(HostileMesh, AScriptWithoutEndIsGivenUp) {
  GmshSource source;
  source.file =
      test::write_file(test::scratch_folder("endless") / "model.geo",
                       "For i In {1:1000000000}\n  For j In {1:1000000000}\n    x = i * j;\n  EndFor\nEndFor\n");
  source.time_limit = 0.5;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("mesh.time_limit"), HasSubstr("0.5 s")));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(HostileMesh, AMemoryBombIsGivenUp) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("bomb") / "model.geo", "x() = {1:3000000000};\n");
  source.memory_limit = 300e6 / static_cast<double>(memory_of_machine());
  EXPECT_THAT(refusal_of(source), HasSubstr("mesh.memory_limit"));
}

TEST(HostileMesh, AFifoIsNoMesh) {
  const auto folder = test::scratch_folder("fifo");
  GmshSource source;
  source.file = folder / "model.geo";
  std::filesystem::remove(source.file);
  ASSERT_EQ(::mkfifo(source.file.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of(source), HasSubstr("is not a file"));
}

TEST(HostileMesh, ScriptsIncludeOnlyRegularFilesBesideThemOrTheCase) {
  const auto outside = test::scratch_folder("include_outside"), folder = test::scratch_folder("include");
  test::write_file(outside / "part.geo", "Point(99) = {0, 0, 0};\n");
  test::write_file(folder / "own.geo", "Point(98) = {0, 0, 0};\n");
  std::filesystem::create_directory(folder / "folder.geo");
  ASSERT_EQ(::mkfifo((folder / "pipe.geo").c_str(), 0600), 0);
  const auto message = [&](const std::string& name, const std::filesystem::path& case_folder = {}) {
    GmshSource source;
    source.file = test::write_file(folder / "model.geo", kBox + ("Include \"" + name + "\";\n"));
    source.case_folder = case_folder;
    source.time_limit = 30;
    return refusal_of(source);
  };
  EXPECT_EQ(message("own.geo"), "accepted");
  EXPECT_THAT(message("/dev/zero"), AllOf(HasSubstr("model.geo:5: Include: /dev/zero"), HasSubstr("--trust-geometry")));
  EXPECT_THAT(message("/proc/self/mem"), HasSubstr("model.geo:5: Include: /proc/self/mem cannot be read"));
  EXPECT_THAT(message("pipe.geo"), AllOf(HasSubstr("model.geo:5: Include: "), HasSubstr("is not a file")));
  EXPECT_THAT(message("folder.geo"), AllOf(HasSubstr("model.geo:5: Include: "), HasSubstr("is a folder")));
  const std::string part = (outside / "part.geo").string();
  EXPECT_EQ(message(part, outside), "accepted");
  if (!test_kernel_limits_files()) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_THAT(message(part), AllOf(HasSubstr("model.geo:5: Include: " + part + " cannot be read"),
                                   HasSubstr("beneath the folder of the mesh or of the case")));
}

TEST(HostileMesh, AFileLargerThanTheMemoryIsRefusedBeforeItIsRead) {
  GmshSource source;
  source.file =
      test::write_file(test::scratch_folder("sparse") / "model.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  std::filesystem::resize_file(source.file, 1'000'000'000);
  source.memory_limit = 500e6 / static_cast<double>(memory_of_machine());
  EXPECT_THAT(refusal_of(source), AllOf(HasSubstr("is too large to be read"), HasSubstr("1 GB"), HasSubstr("500 MB")));
}

TEST(HostileMesh, ASparseFileIsReadWithinItsBounds) {
  const auto folder = test::scratch_folder("zeros");
  for (const char* name : {"model.msh", "model.brep", "model.stp", "model.stl", "model.geo"}) {
    GmshSource source;
    source.file = test::write_file(folder / name, "");
    std::filesystem::resize_file(source.file, 400'000'000);
    source.memory_limit = 500e6 / static_cast<double>(memory_of_machine());
    source.time_limit = 20;
    EXPECT_THAT(refusal_of(source), HasSubstr(name));
  }
}

/// A box of triangles with this corner opposite the origin.
std::string stl_box(double x, double y, double z) {
  constexpr int kFaces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                 {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& face : kFaces) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int n : face)
      text << "vertex " << (n % 4 == 1 || n % 4 == 2 ? x : 0) << ' ' << (n % 4 >= 2 ? y : 0) << ' ' << (n >= 4 ? z : 0)
           << '\n';
    text << "endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  return text.str();
}

TEST(HostileMesh, ASolidOfNoThicknessOrBeyondAllLengthsIsRefusedAtOnce) {
  const auto folder = test::scratch_folder("extents");
  const auto message = [&](double x, double y, double z) {
    GmshSource source;
    source.file = test::write_file(folder / "box.stl", stl_box(x, y, z));
    source.time_limit = 20;
    return refusal_of(source);
  };
  EXPECT_EQ(message(1, 2, 3), "accepted");
  EXPECT_THAT(message(1, 2, 0), HasSubstr("has no thickness along z"));
  EXPECT_THAT(message(1, 1e-12, 1), HasSubstr("has no thickness along y"));
  EXPECT_THAT(message(1e38, 1e38, 1e38), HasSubstr("is 1e+38 long along x"));
}

// --- Damaged mesh files
// -----------------------------------------------------------------------------------------------

TEST(HostileMesh, FlippedBytesOfABinaryMeshNeverEndThisProcess) {
  // The two boxes as a binary file of format 4.1, as gmsh lays it out, cannot be made here without gmsh: a format 2.2
  // file of one element is enough to lead its reader astray.
  std::string text = "$MeshFormat\n2.2 1 8\n";
  const auto number = [&text](auto value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  number(std::int32_t{1});
  text += "\n$EndMeshFormat\n$Nodes\n4\n";
  for (std::int32_t n = 1; n <= 4; ++n) {
    number(n);
    for (const double x : {n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0}) number(x);
  }
  text += "\n$EndNodes\n$Elements\n1\n";
  for (const std::int32_t word : {4, 1, 2, 1, 1, 1, 1, 2, 3, 4}) number(word);
  text += "\n$EndElements\n";
  const auto folder = test::scratch_folder("flipped");
  GmshSource source;
  source.file = test::write_file(folder / "whole.msh", text);
  ASSERT_EQ(refusal_of(source), "accepted");
  source.time_limit = 10;
  source.memory_limit = 500e6 / static_cast<double>(memory_of_machine());
  int tried = 0, accepted = 0;
  for (std::size_t at = 30; at < text.size(); at += 7) {
    std::string flipped = text;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x80);
    source.file = test::write_file(folder / "flipped.msh", flipped);
    accepted += refusal_of(source) == "accepted" ? 1 : 0;
    ++tried;
  }
  EXPECT_GT(accepted, 0) << "low bytes of coordinates do not matter";
  EXPECT_LT(accepted, tried) << "numbers of nodes and kinds do";
}

// --- What the child sends
// ---------------------------------------------------------------------------------------------

RawMesh sample() {
  RawMesh raw;
  raw.mesh.source = "a.msh";
  raw.mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
  raw.mesh.elements = {{0, 1, 2, 3}};
  raw.mesh.element_group = {0};
  raw.mesh.element_body = {0};
  raw.mesh.element_source_id = {17};
  raw.mesh.surface_faces = {{{0, 1, 2}, 0}};
  raw.mesh.group_nodes = {{3, 0}};
  raw.mesh.node_groups = {"tip"};
  raw.mesh.volume_groups = {"box"};
  raw.mesh.surface_groups = {"floor"};
  raw.mesh.num_bodies = 1;
  raw.ungrouped_elements = 3;
  raw.notes = {"a note"};
  return raw;
}

TEST(MeshBytes, BringTheWholeMeshBack) {
  const RawMesh sent = sample();
  const auto read = std::get<RawMesh>(mesh_of(bytes_of(sent)));
  EXPECT_EQ(read.mesh.source, sent.mesh.source);
  EXPECT_EQ(read.mesh.nodes, sent.mesh.nodes);
  EXPECT_EQ(read.mesh.elements, sent.mesh.elements);
  EXPECT_EQ(read.mesh.element_source_id, sent.mesh.element_source_id);
  EXPECT_EQ(read.mesh.surface_faces[0].nodes, sent.mesh.surface_faces[0].nodes);
  EXPECT_EQ(read.mesh.group_nodes[0].node, 3);
  EXPECT_EQ(read.mesh.node_groups, sent.mesh.node_groups);
  EXPECT_EQ(read.mesh.volume_groups, sent.mesh.volume_groups);
  EXPECT_EQ(read.mesh.surface_groups, sent.mesh.surface_groups);
  EXPECT_EQ(read.mesh.num_bodies, 1);
  EXPECT_EQ(read.ungrouped_elements, 3);
  EXPECT_EQ(read.notes, sent.notes);
}

TEST(MeshBytes, BringProblemsBack) {
  const std::vector<Problem> sent{{"a.geo", 7, "key", "what", "allowed", "given"}, {"", 0, "", "other", "", ""}};
  const auto read = std::get<std::vector<Problem>>(mesh_of(bytes_of(sent)));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].text(), sent[0].text());
  EXPECT_EQ(read[1].text(), sent[1].text());
}

TEST(MeshBytes, RefuseEveryCutAndEveryFlippedByte) {
  const std::vector<std::byte> whole = bytes_of(sample());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW((void)mesh_of(std::span(whole).first(size)), InputError) << size;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::vector<std::byte> flipped = whole;
    flipped[at] ^= std::byte{0x41};
    EXPECT_THROW((void)mesh_of(flipped), InputError) << at;
  }
}

TEST(MeshBytes, RefuseIndicesThatPointNowhere) {
  const auto refused = [](const auto& change) {
    RawMesh raw = sample();
    change(raw);
    EXPECT_THROW((void)mesh_of(bytes_of(raw)), InputError);
  };
  refused([](RawMesh& raw) { raw.mesh.elements[0][2] = 4; });
  refused([](RawMesh& raw) { raw.mesh.elements[0][2] = -1; });
  refused([](RawMesh& raw) { raw.mesh.element_group[0] = 1; });
  refused([](RawMesh& raw) { raw.mesh.element_body[0] = 1; });
  refused([](RawMesh& raw) { raw.mesh.element_body.clear(); });
  refused([](RawMesh& raw) { raw.mesh.surface_faces[0].nodes[0] = 4; });
  refused([](RawMesh& raw) { raw.mesh.surface_faces[0].group = 1; });
  refused([](RawMesh& raw) { raw.mesh.group_nodes[0].node = 4; });
  refused([](RawMesh& raw) { raw.mesh.group_nodes[0].group = 1; });
  refused([](RawMesh& raw) { raw.mesh.num_bodies = -1; });
  refused([](RawMesh& raw) { raw.ungrouped_elements = -1; });
}

}  // namespace
}  // namespace breccia::hostile_mesh_test
