#include "core/study.hpp"

#include <gtest/gtest.h>

#include <QDir>

#include "gui/block_case.hpp"

namespace breccia::gui::study_test {
namespace {

using test::turning_case, test::wait_until, test::written_case;

const Launch kLaunch{BRECCIA_PROGRAM, BRECCIA_MPIEXEC};

struct StudyBench {
  QTemporaryDir scratch;
  Document document{scratch.filePath("state")};
  Study study{scratch.filePath("runs/one-study"), {}, 1, {}, {}};
  QStringList problems;

  StudyBench() { EXPECT_EQ(document.open(written_case(scratch, turning_case("50 us"))), QString()); }
  std::vector<RunWish> plan(const std::vector<StudyParameter>& parameters) {
    study.parameters = parameters;
    return plan_study(document, study, &problems);
  }
};

TEST(Study, HasARunForEveryCombinationOfTheValues) {
  StudyBench bench;
  const auto wishes = bench.plan({{"material[0].young", study_values("30 GPa; 40 GPa ;")}, {"ranks", {"1", "2"}}});
  ASSERT_EQ(wishes.size(), 4U) << bench.problems.join(" ").toStdString();
  EXPECT_EQ(wishes[2].words, "young = 40 GPa, ranks = 1");
  EXPECT_EQ(wishes[2].overrides, QStringList("material[0].young=\"40 GPa\""));
  EXPECT_EQ(wishes[3].ranks, 2);
  EXPECT_EQ(bench.study.runs[3].values, (QStringList{"40 GPa", "2"}));
  EXPECT_NE(wishes[0].folder, wishes[1].folder);
}

TEST(Study, WhatTheSolverRefusesIsToldInItsWordsAndNothingIsPlanned) {
  StudyBench bench;
  EXPECT_TRUE(bench.plan({{"material[0].young", {"-1 GPa", "40 GPa"}}}).empty());
  ASSERT_EQ(bench.problems.size(), 1);
  EXPECT_TRUE(bench.problems[0].contains("young") && bench.problems[0].contains("> 0"))
      << bench.problems[0].toStdString();
  EXPECT_TRUE(bench.plan({{"material[0].yuong", {"1"}}}).empty());
  EXPECT_TRUE(bench.problems.join("").contains("did you mean")) << bench.problems.join("").toStdString();
  EXPECT_TRUE(bench.plan({{"ranks", {"0", "two"}}}).empty());
  EXPECT_EQ(bench.problems.size(), 2);
  EXPECT_TRUE(bench.plan({{"ranks", {"1"}}, {"ranks", {"2"}}}).empty());
  EXPECT_TRUE(bench.plan({{"ranks", {}}}).empty());
  EXPECT_TRUE(bench.plan({}).empty());
}

TEST(Study, KeysOfTheCaseNumbersOfTheGeometryAndChoicesAreOffered) {
  StudyBench bench;
  ASSERT_EQ(bench.document.open(QString(BRECCIA_MESHES) + "/glass_impact/case.toml"), QString());
  const QStringList keys = study_keys(bench.document);
  for (const char* key :
       {"ranks", "material[0].young", "mesh.parameters.h", "joint[0].tensile_strength", "detection.algorithm"})
    EXPECT_TRUE(keys.contains(key)) << key;
  const auto wishes =
      bench.plan({{"mesh.parameters.h", {"2 mm", "3 mm"}}, {"detection.algorithm", {"ms", "sorted_grid"}}});
  EXPECT_EQ(wishes.size(), 4U) << bench.problems.join(" ").toStdString();
}

TEST(Study, ItsResultsAreOnePlotAndOneTable) {
  StudyBench bench;
  const RunQueue queue(bench.scratch.filePath("state"));
  const RunRegistry registry(bench.scratch.filePath("state/runs.json"));
  const auto wishes =
      bench.plan({{"material[0].density", {"1 g/cm3", "4 g/cm3"}}, {"detection.algorithm", {"ms", "sorted_grid"}}});
  ASSERT_EQ(wishes.size(), 4U) << bench.problems.join(" ").toStdString();
  EXPECT_EQ(save_study(bench.study), QString());
  EXPECT_EQ(queue.add(kLaunch, wishes), QString());
  EXPECT_EQ(study_results(bench.study, queue.load())[3].state, "waiting");
  ASSERT_TRUE(wait_until([&] { return !queue.advance(registry); }, 240000));

  EXPECT_EQ(find_studies(bench.scratch.filePath("runs"), bench.document.file()), QStringList(bench.study.folder));
  EXPECT_TRUE(find_studies(bench.scratch.filePath("runs"), "/other.toml").isEmpty());
  const std::optional<Study> again = load_study(bench.study.folder);
  ASSERT_TRUE(again);
  const std::vector<StudyResult> results = study_results(*again, queue.load());
  for (const StudyResult& result : results) EXPECT_EQ(result.state, "complete");
  const StudyPlot plot = study_plot(*again, results, "kinetic [J]");
  ASSERT_EQ(plot.lines.size(), 2U);
  EXPECT_EQ(plot.lines[1].name, "algorithm = sorted_grid");
  EXPECT_EQ(plot.x_title, "material[0].density [kg/m3]");
  EXPECT_EQ(plot.lines[0].x, (std::vector<double>{1000, 4000}));
  EXPECT_LT(plot.lines[0].y[0], plot.lines[0].y[1]) << "what is heavier has more of it";
  EXPECT_EQ(plot.lines[0].y, plot.lines[1].y) << "the search changes no result";

  const QList<QByteArray> lines = study_csv(*again, results).trimmed().split('\n');
  ASSERT_EQ(lines.size(), 5);
  EXPECT_TRUE(
      lines[0].startsWith("material[0].density,material[0].density (SI),detection.algorithm,"
                          "detection.algorithm (SI),state,wall time [s],steps,"))
      << lines[0].toStdString();
  EXPECT_TRUE(lines[2].startsWith("1 g/cm3,1000,sorted_grid,,complete,")) << lines[2].toStdString();
  EXPECT_EQ(lines[0].count(','), lines[4].count(','));
}

TEST(Study, WordsStandOnTheAxisInTheOrderInWhichTheyWereTyped) {
  Study study{"/nowhere", {}, 1, {{"detection.algorithm", {"ms", "brute_force"}}}, {}};
  study.runs = {{"/nowhere/1", {"ms"}}, {"/nowhere/2", {"brute_force"}}};
  StudyResult first, second;
  first.columns = second.columns = QStringList("steps");
  first.values = {7};
  second.values = {8};
  const StudyPlot plot = study_plot(study, {first, second}, "steps");
  EXPECT_EQ(plot.x_words, (QStringList{"ms", "brute_force"}));
  ASSERT_EQ(plot.lines.size(), 1U);
  EXPECT_EQ(plot.lines[0].x, (std::vector<double>{0, 1}));
  EXPECT_EQ(plot.lines[0].y, (std::vector<double>{7, 8}));
  EXPECT_TRUE(study_plot(study, {first, second}, "no such").lines[0].x.empty());
}

}  // namespace
}  // namespace breccia::gui::study_test
