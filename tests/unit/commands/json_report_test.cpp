#include "commands/json_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "case/schema.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::json_report_test {
namespace {

using Json = nlohmann::json;

const std::string kCubes = test::raster_case({.title = "cubes",
                                              .group = "cubes",
                                              .cells = {2, 2, 2},
                                              .young = 40e9,
                                              .density = 2400,
                                              .tensile_strength = 5e6,
                                              .energy_mode_1 = 100,
                                              .end = 1e-6}) +
                           R"([output]
frame_interval = "250 ns"
)";

constexpr int kElements = 8 * 24;

Json check_of(const case_::Case& input) {
  const Model model = build_model(input);
  const Subject subject(input, model);
  return Json::parse(check_json(subject, full_report(subject)));
}

TEST(JsonReport, CheckGivesEachAdviceWithRuleLevelAndKey) {
  const Json advice = check_of(case_::read_text(kCubes))["advice"];
  ASSERT_FALSE(advice.empty());
  EXPECT_EQ(advice[0]["rule"], "fragments_without_contact");
  EXPECT_EQ(advice[0]["level"], "wrong");
  EXPECT_EQ(advice[0]["key"], "contact[]");
  EXPECT_EQ(advice[0]["text"].get<std::string>().find("There is no [[contact]]"), 0u);
}

TEST(JsonReport, CheckTellsWhatARunTakes) {
  const case_::Case input = case_::read_text(kCubes);
  const Json json = check_of(input);
  EXPECT_EQ(json["title"], "cubes");
  EXPECT_EQ(json["elements"], kElements);
  EXPECT_EQ(json["groups"]["volumes"][0]["name"], "cubes");
  EXPECT_EQ(json["frames"], 5);
  EXPECT_DOUBLE_EQ(json["step"], 0.8 * json["stable_step"].get<double>());
  EXPECT_EQ(json["steps"].get<double>(), std::ceil(1e-6 / json["step"].get<double>()));
  EXPECT_GT(json["seconds"], 0);
  EXPECT_GE(json["likely_seconds"], json["seconds"]);
  EXPECT_GE(json["most_seconds"], json["likely_seconds"]);
}

TEST(JsonReport, EveryElementHasOneOwnerAmongTheRanks) {
  const case_::Case input = case_::read_text(kCubes);
  const Json json = Json::parse(domains_json(input, build_bare_model(input), 3));
  std::vector<int> counted(3);
  for (const int rank : json["owner"]) ++counted.at(static_cast<std::size_t>(rank));
  for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(json["domains"][d]["elements"], counted[d]);
  EXPECT_EQ(counted[0] + counted[1] + counted[2], kElements);
}

TEST(JsonReport, QualityOfTheMeshCountsEveryElementOnce) {
  const Json json = Json::parse(mesh_json(build_mesh(case_::read_text(kCubes))));
  int sum = 0;
  for (const int n : json["quality"]) sum += n;
  EXPECT_EQ(sum, kElements);
}

TEST(JsonReport, FacesOfASurfaceGroupAreToldByElementAndSide) {
  const Model model = build_bare_model(case_::read_text(kCubes));
  const Json json = Json::parse(mesh_json({model.mesh, model.mesh_report}, &model.topology.surface_groups));
  const auto surfaces = json["groups"]["surfaces"];
  ASSERT_EQ(json["faces"].size(), surfaces.size());
  ASSERT_FALSE(surfaces.empty());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    EXPECT_EQ(json["faces"][s].size(), surfaces[s]["count"]);
    for (const std::int64_t number : json["faces"][s])
      EXPECT_TRUE(
          model.topology.links[static_cast<std::size_t>(number / 4)][static_cast<std::size_t>(number % 4)].free());
  }
}

TEST(JsonReport, EveryKeyOfTheSchemaHasItsRow) {
  const Json json = Json::parse(schema_json());
  ASSERT_EQ(json["keys"].size(), case_::schema().size());
  for (std::size_t i = 0; i < case_::schema().size(); ++i) EXPECT_EQ(json["keys"][i]["path"], case_::schema()[i].path);
}

TEST(JsonReport, ProblemsOfTheCaseArePrintedAndEndWithTwo) {
  testing::internal::CaptureStdout();
  const int code = or_problems([]() -> int {
    throw InputError({"a.toml", 3, "time.step", "is wrong", "more", "less"});
  });
  const Json json = Json::parse(testing::internal::GetCapturedStdout());
  EXPECT_EQ(code, 2);
  EXPECT_EQ(json["problems"][0]["line"], 3);
  EXPECT_EQ(json["problems"][0]["text"], "a.toml:3: time.step: is wrong; allowed: more; given: less");
}

}  // namespace
}  // namespace breccia::json_report_test
