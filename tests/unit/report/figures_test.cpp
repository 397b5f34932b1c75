#include "report/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "unit/output/temporary_folder.hpp"

namespace breccia::report::figures_test {
namespace {

using testing::ElementsAre;

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(Figures, AreThoseOfTheirFile) {
  const test::TemporaryFolder folder;
  write(folder / "a.png", "foobar");
  write(folder / "figures.json", R"({"paraview": "5.11.0", "frames": 3, "time": 0.5, "problems": ["stress: none", 7],
    "pictures": [{"file": "a.png", "title": "T", "text": "W", "time": 0.25}, {"file": "../a.png"},
      {"file": "lost.png"}],
    "fragments": {"count": 2, "d50": 0.1, "swebrec_left_out": "too few",
      "largest": [{"mass": 3, "velocity": [1, 2, 2]}],
      "sieve": {"size": [1, null]}}})");
  const Figures figures = read_figures(folder.path());
  EXPECT_EQ(figures.paraview, "5.11.0");
  EXPECT_EQ(figures.fact("fragments", "d50"), 0.1);
  EXPECT_TRUE(std::isnan(figures.fact("fragments", "none")));
  EXPECT_TRUE(std::isnan(figures.fact("none", "d50")));
  EXPECT_EQ(figures.text("fragments", "swebrec_left_out"), "too few");
  EXPECT_EQ(figures.text("fragments", "d50"), "");
  EXPECT_THAT(figures.problems, ElementsAre("stress: none"));
  EXPECT_THAT(figures.tables.at("fragments.largest").at(0).at("velocity"), ElementsAre(1, 2, 2));
  const std::vector<double>& size = figures.curves.at("fragments.sieve").at("size");
  ASSERT_EQ(size.size(), 2U);
  EXPECT_TRUE(std::isnan(size[1]));
  ASSERT_EQ(figures.pictures.size(), 1U) << "others are not in the folder";
  EXPECT_EQ(figures.pictures[0].png, "Zm9vYmFy");
}

TEST(Figures, OfAFileThatIsNotWholeAreNone) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_figures(folder.path()).paraview, "");
  for (const char* text : {"", "{\"paraview\": \"5", "[1]", "{\"pictures\": 3, \"paraview\": 5, \"frames\": \"x\"}"}) {
    write(folder / "figures.json", text);
    EXPECT_EQ(read_figures(folder.path()).paraview, "") << text;
  }
}

}  // namespace
}  // namespace breccia::report::figures_test
