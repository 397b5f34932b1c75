#include "case/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace breccia::case_::expression_test {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Columns that a row of a test fills: step, time, a force, a length, a count, and names that need quotes.
const std::vector<HistoryColumn>& columns() {
  static const std::vector<HistoryColumn> all{
      {"", "step"},
      {"", "time", "s"},
      {"bar.x1", "reaction x", "N"},
      {"bar.x1", "displacement x", "m"},
      {"", "broken joints"},
      {"left plate", "spin x", "rad/s"},
      {"left-plate", "spin x", "rad/s"},
  };
  return all;
}

/// A condition and what it remembers.
struct Watched {
  explicit Watched(const std::string& text) : when(text, columns()), cells(when.num_cells(), kNoCell) {}
  bool at(double time, double force, double length = 0, double broken = 0) {
    const std::vector<double> row{0, time, force, length, broken, 3, 7};
    return when.holds(row, cells);
  }
  Expression when;
  std::vector<double> cells;
};

bool holds(const std::string& text, double force = 0, double length = 0, double broken = 0) {
  return Watched(text).at(1.0, force, length, broken);
}

std::string message(const std::string& text) {
  try {
    Expression(text, columns());
  } catch (const ExpressionError& error) {
    return std::string(error.what()) + "; allowed: " + error.allowed;
  }
  return {};
}

TEST(Expression, ComparesWithTheFourSigns) {
  EXPECT_TRUE(holds("broken_joints > 4", 0, 0, 5));
  EXPECT_FALSE(holds("broken_joints > 5", 0, 0, 5));
  EXPECT_TRUE(holds("broken_joints >= 5", 0, 0, 5));
  EXPECT_TRUE(holds("broken_joints <= 5", 0, 0, 5));
  EXPECT_FALSE(holds("broken_joints < 5", 0, 0, 5));
}

TEST(Expression, HasTheUsualOrderOfOperators) {
  EXPECT_TRUE(holds("2 + 3 * 4 - 6 / 3 >= 12 and 2 + 3 * 4 - 6 / 3 <= 12"));
  EXPECT_TRUE(holds("8 - 3 - 2 <= 3"));
  EXPECT_TRUE(holds("(8 - 3) * -2 <= -10 and (8 - 3) * -2 >= -10"));
  EXPECT_TRUE(holds("1 > 0 or 1 < 0 and 1 < 0")) << "and goes before or";
  EXPECT_FALSE(holds("(1 > 0 or 1 < 0) and 1 < 0"));
}

TEST(Expression, ReadsUnitsByTheRulesOfTheCase) {
  EXPECT_TRUE(holds("bar.x1.reaction_x > 1.2 kN", 1201));
  EXPECT_FALSE(holds("bar.x1.reaction_x > 1.2 kN", 1199));
  EXPECT_TRUE(holds("bar.x1.reaction_x > 1200", 1201)) << "a number without a unit is in SI units";
  EXPECT_TRUE(holds("bar.x1.reaction_x / bar.x1.displacement_x > 2 kN/mm", 3000, 1e-3));
  EXPECT_TRUE(holds("bar.x1.reaction_x * bar.x1.displacement_x > 2 J and time < 2 s", 3000, 1e-3));
  EXPECT_TRUE(holds("bar.x1.displacement_x < 10 %*1 mm", 0, 0.9e-4));
}

TEST(Expression, RefusesTwoDimensionsOnTheSidesOfASign) {
  EXPECT_THAT(message("bar.x1.reaction_x > 1 mm"),
              HasSubstr("has two dimensions on the two sides of >: force and length"));
  EXPECT_THAT(message("bar.x1.reaction_x + bar.x1.displacement_x > 1"),
              HasSubstr("on the two sides of +: force and length"));
  EXPECT_THAT(message("bar.x1.reaction_x > 0.5 * peak(bar.x1.displacement_x)"), HasSubstr(": force and length"));
  EXPECT_THAT(message("broken_joints > 5 N"), HasSubstr(": plain number and force"));
  EXPECT_THAT(message("time > 1 s for 2 N"), HasSubstr("the duration behind for is of dimension force"));
}

