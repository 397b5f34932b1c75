#include "commands/insitu_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/reader.hpp"
#include "model/model.hpp"
#include "support/raster_case.hpp"

namespace breccia::insitu_report_test {
namespace {

using testing::HasSubstr;

/// Eight cubes of 1 m, from the origin; 4 ms in steps that are short.
std::string report_of(const std::string& pipelines, double steps = 1e6) {
  const case_::Case input =
      case_::read_text(test::raster_case({.cells = {2, 2, 2}, .cell_size = 1, .end = 4e-3}) + pipelines);
  return insitu_report(input, build_model(input).mesh, 0, steps);
}

std::string pipeline(const std::string& name, const std::string& keys) {
  return "[[insitu.pipeline]]\nname = \"" + name + "\"\n" + keys + "\n";
}

TEST(InSituReport, IsEmptyWithoutPipelines) { EXPECT_EQ(report_of(""), ""); }

TEST(InSituReport, CountsTheInstantsOfTimesAndStepsWithTheFirstAndTheLastState) {
  const auto strict = [](const std::string& keys, double steps = 1e6) {
    return report_of(pipeline("surface", keys + "\nstrict = true"), steps);
  };
  EXPECT_EQ(strict("every_time = \"0.6 ms\""), "in situ\n  surface: every 600 us: 8 instants\n");
  EXPECT_EQ(strict("every_time = \"0.5 ms\""), "in situ\n  surface: every 500 us: 9 instants\n");
  EXPECT_EQ(strict("every_time = \"0.5 ms\"", 4), "in situ\n  surface: every 500 us: 5 instants\n") << "each step";
  EXPECT_EQ(strict("every_steps = 100", 824), "in situ\n  surface: every 100 steps: about 10 instants\n");
  EXPECT_EQ(strict(""), "in situ\n  surface: evenly over the run: 51 instants\n");
  EXPECT_EQ(strict("every_broken = 20\nfirst_break = true"),
            "in situ\n  surface: for every 20 broken joints, at the first break\n");
  EXPECT_THAT(report_of(pipeline("surface", "every_time = \"1 ms\"")),
              HasSubstr("5 instants, or fewer within 2 % of the wall time\n"));
}

TEST(InSituReport, NamesTheModelWhereARegionHoldsNoElement) {
  const auto region = [](const std::string& corners) { return report_of(pipeline("volume", "region = " + corners)); };
  EXPECT_THAT(region("{ lower = [0, 0, 0], upper = [1, 2, 2] }"), HasSubstr("holds 96 of 192 elements"));
  EXPECT_THAT(region("{ lower = [3, 0, 0], upper = [4, 2, 2] }"),
              HasSubstr("holds 0 of 192 elements before the first step; the model is from (0, 0, 0) to (2, 2, 2) m\n"));
}

TEST(InSituReport, CountsThePointsOfProbesInElements) {
  const std::string report =
      report_of(pipeline("probes", "") +
                "[[insitu.pipeline.probe]]\nname = \"corner\"\nat = [0, 0, 0]\n"
                "[[insitu.pipeline.probe]]\nname = \"out\"\nat = [2.001, 1, 1]\n"
                "[[insitu.pipeline.probe]]\nname = \"plane\"\nat = [1, -1, -1]\nalong = [0, 4, 0]\npoints = 5\n"
                "across = [0, 0, 4]\nrows = 5\n");
  EXPECT_THAT(report, HasSubstr("probe corner: 1 of 1 points in elements before the first step\n"));
  EXPECT_THAT(report, HasSubstr("probe out: 0 of 1 points in elements before the first step; the model is from"));
  EXPECT_THAT(report, HasSubstr("probe plane: 9 of 25 points")) << "of 0, 1, 2 each";
}

}  // namespace
}  // namespace breccia::insitu_report_test
