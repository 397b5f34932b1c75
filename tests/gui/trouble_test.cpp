#include <gtest/gtest.h>

#include <QLabel>
#include <QListWidget>
#include <QMessageBox>

#include "gui/desk.hpp"

namespace breccia::gui::test {
namespace {

constexpr int kSolver = 240000;    // ms; the machine may be busy
constexpr int kSnapshots = 20000;  // ms in which a snapshot is tried several times

QStringList messages(Desk& desk) {
  QStringList words;
  auto* list = desk.find<QListWidget>("problems");
  for (int i = 0; i < list->count(); ++i) words << list->item(i)->text();
  return words;
}

QStringList snapshots(const Desk& desk) { return QDir(desk.scratch.filePath("state")).entryList({"unsaved-*"}); }

/// The folder of the desktop's own files cannot be made as long as a file stands in its place.
void block_state(const Desk& desk) {
  const QString state = desk.scratch.filePath("state");
  QDir(state).removeRecursively();
  QFile file(state);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
}

TEST(Trouble, WhatCannotBeKeptIsToldOnceAndIsKeptAsSoonAsItCan) {
  Desk desk;
  block_state(desk);
  desk.window->open_path(written_case(desk.scratch, turning_case("100 us")));
  EXPECT_EQ(messages(desk).filter("not kept among the recent ones").size(), 1);
  desk.window->document().set_value("material[0].young", "\"41 GPa\"");
  ASSERT_TRUE(wait_until([&] { return !messages(desk).filter("Unsaved edits").empty(); }, kSnapshots));
  desk.window->document().set_value("material[0].young", "\"42 GPa\"");
  QTest::qWait(3 * Document::kAutosaveDelay);  // it is tried again and again
  EXPECT_EQ(messages(desk).filter("Unsaved edits are not kept").size(), 1);
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  ASSERT_TRUE(QFile::remove(desk.scratch.filePath("state")));
  ASSERT_TRUE(wait_until([&] { return messages(desk).filter("Unsaved edits").empty(); }, kSnapshots));
  EXPECT_EQ(snapshots(desk).size(), 1);
  block_state(desk);
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_EQ(messages(desk).filter("later windows will not list it").size(), 1);
  ASSERT_TRUE(wait_until([&] { return desk.window->run()->state() == "complete"; }, kSolver));
}

TEST(Trouble, TheEstimateFollowsAnEditWhileARunIsShown) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("100 us")));
  desk.click_stage("Run");
  auto* estimate = desk.find<QLabel>("estimate");
  ASSERT_TRUE(wait_until([&] { return estimate->text().contains("steps to 100 us"); }, kSolver)) << "never worked out";
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_NE(desk.window->run(), nullptr);
  ASSERT_TRUE(wait_until([&] { return desk.window->run()->state() == "complete"; }, kSolver));
  desk.window->document().set_value("stage[0].end", "\"200 us\"");
  ASSERT_TRUE(wait_until([&] { return estimate->text().contains("steps to 200 us"); }, kSolver)) << "is of the past";
  desk.click_stage("Materials");
  desk.window->document().set_value("stage[0].end", "\"300 us\"");
  QTest::qWait(500);
  EXPECT_TRUE(estimate->text().contains("steps to 200 us")) << "worked out while nobody looks";
  desk.click_stage("Run");
  EXPECT_FALSE(estimate->text().contains("steps to 200 us")) << "shown though it is of the past";
  EXPECT_TRUE(wait_until([&] { return estimate->text().contains("steps to 300 us"); }, kSolver));
}

}  // namespace
}  // namespace breccia::gui::test
