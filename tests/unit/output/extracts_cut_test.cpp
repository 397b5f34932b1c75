#include "output/extracts_cut.hpp"

#include "temporary_folder.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(ExtractsCutBack, LoseWhatWasWrittenFromTheStepOnAndNothingElse) {
  const test::TemporaryFolder folder;
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
  write(history / "history.csv", "step,time\n120,1\n239,2\n240,3\n");
  write(folder / "probes" / "tip.csv", "step,time\n120,1\n120,2\n240,3\n");
  write(folder / "probes" / "torn.csv", "step,time\n120,1\n23");
  write(folder / "script" / "own.csv", "999,1\n");
  cut_extracts_back(folder.path(), 240);
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

TEST(ExtractsCutBack, NeedNotBeThere) {
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(cut_extracts_back(folder / "extracts", 0));
}

}  // namespace
}  // namespace breccia
