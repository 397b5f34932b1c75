#include "output/folder/history_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "unit/output/temporary_folder.hpp"

namespace breccia::history_test {
namespace {

using test::lines_of;
using test::TemporaryFolder;
using testing::Contains;
using testing::SizeIs;

RunStart with_gauges(std::vector<std::string> gauges) {
  RunStart run;
  run.gauges = std::move(gauges);
  return run;
}

/// Fields of a line of RFC 4180.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && in_quotes && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      in_quotes = !in_quotes;
    } else if (line[i] == ',' && !in_quotes) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

HistoryRow example_row() {
  HistoryRow row;
  row.step = 9007199254740993;  // 2^53 + 1: lost if it went through a double
  row.time = 1.0 / 3;
  row.time_step = 1e-8 / 7;
  row.energy.kinetic = 0.1;
  row.energy.residual = -2.0 / 3;
  row.energy.residual_relative = 1e-300 / 7;
  row.damaged_joints = 8;
  row.broken_joints = 5;
  row.broken_mode_1 = 2;
  row.broken_mode_2 = 3;
  row.couples = 11;
  row.momentum = {1, 2, 3};
  row.angular_momentum = {4, 5, 6};
  row.max_speed = 13;
  row.stress_yy_sum = 17;
  row.gauges.resize(2);
  row.gauges[1].reaction = {0, -1.0 / 7, 0};
  row.gauges[1].velocity = {0, 0, 9};
  return row;
}

class HistoryTest : public testing::Test {
 protected:
  /// History of two gauges and one row, as name -> text.
  std::string field(const std::string& name) {
    HistorySink sink(folder_ / "history.csv");
    sink.start(with_gauges({"supports", "plate"}));
    sink.history(example_row());
    const auto lines = lines_of(folder_ / "history.csv");  // the sink still lives: nothing is held back
    const auto names = fields_of(lines.at(0)), values = fields_of(lines.at(1));
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? "no such column" : values.at(static_cast<std::size_t>(found - names.begin()));
  }
  double number(const std::string& name) { return std::strtod(field(name).c_str(), nullptr); }

  TemporaryFolder folder_;
};

TEST_F(HistoryTest, NumbersStandUnderTheirNamesAndReadBackAsTheSameDoubles) {
  EXPECT_EQ(field("step"), "9007199254740993");
  EXPECT_EQ(number("time [s]"), 1.0 / 3);
  EXPECT_EQ(number("time step [s]"), 1e-8 / 7);
  EXPECT_EQ(number("kinetic [J]"), 0.1);
  EXPECT_EQ(number("residual [J]"), -2.0 / 3);
  EXPECT_EQ(number("relative residual"), 1e-300 / 7);
  EXPECT_EQ(field("damaged joints"), "8");
  EXPECT_EQ(field("broken joints"), "5");
  EXPECT_EQ(field("broken in mode I"), "2");
  EXPECT_EQ(field("broken in mode II"), "3");
  EXPECT_EQ(field("couples"), "11");
  EXPECT_EQ(number("momentum y [kg m/s]"), 2);
  EXPECT_EQ(number("angular momentum z [kg m2/s]"), 6);
  EXPECT_EQ(number("max speed [m/s]"), 13);
  EXPECT_EQ(number("sum of |stress yy| [Pa]"), 17);
  EXPECT_EQ(number("plate reaction y [N]"), -1.0 / 7);
  EXPECT_EQ(number("supports reaction y [N]"), 0);
  EXPECT_EQ(number("plate velocity z [m/s]"), 9);
}

TEST_F(HistoryTest, EveryTermOfTheBudgetStandsUnderItsName) {
  HistoryRow row;
  EnergyBudget& e = row.energy;
  e.kinetic = 1, e.elastic = 2, e.joint_elastic = 3, e.contact_stored = 4, e.joint_mode_1 = 5, e.joint_mode_2 = 6;
  e.joint_friction = 7, e.contact_dissipated = 8, e.contact_friction = 9, e.viscous = 10, e.damping = 11;
  e.external_work = 12, e.step_change = 13, e.residual = 14;
  const std::vector<std::string> columns = history_columns({});
  const std::vector<double> values = history_values(row);
  ASSERT_EQ(values.size(), columns.size());
  std::vector<std::string> terms;
  for (double number = 1; number <= 14; ++number) {
    const auto found = std::find(values.begin(), values.end(), number);
    ASSERT_NE(found, values.end()) << number;
    terms.push_back(columns[static_cast<std::size_t>(found - values.begin())]);
  }
  EXPECT_THAT(terms, testing::ElementsAre("kinetic [J]", "elastic [J]", "joint elastic [J]", "contact stored [J]",
                                          "joint mode 1 [J]", "joint mode 2 [J]", "joint friction [J]",
                                          "contact dissipated [J]", "contact friction [J]", "viscous [J]",
                                          "damping [J]", "external work [J]", "step change [J]", "residual [J]"));
}

TEST_F(HistoryTest, EveryLineHasOneFieldForEachColumn) {
  HistorySink sink(folder_ / "history.csv");
  sink.start(with_gauges({"supports", "a,\"b\""}));
  sink.history(example_row());
  sink.history(example_row());
  const auto lines = lines_of(folder_ / "history.csv");
  ASSERT_THAT(lines, SizeIs(3));
  for (const std::string& line : lines) EXPECT_THAT(fields_of(line), SizeIs(history_columns({"x", "y"}).size()));
  EXPECT_THAT(fields_of(lines[0]), Contains("a,\"b\" reaction x [N]"));
}

TEST_F(HistoryTest, ColumnNamesAreAllDifferent) {
  auto columns = history_columns({"a", "b"});
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(std::adjacent_find(columns.begin(), columns.end()), columns.end());
}

TEST_F(HistoryTest, RefusesARowWithAnotherNumberOfGauges) {
  HistorySink sink(folder_ / "history.csv");
  sink.start(with_gauges({"plate"}));
  EXPECT_THROW(sink.history(example_row()), InternalError);
}

TEST_F(HistoryTest, AnUnwritablePlaceIsAnOutputError) {
  HistorySink missing(folder_ / "missing/history.csv");
  EXPECT_THROW(missing.start({}), OutputError);
  HistorySink full("/dev/full");
  EXPECT_THROW(full.start({}), OutputError);
}

}  // namespace
}  // namespace breccia::history_test
