#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "base/child_process.hpp"
#include "base/error.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/mesh_bytes.hpp"
#include "sample_meshes.hpp"

namespace breccia {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\nMeshSize{:} = 1;\nPhysical Volume(\"box\") = {1};\n";

std::string refusal_of(const GmshSource& source) {
  try {
    (void)read_gmsh(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
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
}  // namespace breccia
