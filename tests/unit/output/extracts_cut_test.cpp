#include "output/insitu/extracts_cut.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "temporary_folder.hpp"

namespace breccia::extracts_cut_test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(ExtractsCutBack, LoseWhatWasWrittenFromTheStepOnAndNothingElse) {
  const test::TemporaryFolder folder, place;
  const fs::path fractures = folder / "fractures", pictures = folder / "stress", history = folder / "history";
  const std::string head = "<VTKFile>\n", foot = "</VTKFile>\n",
                    first = "<DataSet timestep=\"1\" file=\"fractures_000000120.pvtp\"/>\n",
                    second = "<DataSet timestep=\"2\" file=\"fractures_000000240.pvtp\"/>\n";
  write(fractures / "fractures.pvd", head + first + second + foot);
  for (const char* name : {"fractures_000000120", "fractures_000000240"}) {
    write(fractures / (std::string(name) + ".pvtp"), "x");
    write(fractures / name / "0000.vtp", "x");
  }
  write(pictures / "stress_000000239.png", "x");
  write(pictures / "stress_000000241.png", "x");
  write(pictures / "stress_000000999_left.png", "x");
  write(pictures / "notes_of_2026.txt", "x");
  write(history / "history.csv", "step,time\n120,1\n239,2\n240,3\n1e+05,4\n");
  write(folder / "probes" / "tip.csv", "step,time\n120,1\n120,2\n240,3\n");
  write(folder / "probes" / "torn.csv", "step,time\n120,1\n23");
  write(folder / "script" / "own.csv", "999,1\n");
  write(folder / "keep" / "count_000000300.txt", "no step at which pipelines wrote");
  write(folder / "keep" / "letter_2026112812.txt", "a date");
  write(place.path() / "extracts.csv", "step,time [s]\n120,1\n239,2\n240,3\n241,4\n999,5\n1200,6");
  cut_extracts_back(folder.path(), place / "extracts.csv", 240);
  EXPECT_EQ(test::content_of(place / "extracts.csv"), "step,time [s]\n120,1\n239,2\n");
  EXPECT_TRUE(fs::exists(folder / "keep" / "count_000000300.txt"));
  EXPECT_TRUE(fs::exists(folder / "keep" / "letter_2026112812.txt"));
  EXPECT_EQ(test::content_of(fractures / "fractures.pvd"), head + first + foot);
  EXPECT_TRUE(fs::exists(fractures / "fractures_000000120.pvtp"));
  EXPECT_TRUE(fs::exists(fractures / "fractures_000000120" / "0000.vtp"));
  EXPECT_FALSE(fs::exists(fractures / "fractures_000000240.pvtp"));
  EXPECT_FALSE(fs::exists(fractures / "fractures_000000240"));
  EXPECT_TRUE(fs::exists(pictures / "stress_000000239.png"));
  EXPECT_FALSE(fs::exists(pictures / "stress_000000241.png"));
  EXPECT_FALSE(fs::exists(pictures / "stress_000000999_left.png"));
  EXPECT_TRUE(fs::exists(pictures / "notes_of_2026.txt"));
  EXPECT_EQ(test::content_of(history / "history.csv"), "step,time\n120,1\n239,2\n");
  EXPECT_EQ(test::content_of(folder / "probes" / "tip.csv"), "step,time\n120,1\n120,2\n");
  EXPECT_EQ(test::content_of(folder / "probes" / "torn.csv"), "step,time\n120,1\n") << "a line that was cut off";
  EXPECT_EQ(test::content_of(folder / "script" / "own.csv"), "999,1\n");
}

TEST(ExtractsOfAnEarlierRun, AreRemovedWithTheLogsOfScriptsAndNothingElseIs) {
  const test::TemporaryFolder folder;
  const fs::path script = folder / "extracts" / "script", pictures = folder / "extracts" / "stress";
  for (const char* name : {"script.log", "script_rank_12.log", "own.log", "my_script.log"}) write(script / name, "x");
  write(pictures / "script.log", "x");
  write(pictures / "stress_000000240.png", "x");
  write(folder / "extracts.csv", "step,time [s]\n240,3\n");
  remove_extracts(folder / "extracts", folder / "extracts.csv");
  EXPECT_FALSE(fs::exists(script / "script.log"));
  EXPECT_FALSE(fs::exists(script / "script_rank_12.log"));
  EXPECT_TRUE(fs::exists(script / "own.log"));
  EXPECT_TRUE(fs::exists(script / "my_script.log"));
  EXPECT_FALSE(fs::exists(pictures)) << "empty now";
}

TEST(ExtractsCutBack, NeedNotBeThere) {
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(cut_extracts_back(folder / "extracts", folder / "extracts.csv", 0));
}

TEST(ExtractsCutBack, RemoveNothingBehindALink) {
  const test::TemporaryFolder folder, elsewhere;
  const std::string index = "step,time [s]\n240,3\n";
  write(elsewhere / "stress_000000240.png", "x");
  write(elsewhere / "list.pvd", "<DataSet timestep=\"2\" file=\"fractures_000000240.pvtp\"/>\n");
  write(folder / "extracts.csv", index);
  fs::create_directories(folder / "extracts");
  fs::create_directory_symlink(elsewhere.path(), folder / "extracts" / "pictures");
  fs::create_symlink(elsewhere / "list.pvd", folder / "extracts" / "list.pvd");
  cut_extracts_back(folder / "extracts", folder / "extracts.csv", 240);
  EXPECT_TRUE(fs::exists(elsewhere / "stress_000000240.png"));
  EXPECT_THAT(test::content_of(elsewhere / "list.pvd"), testing::HasSubstr("000000240"));

  write(folder / "extracts.csv", index);
  fs::remove_all(folder / "extracts");
  fs::create_directory_symlink(elsewhere.path(), folder / "extracts");
  EXPECT_THROW(cut_extracts_back(folder / "extracts", folder / "extracts.csv", 240), OutputError);
  EXPECT_TRUE(fs::exists(elsewhere / "stress_000000240.png"));
}

}  // namespace
}  // namespace breccia::extracts_cut_test
