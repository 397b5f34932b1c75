#include "core/history_columns.hpp"

#include <gtest/gtest.h>

namespace breccia::gui::history_columns_test {
namespace {

History of(const QList<QByteArray>& lines) {
  History history;
  for (const QByteArray& line : lines) history.add_line(line.toStdString());
  return history;
}

TEST(HistoryColumns, NamesAndUnitsAreTakenApart) {
  EXPECT_EQ(parts_of("kinetic [J]").name, "kinetic");
  EXPECT_EQ(parts_of("kinetic [J]").unit, "J");
  EXPECT_EQ(parts_of("sum of |stress yy| [Pa]").unit, "Pa");
  EXPECT_EQ(parts_of("broken joints").name, "broken joints");
  EXPECT_EQ(parts_of("broken joints").unit, "");
}

TEST(HistoryColumns, OfARunAtRestAllThatWouldMoveIsRounding) {
  const History history =
      of({"time [s],kinetic [J],elastic [J],damping [J],block reaction x [N],block displacement x "
          "[m],block centre x [m],broken joints",
          "0,0,0,0,0,0,0.01,0", "1e-4,9e-22,1e-23,0,-9e-9,1.1e-18,0.01,0"});
  EXPECT_EQ(are_round_off(history), (std::vector<bool>{false, true, true, false, true, true, false, false}));
}

TEST(HistoryColumns, OfARunThatMovesOnlyWhatIsSmallerByManyOrders) {
  const History history =
      of({"time [s],kinetic [J],plastic [J],a reaction x [N],b reaction x [N],"
          "a displacement x [m],a centre x [m],fragments",
          "0,0,0,0,0,0,0.01,1", "1e-4,1.2,1e-5,-3e3,2e-9,1e-9,0.01,1"});
  EXPECT_EQ(are_round_off(history), (std::vector<bool>{false, false, false, false, true, false, false, false}));
}

TEST(HistoryColumns, WhatIsNoNumberDoesNotCount) {
  const History history = of({"time [s],kinetic [J],force [N]", "0,nan,inf", "1,2,x"});
  EXPECT_EQ(history.largest(1), 2);
  EXPECT_EQ(history.largest(2), 0);
}

}  // namespace
}  // namespace breccia::gui::history_columns_test
