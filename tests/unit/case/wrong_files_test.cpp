#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "case_files.hpp"

namespace breccia::case_::wrong_files_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(WrongCases, ABreakableGroupNeedsAJointLaw) {
  EXPECT_THAT(message_of(replaced(minimal, "joints = \"none\"\n", "")),
              AllOf(HasSubstr("case.toml:3: material[0].joints: the group is breakable but has no joint law"),
                    HasSubstr("[[joint]] with group = \"raster\"")));
}

TEST(WrongCases, AKeyThatIsTooDeepIsRefusedWithItsLine) {
  std::string deep = "a";
  for (int i = 0; i < 50000; ++i) deep += ".a";
  EXPECT_THAT(message_of("title = \"x\"\n" + deep + " = 1\n"),
              HasSubstr("case.toml:2: a key is too deep; allowed: at most 64"));
  EXPECT_THAT(message_of("[" + deep + "]\n"), HasSubstr("a key is too deep"));
  EXPECT_THAT(message_of("x = {" + deep + " = 1}\n"), HasSubstr("a key is too deep"));
  const std::string dots(200, '.');
  for (const std::string& text : {"title = \"" + dots + "\"\n", "title = \"\"\"\n" + dots + "\n\"\"\"\n",
                                  "# " + dots + "\n", "title = '" + dots + "'\n", "title = \"\\\"" + dots + "\"\n"})
    EXPECT_THAT(message_of(text + minimal), testing::Not(HasSubstr("too deep"))) << text;
}

TEST(WrongCases, ACaseNeedsMeshMaterialAndStage) {
  EXPECT_THAT(message_of(""),
              AllOf(HasSubstr("mesh: is missing"), HasSubstr("material: is missing"), HasSubstr("stage: is missing")));
}

TEST(WrongCases, AnEmptyListOfMaterialsIsMissing) {
  EXPECT_THAT(message_of("material = []\n[mesh.raster]\ncell_size = 1\n[[stage]]\nend = 1\n"),
              HasSubstr("material: is missing"));
}

TEST(WrongCases, ARasterHasItsOwnChecks) {
  const auto raster = [](const std::string& keys) {
    return message_of(replaced(minimal, "cell_size = \"10 mm\"", keys));
  };
  EXPECT_THAT(raster("cells = 1"), HasSubstr("mesh.raster.cell_size: is missing"));
  EXPECT_THAT(raster("cell_size = 0"), HasSubstr("mesh.raster.cell_size: is out of range"));
  EXPECT_THAT(raster("cell_size = 1\ncells = [1, 0, 1]"), HasSubstr("mesh.raster.cells[1]: is out of range"));
  EXPECT_THAT(raster("cell_size = 1\ncells = [1, 2.5, 1]"), HasSubstr("mesh.raster.cells[1]: is a number"));
  EXPECT_THAT(raster("cell_size = 1\nkind = \"tetrahedra\"\ncells = 2"), HasSubstr("single tetrahedra have no cells"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0], upper = [1, 1, 1]}"),
              HasSubstr("mesh.raster.slit: is not plane"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0], upper = [1, 0, 0]}"),
              HasSubstr("mesh.raster.slit: is not plane"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0]}"), HasSubstr("mesh.raster.slit.upper: is missing"));
  EXPECT_THAT(raster("cell_size = 1\nslit = 3"), HasSubstr("mesh.raster.slit: is an integer; allowed: a table"));
}

TEST(WrongCases, AllProblemsComeAtOnceEachWithItsLine) {
  std::string text = replaced(minimal, "young = \"75 GPa\"", "young = \"75 m\"");
  text = replaced(text, "poisson = 0.2", "poison = 0.2");
  text = replaced(text, "density = 2456", "density = -1");
  const std::string message = message_of(text);
  EXPECT_THAT(message, AllOf(HasSubstr("case.toml:5: material[0].young: is of dimension length"),
                             HasSubstr("case.toml:6: material[0].poison: unknown key; did you mean \"poisson\"?"),
                             HasSubstr("case.toml:7: material[0].density: is out of range"),
                             HasSubstr("case.toml:3: material[0].poisson: is missing")));
}

TEST(WrongCases, AnAbsentFileIsNamed) {
  const CaseFolder folder;
  const std::filesystem::path absent = folder.path() / "nowhere.toml";
  try {
    (void)read_case(absent);
    FAIL() << "an absent file was read";
  } catch (const InputError& e) {
    EXPECT_EQ(e.what(), absent.string() + ": the case file does not exist");
  }
}

TEST(WrongCases, ANestedSectionIsNamedAsItIsWritten) {
  EXPECT_THAT(message_of(minimal + "pressure = 3\n"),
              HasSubstr("stage[0].pressure: is an integer; allowed: one or more tables, [[stage.pressure]]"));
}

TEST(WrongCases, AFolderIsNoCase) {
  const CaseFolder folder;
  EXPECT_THROW((void)read_case(folder.path()), InputError);
}

TEST(WrongCases, WhatIsNoRegularFileOrTooLargeIsRefusedAtOnce) {
  const CaseFolder folder;
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      (void)read_case(file);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::filesystem::path pipe = folder.path() / "pipe.toml", sparse = folder.path() / "sparse.toml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(message(pipe), HasSubstr("the case is not a file"));
  std::ofstream(sparse) << "title = \"\"";
  std::filesystem::resize_file(sparse, 100'000'000'000);
  EXPECT_THAT(message(sparse), HasSubstr("the case is larger (100 GB) than such a file may be"));
  EXPECT_THAT(message("/dev/zero"), HasSubstr("the case is not a file"));
  EXPECT_THAT(message("/proc/self/mem"), HasSubstr("the case cannot be read: Input/output error"));
}

TEST(WrongCases, ADecimalCommaIsNamed) {
  for (const char* number : {"0,2", "0,2 # a comment", "-1,5"}) {
    EXPECT_THAT(message_of(replaced(minimal, "poisson = 0.2", std::string("poisson = ") + number)),
                AllOf(HasSubstr("not TOML: a comma in a number"), HasSubstr("a decimal point")))
        << number;
  }
  EXPECT_THAT(message_of(replaced(minimal, "end = \"1 ms\"", "end = \"0,06 ms\"")),
              AllOf(HasSubstr("end: has a comma in its number"), HasSubstr("a decimal point")));
  EXPECT_THAT(message_of(minimal, {"material[0].poisson=0,2"}),
              AllOf(HasSubstr("poisson: has a comma in its number"), HasSubstr("a decimal point")));
}

TEST(WrongCases, AStiffnessBeyondAllSolidsIsOutOfRange) {
  for (const char* young : {"1e200", "1e21", "0"})
    EXPECT_THAT(message_of(minimal, {std::string("material[0].young=") + young}),
                HasSubstr("material[0].young: is out of range"));
}

TEST(WrongCases, BinaryRubbishIsRefused) {
  EXPECT_THAT(message_of(std::string("\x00\xff\xfe garbage", 11)), HasSubstr("not TOML"));
}

TEST(WrongCases, DeepNestingIsRefused) {
  EXPECT_THAT(message_of("title = " + std::string(100000, '[')), HasSubstr("not TOML"));
}

}  // namespace
}  // namespace breccia::case_::wrong_files_test
