#include <gtest/gtest.h>
#include <sys/stat.h>

#include "end_to_end/program.hpp"
#include "end_to_end/wrong_inputs.hpp"

namespace breccia::test::wrong_input_test {
namespace {

constexpr std::size_t kEvery = 9;  // a sample of the table, on two ranks

constexpr const char* kHead = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Files that the table names beside the case.
void write_wrong_files(const Scratch& scratch) {
  std::string deep = "a";
  for (int i = 0; i < 50000; ++i) deep += ".a";
  scratch.write("empty.toml", "");
  scratch.write("zeros.toml", std::string(1000, '\0'));
  scratch.write("letters.toml", "title = \"\xff\xfe\"\n");
  scratch.write("deep.toml", deep + " = 1\n");
  scratch.write("brackets.toml", "a = " + std::string(50000, '[') + "\n");
  std::filesystem::create_directory(scratch.path("folder.msh"));
  for (const char* pipe : {"pipe.toml", "pipe.geo"}) ::mkfifo(scratch.path(pipe).c_str(), 0600);
  const std::string node = "4 0 0 1\n$EndNodes\n", tetra = "1 4 2 1 1 1 2 3 4\n$EndElements\n";
  scratch.write("nothing.msh", "");
  scratch.write("cut.msh", std::string(kHead).substr(0, 60));
  scratch.write("nine.msh", "$MeshFormat\n9.0 0 8\n$EndMeshFormat\n");
  scratch.write("infinite.msh", std::string(kHead) + "4 0 0 inf\n$EndNodes\n$Elements\n1\n" + tetra);
  scratch.write("holes.msh", std::string(kHead) + node + "$Elements\n1\n1 4 2 1 1 1 2 3 9\n$EndElements\n");
  scratch.write("count.msh", std::string(kHead) + node + "$Elements\n99999999\n" + tetra);
  scratch.write("cut.step", "ISO-10303-21;\nHEADER;\n");
  scratch.write("open.stl",
                "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n"
                "endloop\nendfacet\nendsolid one\n");
  scratch.write("opted.geo", "Point(1) = {0, 0, 0};\n");
  scratch.write("opted.geo.opt", "SystemCall \"true\";\n");
  scratch.write("system.geo", "SystemCall \"true\";\n");
  scratch.write("computed.geo", "c = \"true\";\nSystem Str(c);\nPoint(1) = {0, 0, 0};\n");
  scratch.write("writes.geo", "Printf(\"x\") > \"" + scratch.path("written").string() + "\";\n");
  scratch.write("exits.geo", "Exit;\n");
  std::filesystem::create_directories(scratch.path("sub"));
  std::filesystem::create_directories(scratch.path("folder.csv"));
  ::mkfifo(scratch.path("pipe.csv").c_str(), 0600);
  for (const auto& [name, content] : wrong_data_files()) scratch.write(name, content);
  scratch.write("endless.geo", "For i In {1:1000000000}\n  x = i;\nEndFor\n");
}

class WrongInput : public testing::TestWithParam<Wrong> {};

TEST_P(WrongInput, IsRefusedWithItsMessageAndExitCode) {
  const Wrong& wrong = GetParam();
  const Scratch scratch;
  // The mesh files need no raster keys: what stood in the section goes with it.
  std::string text = wrong.from.empty() ? kSmallCase : changed(wrong.from, wrong.to);
  if (const std::size_t ignored = text.find("[ignored]"); ignored != std::string::npos) {
    text.erase(ignored, text.find("[[material]]") - ignored);
  }
  const std::string file = scratch.write("case.toml", text);
  scratch.write("flat.msh", std::string(kHead) + "4 1 1 0\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  scratch.write("empty.msh", std::string(kHead) + "4 0 0 1\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n");
  scratch.write("broken.geo", "Point(1) = {0, 0, 0;\n");
  scratch.write("good.geo",
                "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0, 1,1,1};\nPhysical Volume(\"box\") = {1};\n");
  write_wrong_files(scratch);
  const std::string folder = scratch.path("").parent_path().string();
  const std::string arguments = replaced(replaced(wrong.arguments, "CASE", file), "DIR", folder);

  const Outcome outcome = call(arguments, wrong.environment);
  EXPECT_EQ(outcome.exit_code, wrong.exit_code) << outcome.out << outcome.err;
  const std::string said = wrong.exit_code == kUsage ? outcome.out + outcome.err : outcome.err;
  for (const std::string& fragment : wrong.message) {
    EXPECT_NE(said.find(replaced(fragment, "DIR", folder)), std::string::npos)
        << "'" << fragment << "' is missing in: " << said;
  }
  EXPECT_EQ(said.find("terminate called"), std::string::npos);
  const std::string mark = "breccia: error:";
  EXPECT_EQ(outcome.err.find(mark), outcome.err.rfind(mark)) << "more than one message: " << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(, WrongInput, testing::ValuesIn(wrongs()), [](const auto& one) { return one.param.name; });
INSTANTIATE_TEST_SUITE_P(OfKeys, WrongInput, testing::ValuesIn(wrong_keys()),
                         [](const auto& one) { return one.param.name; });

TEST(WrongInputOfRanks, IsRefusedWithOneMessageByTwoOfThem) {
  const Scratch scratch;
  write_wrong_files(scratch);
  const std::string mesh = changed("[mesh.raster]", "[mesh]\nfile = \"FILE\"\n[ignored]");
  const auto with_mesh = [&](const std::string& file) {
    std::string text = replaced(mesh, "FILE", file);
    const std::size_t ignored = text.find("[ignored]");
    return text.erase(ignored, text.find("[[material]]") - ignored);
  };
  for (const auto& [text, fragment] :
       std::vector<std::pair<std::string, std::string>>{{with_mesh("writes.geo"), "open a file for writing"},
                                                        {with_mesh("computed.geo"), "run a program"},
                                                        {with_mesh("cut.msh"), "cut.msh"},
                                                        {changed("poisson = 0.3", "poisson = 0.5"), "poisson"},
                                                        {changed("[output]", "[outputs]"), "outputs"}}) {
    const std::string file = scratch.write("two.toml", text);
    const Outcome outcome = call_ranks(2, "run " + file + " -o '" + scratch.path("run").string() + "'");
    EXPECT_EQ(outcome.exit_code, kInput) << outcome.err;
    const std::size_t first = outcome.err.find(fragment);
    EXPECT_NE(first, std::string::npos) << fragment << " is missing in: " << outcome.err;
    const std::string mark = "breccia: error:";
    EXPECT_EQ(outcome.err.find(mark), outcome.err.rfind(mark)) << "told by both: " << outcome.err;
  }
}

TEST(WrongInputOfRanks, OfKeysAndDataFilesIsRefusedWithOneMessageByTwoOfThem) {
  const Scratch scratch;
  write_wrong_files(scratch);
  std::size_t tried = 0;
  for (const Wrong& wrong : wrong_keys()) {
    if (wrong.arguments != "check CASE" || tried++ % kEvery != 0) continue;
    const std::string file = scratch.write("two.toml", changed(wrong.from, wrong.to));
    const Outcome outcome = call_ranks(2, "run " + file + " -o '" + scratch.path("run").string() + "'");
    EXPECT_EQ(outcome.exit_code, kInput) << wrong.name << ": " << outcome.err;
    for (const std::string& fragment : wrong.message)
      EXPECT_NE(outcome.err.find(replaced(fragment, "case.toml", "two.toml")), std::string::npos)
          << wrong.name << ": " << fragment << " is missing in: " << outcome.err;
    const std::string mark = "breccia: error:";
    EXPECT_EQ(outcome.err.find(mark), outcome.err.rfind(mark)) << wrong.name << ": told by both: " << outcome.err;
  }
  EXPECT_GT(tried, 100u);
}

TEST(WrongInputOfRanks, IsRefusedWhereTheEnvironmentOfOneOfThemIsWrong) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  const std::string arguments = "run " + file + " --set domains.patience=5 -o '" + run + "'";
  const Outcome outcome = call_each_rank({{arguments, ""}, {arguments + " --progress none", "BRECCIA_SIMD=sse9"}});
  EXPECT_EQ(outcome.exit_code, kInput) << outcome.err;
  EXPECT_NE(outcome.err.find("BRECCIA_SIMD: is no instruction set"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(run));
}

TEST(WrongInputOfTheSystem, AStackLimitThatIsTooLowIsToldOrRaised) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::string run = "run " + file + " --progress none -o '" + scratch.path("run").string() + "'";
  const Outcome refused = call(run, "ulimit -s 256;");
  EXPECT_EQ(refused.exit_code, kInput) << refused.err;
  EXPECT_EQ(
      refused.err,
      "breccia: error: the limit of the stack (ulimit -s): is too low; allowed: at least 512 KiB; given: 256 KiB\n");
  const Outcome raised = call(run, "ulimit -S -s 256;");
  EXPECT_EQ(raised.exit_code, 0) << raised.err;
}

TEST(WrongInputTable, HoldsAtLeast250Cases) {
  EXPECT_GE(wrongs().size(), 150u);
  EXPECT_GE(wrong_keys().size(), 100u);
}

}  // namespace
}  // namespace breccia::test::wrong_input_test