TEST(Expression, NamesColumnsByWordOrInQuotes) {
  EXPECT_TRUE(holds("'bar.x1 reaction x' > 5", 6));
  EXPECT_TRUE(holds("'bar.x1 reaction x [N]' > 5 N", 6));
  EXPECT_TRUE(holds("'left-plate spin x' > 5 rad/s"));
  EXPECT_FALSE(holds("'left plate spin x' > 5 rad/s"));
  EXPECT_THAT(message("left_plate.spin_x > 5"), HasSubstr("two columns are meant by \"left_plate.spin_x\"; allowed: "
                                                          "'left plate spin x' or 'left-plate spin x'"));
}

TEST(Expression, NamesTheNearestColumns) {
  EXPECT_THAT(message("broken_jonts > 5"), HasSubstr("no column \"broken_jonts\"; allowed: broken_joints, "));
  EXPECT_THAT(message("bar.ement_x > 5"), HasSubstr("allowed: bar.x1.displacement_x, ")) << "the last part is its own";
  EXPECT_THAT(message("'broken jonts' > 5"), HasSubstr("'broken joints'"));
}

TEST(Expression, SaysWhatIsMissing) {
  EXPECT_THAT(message("broken_joints >"), HasSubstr("a column, a number or \"(\" is missing at its end"));
  EXPECT_THAT(message("(broken_joints > 5"), HasSubstr("\")\" is missing at its end"));
  EXPECT_THAT(message("broken_joints > 5 6"), HasSubstr("an operator or the end is missing before \"6\""));
  EXPECT_THAT(message("broken_joints == 5"), HasSubstr("missing before \"== 5\""));
  EXPECT_THAT(message("broken_joints > 0,5"), HasSubstr("missing before \",5\""));
  EXPECT_THAT(message("'broken joints > 5"), HasSubstr("the second of two quotes"));
  EXPECT_THAT(message("peak broken_joints > 5"), HasSubstr("\"(\" behind peak is missing"));
  EXPECT_THAT(message("time > 1 s for"), HasSubstr("a number is missing at its end"));
  EXPECT_THAT(message("broken_joints + 1"), HasSubstr("is a number, not a condition"));
  EXPECT_THAT(message("broken_joints and time > 1"), HasSubstr("and joins conditions, not numbers"));
  EXPECT_THAT(message("(time > 1) + 1 > 2"), HasSubstr("+ takes numbers, not conditions"));
  EXPECT_THAT(message("peak(time > 1) > 2"), HasSubstr(" is missing before \"> 1) > 2\""));
  EXPECT_THAT(message("time > 1 kNN"), HasSubstr("unknown unit"));
  EXPECT_THAT(message(""), HasSubstr("is missing at its end"));
  EXPECT_THAT(message("time > 1e999 s"), HasSubstr("outside the range"));
}

TEST(Expression, BoundsWhatItReads) {
  EXPECT_THAT(message(std::string(60, '(') + "1" + std::string(60, ')') + " > 0"), HasSubstr("too many brackets"));
  EXPECT_THAT(message(std::string(100000, '-') + "1 > 0"), HasSubstr("too many brackets"));
  std::string sum = "1";
  for (int i = 0; i < 1000; ++i) sum += " + 1";
  EXPECT_THAT(message(sum + " > 0"), HasSubstr("is too long; allowed: at most 1000"));
}

TEST(Expression, RemembersThePeakAndTheLowestValueSoFar) {
  Watched falls("bar.x1.reaction_x < 0.5 * peak(bar.x1.reaction_x)");
  EXPECT_FALSE(falls.at(0, 0));
  EXPECT_FALSE(falls.at(1, 100));
  EXPECT_FALSE(falls.at(2, 50));
  EXPECT_TRUE(falls.at(3, 49));
  EXPECT_FALSE(falls.at(4, 120));
  EXPECT_TRUE(falls.at(5, 59));
  Watched rises("bar.x1.reaction_x > lowest(bar.x1.reaction_x) + 10 N");
  EXPECT_FALSE(rises.at(0, 5));
  EXPECT_FALSE(rises.at(1, -5));
  EXPECT_TRUE(rises.at(2, 6));
}

