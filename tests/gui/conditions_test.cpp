#include "core/conditions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gui/block_case.hpp"

namespace breccia::gui::conditions_test {
namespace {

const QByteArray kLoads = R"(name = "press"
gravity = [0, 0, "-9.81 m/s2"]
[[stage.constraint]]
group = "block"
fixed = "xy"
[[stage.constraint]]
group = "top"
velocity = { z = { table = [[0, 0], ["3 us", "3 m/s"], ["4 us", "1 m/s"]] } }
[[stage]]
end = "20 us"
[[stage.pressure]]
surface = "side"
value = { sine = { amplitude = "2 MPa", frequency = "50 kHz" } }
[[initial_velocity]]
group = "block"
velocity = [0, "-3 m/s", 0]
)";

TEST(Conditions, AreThoseOfTheCaseStageByStage) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + kLoads)), QString());
  ASSERT_TRUE(document.problems().empty()) << document.problems()[0].text();
  const std::vector<Condition> rows = conditions_of(document);
  QStringList words;
  for (const Condition& row : rows) words << row.stage + "|" + row.type + "|" + row.target + "|" + row.path;
  EXPECT_EQ(words, (QStringList{"|initial velocity|block|initial_velocity[0]", "press|gravity||stage[0]",
                                "press|fixed|block|stage[0].constraint[0]", "press|velocity|top|stage[0].constraint[1]",
                                "2|pressure|side|stage[1].pressure[0]"}))
      << words.join("\n").toStdString();
  EXPECT_EQ(rows[0].value, "0, -3 m/s, 0");
  EXPECT_EQ(rows[2].value, "xy");
  EXPECT_TRUE(rows[2].curves.empty());
}

TEST(Conditions, KnowTractionsForcesAndAbsorbingSurfaces) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  const QByteArray more =
      "absorbing = [\"bottom\"]\n[[stage.traction]]\nsurface = \"side\"\n"
      "value = [{ linear = \"1 GPa/s\" }, 0, \"-2 MPa\"]\n[[stage.force]]\ngroup = \"crest\"\n"
      "value = [0, \"-2 kN\", 0]\n";
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + more)), QString());
  ASSERT_TRUE(document.problems().empty()) << document.problems()[0].text();
  const std::vector<Condition> rows = conditions_of(document);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].type + "|" + rows[0].target + "|" + rows[0].path, "traction|side|stage[0].traction[0]");
  ASSERT_EQ(rows[0].curves.size(), 2U);
  EXPECT_EQ(rows[0].curves[1].name, "traction z");
  EXPECT_EQ(rows[0].largest, (std::array{1e4, 0.0, -2e6}));
  EXPECT_FALSE(rows[0].follows);
  EXPECT_EQ(rows[1].type + "|" + rows[1].target + "|" + rows[1].path, "force|crest|stage[0].force[0]");
  EXPECT_EQ(rows[1].largest, (std::array{0.0, -2000.0, 0.0}));
  EXPECT_EQ(rows[1].unit, "N");
  EXPECT_EQ(rows[2].type + "|" + rows[2].target + "|" + rows[2].path, "absorbing|bottom|stage[0]");
}

TEST(Conditions, OfAnEntryOfSeveralGroupsThereIsOneOfEach) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  const QByteArray more =
      "[[stage.constraint]]\ngroup = [\"block\", \"top\"]\nfixed = \"x\"\n"
      "[[stage.constraint]]\ngroup = \"side\"\nfixed = \"y\"\n";
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + more)), QString());
  ASSERT_TRUE(document.problems().empty()) << document.problems()[0].text();
  QStringList words;
  for (const Condition& row : conditions_of(document)) words << row.target + "|" + row.path + "|" + row.value;
  EXPECT_EQ(words, (QStringList{"block|stage[0].constraint[0]|x", "top|stage[0].constraint[0]|x",
                                "side|stage[0].constraint[1]|y"}));
}

TEST(Conditions, CurvesAreTheFunctionsOverTheirStageWithTheCornersOfTables) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + kLoads)), QString());
  const std::vector<Condition> rows = conditions_of(document);
  ASSERT_EQ(rows.size(), 5U);
  ASSERT_EQ(rows[1].curves.size(), 1U);
  EXPECT_EQ(rows[1].curves[0].name, "gravity z");
  EXPECT_EQ(rows[1].curves[0].y.front(), -9.81);
  const PlotLine& velocity = rows[3].curves.at(0);
  EXPECT_EQ(velocity.x.front(), 0);
  EXPECT_EQ(velocity.x.back(), 1e-5);
  EXPECT_EQ(*std::max_element(velocity.y.begin(), velocity.y.end()), 3) << "the corner is met";
  EXPECT_EQ(velocity.y.back(), 1);
  const PlotLine& pressure = rows[4].curves.at(0);
  EXPECT_EQ(pressure.x.front(), 1e-5);
  EXPECT_EQ(pressure.x.back(), 2e-5);
  EXPECT_EQ(rows[4].unit, "Pa");
  for (std::size_t i = 0; i < pressure.x.size(); ++i)
    EXPECT_NEAR(pressure.y[i], 2e6 * std::sin(2 * M_PI * 5e4 * pressure.x[i]), 1e-3);
}

TEST(Conditions, TellTheirLargestValueByAxisAndWhichAxesTheyHold) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + kLoads)), QString());
  const std::vector<Condition> rows = conditions_of(document);
  ASSERT_EQ(rows.size(), 5U);
  using Vector = std::array<double, 3>;
  EXPECT_EQ(rows[0].number, -1);
  EXPECT_EQ(rows[0].largest, (Vector{0, -3, 0}));
  EXPECT_EQ(rows[1].largest, (Vector{0, 0, -9.81}));
  EXPECT_EQ(rows[2].axes, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(rows[2].largest, Vector{});
  EXPECT_EQ(rows[3].axes, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(rows[3].largest, (Vector{0, 0, 3})) << "the corner of its table";
  EXPECT_EQ(rows[4].number, 1);
  EXPECT_NEAR(std::abs(rows[4].largest[0]), 2e6, 1e3);
}

/// A strain rate or a spin alone left the cell of the table empty.
TEST(Conditions, TellEveryPartOfAnInitialVelocity) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + R"([[initial_velocity]]
group = "block"
strain_rate = ["3 1/s", 0, "-1 1/s"]
[[initial_velocity]]
group = "block"
velocity = [0, "-3 m/s", 0]
angular = [0, 0, "90 deg/s"]
)")),
            QString());
  const std::vector<Condition> rows = conditions_of(document);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].value, "strain rate 3 1/s, 0, -1 1/s");
  EXPECT_EQ(rows[1].value, "0, -3 m/s, 0; spin 0, 0, 90 deg/s");
}

TEST(Conditions, OfACaseThatIsRefusedAreNone) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(test::written_case(scratch, test::block_case(2, "10 us") + "nonsense = 1\n")), QString());
  EXPECT_TRUE(conditions_of(document).empty());
}

}  // namespace
}  // namespace breccia::gui::conditions_test
