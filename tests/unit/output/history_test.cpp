#include "output/history_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <set>

#include "unit/output/temporary_folder.hpp"

namespace breccia {
namespace {

/// Fields of one line as RFC 4180 reads them.
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

GaugeReading gauge_counting_from(double base) {
  GaugeReading gauge;
  gauge.reaction = Vec3(base, base + 1, base + 2);
  gauge.contact_force = Vec3(base + 3, base + 4, base + 5);
  gauge.displacement = Vec3(base + 6, base + 7, base + 8);
  gauge.max_displacement = Vec3(base + 9, base + 10, base + 11);
  gauge.velocity = Vec3(base + 12, base + 13, base + 14);
  return gauge;
}

/// Numbers that have no short decimal form, all different.
HistoryRow some_row() {
  HistoryRow row;
  row.step = 9007199254740993;  // 2^53 + 1: lost if it went through a double
  row.time = 1.0 / 3;
  row.time_step = 0.1;
  double EnergyBudget::*const terms[] = {&EnergyBudget::elastic,        &EnergyBudget::joint_elastic,
                                         &EnergyBudget::contact_stored, &EnergyBudget::joint_mode_1,
                                         &EnergyBudget::joint_mode_2,   &EnergyBudget::joint_friction,
                                         &EnergyBudget::contact_dissipated, &EnergyBudget::contact_friction,
                                         &EnergyBudget::viscous,        &EnergyBudget::damping};
  double numerator = 1;
  for (const auto term : terms) row.energy.*term = ++numerator / 37;
  row.energy.kinetic = 1e-300 / 7;
  row.energy.external_work = -1e300 / 7;
  row.energy.residual = -1.0 / 37;
  row.energy.residual_relative = std::numeric_limits<double>::quiet_NaN();
  row.damaged_joints = 21;
  row.broken_joints = 22;
  row.broken_mode_1 = 23;
  row.broken_mode_2 = 24;
  row.fragments = 25;
  row.couples = 26;
  row.contacts = 27;
  row.momentum = {31, 32, 33};
  row.angular_momentum = {34, 35, 36};
  row.max_speed = 37;
  row.stress_yy_sum = 38;
  row.gauges = {gauge_counting_from(40), gauge_counting_from(60)};
  return row;
}

class HistoryFile : public testing::Test {
 protected:
  void SetUp() override {
    HistorySink sink(folder_ / "history.csv");
    RunStart start;
    start.gauges = {"plate", "odd, \"name\""};
    sink.start(start);
    sink.history(row_);
    const std::vector<std::string> lines = test::lines_of(folder_ / "history.csv");  // the sink still lives: it holds nothing back
    ASSERT_EQ(lines.size(), 2u);
    header_ = fields_of(lines[0]);
    values_ = fields_of(lines[1]);
    ASSERT_EQ(header_.size(), values_.size());
  }
  [[nodiscard]] std::string text(const std::string& column) const {
    const auto found = std::find(header_.begin(), header_.end(), column);
    if (found == header_.end()) return "no column " + column;
    return values_[static_cast<std::size_t>(found - header_.begin())];
  }
  [[nodiscard]] double number(const std::string& column) const {
    const std::string field = text(column);
    char* end = nullptr;
    const double value = std::strtod(field.c_str(), &end);
    EXPECT_TRUE(end != field.c_str() && *end == '\0') << field;
    return value;
  }

  const HistoryRow row_ = some_row();
  test::TemporaryFolder folder_;
  std::vector<std::string> header_, values_;
};

TEST_F(HistoryFile, HasNoNameTwice) {
  EXPECT_EQ(header_.size(), std::set<std::string>(header_.begin(), header_.end()).size());
}

TEST_F(HistoryFile, ReturnsTheSameBitsOfEveryNumber) {
  const EnergyBudget& energy = row_.energy;
  EXPECT_EQ(text("step"), "9007199254740993");
  EXPECT_EQ(number("time [s]"), row_.time);
  EXPECT_EQ(number("time step [s]"), row_.time_step);
  EXPECT_EQ(number("kinetic [J]"), energy.kinetic);
  EXPECT_EQ(number("elastic [J]"), energy.elastic);
  EXPECT_EQ(number("joint elastic [J]"), energy.joint_elastic);
  EXPECT_EQ(number("contact stored [J]"), energy.contact_stored);
  EXPECT_EQ(number("joint mode 1 [J]"), energy.joint_mode_1);
  EXPECT_EQ(number("joint mode 2 [J]"), energy.joint_mode_2);
  EXPECT_EQ(number("joint friction [J]"), energy.joint_friction);
  EXPECT_EQ(number("contact dissipated [J]"), energy.contact_dissipated);
  EXPECT_EQ(number("contact friction [J]"), energy.contact_friction);
  EXPECT_EQ(number("viscous [J]"), energy.viscous);
  EXPECT_EQ(number("damping [J]"), energy.damping);
  EXPECT_EQ(number("external work [J]"), energy.external_work);
  EXPECT_EQ(number("residual [J]"), energy.residual);
  EXPECT_EQ(text("relative residual"), "nan");
}

TEST_F(HistoryFile, PutsCountsAndVectorsUnderTheirNames) {
  EXPECT_EQ(text("damaged joints"), "21");
  EXPECT_EQ(text("broken joints"), "22");
  EXPECT_EQ(text("broken in mode I"), "23");
  EXPECT_EQ(text("broken in mode II"), "24");
  EXPECT_EQ(text("fragments"), "25");
  EXPECT_EQ(text("couples"), "26");
  EXPECT_EQ(text("contacts"), "27");
  EXPECT_EQ(text("momentum x [kg m/s]"), "31");
  EXPECT_EQ(text("momentum z [kg m/s]"), "33");
  EXPECT_EQ(text("angular momentum y [kg m2/s]"), "35");
  EXPECT_EQ(text("max speed [m/s]"), "37");
  EXPECT_EQ(text("sum of |stress yy| [Pa]"), "38");
}

TEST_F(HistoryFile, NamesGaugesByGroupAlsoWhenTheNameHoldsACommaAndQuotes) {
  EXPECT_EQ(text("plate reaction x [N]"), "40");
  EXPECT_EQ(text("plate contact force y [N]"), "44");
  EXPECT_EQ(text("plate displacement z [m]"), "48");
  EXPECT_EQ(text("plate max displacement x [m]"), "49");
  EXPECT_EQ(text("plate velocity z [m/s]"), "54");
  EXPECT_EQ(text("odd, \"name\" reaction z [N]"), "62");
  EXPECT_EQ(text("odd, \"name\" velocity z [m/s]"), "74");
}

TEST(HistorySink, RefusesARowWithAnotherNumberOfGauges) {
  const test::TemporaryFolder folder;
  HistorySink sink(folder / "history.csv");
  RunStart start;
  start.gauges = {"plate"};
  sink.start(start);
  EXPECT_THROW(sink.history(HistoryRow{}), InternalError);
}

TEST(HistorySink, ThrowsOutputErrorWhenTheFileCannotBeMade) {
  HistorySink sink("/proc/breccia_history.csv");
  EXPECT_THROW(sink.start(RunStart{}), OutputError);
}

}  // namespace
}  // namespace breccia
