#include "report/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::report::record_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

const char* kHistory = "step,time [s],\"a, \"\"b\"\" [J]\"\n0,0,1.5\n10,1e-6,0.10000000000000001\n";

TEST(RunRecords, HoldTheNumbersOfTheHistory) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  const RunRecord run = read_run(folder.path());
  EXPECT_THAT(run.history.names, ElementsAre("step", "time [s]", "a, \"b\" [J]"));
  EXPECT_THAT(run.history.column("a, \"b\" [J]"), ElementsAre(1.5, 0.1));
  EXPECT_EQ(run.history.last("time [s]"), 1e-6);
  EXPECT_TRUE(std::isnan(run.history.last("none")));
  EXPECT_THAT(run.history.column("none"), IsEmpty());
}

TEST(RunRecords, NameBodiesAndTheGaugesThatGoByTheirNumbers) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  const RunRecord before = read_run(folder.path());
  EXPECT_EQ(before.body_name(1), "body 1");
  EXPECT_EQ(before.body_name(-1), "");
  EXPECT_EQ(before.body_name(std::nan("")), "");
  EXPECT_EQ(before.gauge_label("body 1"), "body 1");
  write(folder / "bodies.csv", "body,name\n0,plate\n1,blocks (body 1)\n2,\"a, b\"\n3,body 0\n");
  const RunRecord run = read_run(folder.path());
  EXPECT_EQ(run.body_name(0), "plate");
  EXPECT_EQ(run.body_name(2), "a, b");
  EXPECT_EQ(run.body_name(7), "body 7");
  EXPECT_EQ(run.gauge_label("plate"), "plate");
  EXPECT_EQ(run.gauge_label("body 1"), "blocks (body 1)");
  EXPECT_EQ(run.gauge_label("body 2"), "a, b (body 2)");
  EXPECT_EQ(run.gauge_label("body 0"), "body 0") << "a group is called so";
  EXPECT_EQ(run.gauge_label("body 9"), "body 9");
}

TEST(RunRecords, LeaveOutAListOfBodiesThatIsNoneAndSaySo) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  write(folder / "bodies.csv", "body,name\n0,plate\n2,ball\n");
  const RunRecord run = read_run(folder.path());
  EXPECT_THAT(run.bodies, IsEmpty());
  EXPECT_THAT(run.flaws, Contains(HasSubstr("bodies.csv")));
}

TEST(RunRecords, LeaveOutLinesThatAreCutOffAndSaySo) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", std::string(kHistory) + "20,2e-6,0.0\n30,3e-");
  write(folder / "status.jsonl",
        "{\"state\":\"running\",\"time\":1e-6,\"wall_s\":2,\"imbalance\":1.5}\n{\"state\":\"compl");
  write(folder / "provenance.json", "{\"version\": \"1");
  const RunRecord run = read_run(folder.path());
  EXPECT_EQ(run.history.rows(), 3U);
  EXPECT_THAT(run.flaws, Contains(HasSubstr("history.csv: lines that are not whole are left out: 1")));
  EXPECT_THAT(run.flaws, Contains(HasSubstr("status.jsonl: lines that are not whole are left out: 1")));
  EXPECT_THAT(run.flaws, Contains(HasSubstr("provenance.json is not whole")));
  ASSERT_EQ(run.status.size(), 1U);
  EXPECT_EQ(run.status[0].imbalance, 1.5);
}

TEST(RunRecords, OfARunWithoutAProcessAreInterrupted) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  write(folder / "status.jsonl", "{\"state\":\"running\"}\n");
  EXPECT_EQ(read_run(folder.path()).state, "interrupted");
  write(folder / "status.jsonl",
        "{\"state\":\"running\"}\n{\"event\":\"checkpoint\",\"accepted\":false,\"text\":\"disk full\"}\n"
        "{\"state\":\"complete\"}\n");
  const RunRecord ended = read_run(folder.path());
  EXPECT_EQ(ended.state, "complete");
  ASSERT_EQ(ended.events.size(), 1U);
  EXPECT_FALSE(ended.events[0].accepted);
  EXPECT_THAT(ended.flaws, Contains("summary.json is missing."));
}

TEST(RunRecords, HoldNumbersWordsAndPhasesOfTheSummary) {
  const test::TemporaryFolder folder;
  write(folder / "provenance.json", R"({"version": "1.2", "command_line": ["breccia", "run", "a b.toml"], "ranks": 2,
    "inputs": [{"file": "case.toml", "sha256": "00ff"}]})");
  write(folder / "summary.json", R"({"title": "T", "steps": 7, "phases": {"sweep": 2.5, "joints": 1}, "x": null})");
  const RunRecord run = read_run(folder.path());
  EXPECT_EQ(run.title, "T");
  EXPECT_EQ(run.number("steps"), 7);
  EXPECT_TRUE(std::isnan(run.number("x")));
  EXPECT_THAT(run.phases,
              ElementsAre(std::pair<std::string, double>("sweep", 2.5), std::pair<std::string, double>("joints", 1.0)));
  EXPECT_THAT(run.provenance.command_line, ElementsAre("breccia", "run", "a b.toml"));
  EXPECT_EQ(run.provenance.ranks, 2);
  ASSERT_EQ(run.provenance.inputs.size(), 1U);
  EXPECT_EQ(run.provenance.inputs[0].sha256, "00ff");
}

const std::string kCase = R"([mesh]
file = "moved_away.geo"
[[material]]
group = "*"
young = 1e9
poisson = 0.2
density = 2000
joints = "none"
[[stage]]
end = 1
gravity = [0, -9.81, 0]
)";

TEST(RunRecords, OfACaseWhoseGeometryHasMovedAreWhole) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  write(folder / "case.toml", "title = \"T\"\n" + kCase);
  const RunRecord run = read_run(folder.path());
  EXPECT_EQ(run.title, "T");
  EXPECT_EQ(run.up, 'y');
  EXPECT_THAT(run.flaws, Not(Contains(HasSubstr("case.toml"))));
}

TEST(RunRecords, OfACaseThatCannotBeReadSayWhy) {
  const test::TemporaryFolder folder;
  write(folder / "history.csv", kHistory);
  write(folder / "case.toml", kCase + "[insitu]\nrun = [\"gone.py\"]\n");
  EXPECT_THAT(read_run(folder.path()).flaws,
              Contains(AllOf(HasSubstr("case.toml is shown as it is: insitu.run: the script does not exist"),
                             HasSubstr("gone.py"))));
}

TEST(RunRecords, OfOtherFoldersAreRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)read_run(folder.path()), OutputError);
  EXPECT_THROW((void)read_run(folder / "nowhere"), OutputError);
  write(folder / "file", "");
  EXPECT_THROW((void)read_run(folder / "file"), OutputError);
}

}  // namespace
}  // namespace breccia::report::record_test