TEST(Expression, APeakIsRememberedWhereItDoesNotMatterYet) {
  Watched both("broken_joints > 10 and bar.x1.reaction_x < 0.5 * peak(bar.x1.reaction_x)");
  EXPECT_FALSE(both.at(0, 100));
  EXPECT_TRUE(both.at(1, 40, 0, 11)) << "the peak was before the first condition was true";
}

TEST(Expression, NotANumberIsNoPeakAndComparesWithNothing) {
  Watched peak("peak(bar.x1.reaction_x) > 5");
  EXPECT_FALSE(peak.at(0, kNan));
  EXPECT_TRUE(peak.at(1, 6));
  EXPECT_TRUE(peak.at(2, kNan));
  EXPECT_FALSE(holds("bar.x1.reaction_x < 5 or bar.x1.reaction_x >= 5", kNan));
}

TEST(Expression, LastsForATime) {
  Watched rest("bar.x1.reaction_x < 5 for 2 s");
  EXPECT_FALSE(rest.at(0, 1));
  EXPECT_FALSE(rest.at(1, 1));
  EXPECT_TRUE(rest.at(2, 1));
  EXPECT_FALSE(rest.at(3, 9));
  EXPECT_FALSE(rest.at(4, 1)) << "it begins anew";
  EXPECT_TRUE(rest.at(6, 1));
  EXPECT_TRUE(Watched("bar.x1.reaction_x < 5 for 0 s").at(0, 1));
}

TEST(Expression, ContinuesFromItsCells) {
  Watched first("bar.x1.reaction_x < 0.5 * peak(bar.x1.reaction_x) for 1 s"), second = first;
  EXPECT_FALSE(first.at(0, 100));
  EXPECT_FALSE(first.at(1, 40));
  second.cells = first.cells;
  EXPECT_TRUE(second.at(2, 40));
}

TEST(Expression, NamesTheValuesThatItRead) {
  Watched falls("abs(bar.x1.reaction_x) < 0.5 * peak(abs(bar.x1.reaction_x)) or abs(bar.x1.reaction_x) > 1 MN");
  (void)falls.at(0, -100);
  (void)falls.at(1, -30);
  const std::vector<Expression::Term> terms = falls.when.terms();
  ASSERT_EQ(terms.size(), 2U);
  EXPECT_EQ(terms[0].text, "bar.x1.reaction_x");
  EXPECT_EQ(terms[0].value, -30);
  EXPECT_EQ(terms[0].unit, "N");
  EXPECT_EQ(terms[1].text, "peak(abs(bar.x1.reaction_x))");
  EXPECT_EQ(terms[1].value, 100);
}

TEST(HistoryColumns, EveryColumnHasAWordOfItsOwn) {
  Gauge line;
  line.name = "line";
  line.kind = GaugeKind::line;
  line.points = 3;
  const std::vector<HistoryColumn> all = history_columns({"bar.x1", "body 3"}, {line});
  std::vector<std::string> words;
  for (const HistoryColumn& column : all) {
    words.push_back(column.word());
    EXPECT_TRUE(Expression(column.word() + " > 0", all).num_cells() == 0) << column.name();
    EXPECT_TRUE(Expression("'" + column.header() + "' > 0", all).num_cells() == 0) << column.name();
  }
  EXPECT_THAT(words, testing::IsSupersetOf({"time", "joint_elastic", "broken_in_mode_II", "sum_of_stress_yy",
                                            "bar.x1.reaction_x", "body_3.resultant_torque_z", "line_3.stress_xz"}));
}

}  // namespace
}  // namespace breccia::case_::expression_test
