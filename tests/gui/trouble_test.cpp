#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QListWidget>
#include <QSpinBox>

#include "gui/answer.hpp"
#include "gui/desk.hpp"
#include "gui/full_disk.hpp"
#include "gui/plain_user.hpp"

namespace breccia::gui::test::trouble_test {
namespace {

constexpr int kSolver = 240000;    // ms; the machine may be busy
constexpr int kSnapshots = 20000;  // ms in which a snapshot is tried several times

/// Where it does not matter on how many ranks a run is: on one it takes a third of the time.
struct OneRank : Desk {
  OneRank() { find<QSpinBox>("ranks")->setValue(1); }
};

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

void write(const QString& name, const QByteArray& text) {
  QFile file(name);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  ASSERT_EQ(file.write(text), text.size());
}

QByteArray content(const QString& name) {
  QFile file(name);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// The key of run, also after a dialog: without a window manager nothing gives the focus back to the window.
void press(Desk& desk, Qt::KeyboardModifiers modifiers = {}) {
  desk.window->activateWindow();
  (void)QTest::qWaitForWindowActive(desk.window.get());
  QTest::keyClick(desk.window.get(), Qt::Key_F5, modifiers);
}

bool completes(Desk& desk) {
  return desk.window->run() != nullptr &&
         wait_until([&] { return desk.window->run()->state() == "complete"; }, kSolver);
}

TEST(Trouble, WhatCannotBeKeptIsToldOnceAndIsKeptAsSoonAsItCan) {
  OneRank desk;
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
  OneRank desk;
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

TEST(Trouble, ACaseThatAnotherProgramHasChangedIsNotRunUnasked) {
  OneRank desk;
  const QString file = written_case(desk.scratch, turning_case("100 us"));
  desk.window->open_path(file);
  write(file, turning_case("50 us"));
  {
    const Answer no(QMessageBox::Cancel);
    QTest::keyClick(desk.window.get(), Qt::Key_F5);
    EXPECT_EQ(no.words().filter("Another program has changed").size(), 1);
    EXPECT_EQ(desk.window->run(), nullptr);
  }
  EXPECT_EQ(messages(desk).filter("Another program has changed").size(), 1);
  const Answer take_over(QMessageBox::Open);
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_TRUE(completes(desk));
  EXPECT_EQ(desk.window->document().value("stage[0].end"), "\"50 us\"");
  EXPECT_FALSE(desk.window->document().modified());
  EXPECT_TRUE(messages(desk).filter("Another program").empty());
  desk.window->document().undo_stack().undo();
  EXPECT_EQ(desk.window->document().value("stage[0].end"), "\"100 us\"") << "what was here before is lost";
}

TEST(Trouble, ARunWhoseCaseHasBeenEditedSinceIsNotResumedUnasked) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("10 s")));
  press(desk);
  SolverRun* first = desk.window->run();
  ASSERT_NE(first, nullptr);
  ASSERT_TRUE(wait_until([&] { return first->state() == "running"; }, kSolver));
  press(desk, Qt::ShiftModifier);
  ASSERT_TRUE(wait_until([&] { return first->can_go_on(); }, kSolver)) << first->failure().toStdString();
  desk.window->document().set_value("stage[0].end", "\"50 us\"");
  {
    const Answer no(QMessageBox::Cancel);
    press(desk, Qt::ControlModifier);
    EXPECT_EQ(no.words().filter("has been edited since").size(), 1);
    EXPECT_FALSE(desk.window->run()->alive());
  }
  desk.window->document().undo_stack().undo();
  {
    const Answer none(QMessageBox::Cancel);
    press(desk, Qt::ControlModifier);
    EXPECT_TRUE(none.words().empty()) << none.words().join("\n").toStdString();
    EXPECT_TRUE(desk.window->run()->alive());
  }
  ASSERT_TRUE(wait_until([&] { return desk.window->run()->state() == "running"; }, kSolver));
  press(desk, Qt::ShiftModifier);
  ASSERT_TRUE(wait_until([&] { return desk.window->run()->can_go_on(); }, kSolver));
  desk.window->document().set_value("stage[0].end", "\"50 us\"");
  const QString folder = desk.window->run()->record().folder;
  const Answer anew(QMessageBox::No);
  press(desk, Qt::ControlModifier);
  ASSERT_TRUE(completes(desk));
  EXPECT_NE(desk.window->run()->record().folder, folder);
}

TEST(Trouble, ACaseThatAnotherWindowHasOpenSaysSoUntilThatOneHasClosed) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("50 us"));
  Places places;
  places.launch = {BRECCIA_PROGRAM, BRECCIA_MPIEXEC};
  places.desktop = BRECCIA_GUI;
  places.meshes = BRECCIA_MESHES;
  places.projects = desk.scratch.filePath("projects");
  places.state = desk.scratch.filePath("state");
  auto other = std::make_unique<MainWindow>(places);
  other->open_path(file);
  desk.window->open_path(file);
  EXPECT_EQ(messages(desk).filter("open in another window").size(), 1) << messages(desk).join("\n").toStdString();
  other->document().close();
  other.reset();
  desk.window->open_path(file);
  EXPECT_TRUE(messages(desk).filter("open in another window").empty());
}

TEST(Trouble, ACaseWhoseFileIsGoneIsWrittenAgainBeforeItIsRun) {
  OneRank desk;
  const QString file = written_case(desk.scratch, turning_case("50 us"));
  desk.window->open_path(file);
  ASSERT_TRUE(QFile::remove(file));
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_TRUE(completes(desk));
  EXPECT_EQ(content(file), turning_case("50 us"));
}

TEST(Trouble, AFullDiskIsToldWhereSomethingIsSavedAndNothingIsLost) {
  OneRank desk;
  const QString file = written_case(desk.scratch, turning_case("100 us")), picture = desk.scratch.filePath("p.png");
  desk.window->open_path(file);
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data() && !desk.window->busy(); }, kSolver));
  desk.window->document().set_value("stage[0].end", "\"50 us\"");
  const auto save_picture = [&] {
    for (QAction* action : desk.window->findChildren<QAction*>())
      if (action->text() == "Save p&icture...") desk.name_in_dialog([&] { action->trigger(); }, picture);
  };
  {
    const FullDisk full;
    const Answer ok(QMessageBox::Ok);
    press(desk);
    EXPECT_EQ(ok.words().filter("File too large").size(), 1) << ok.words().join("\n").toStdString();
    EXPECT_EQ(desk.window->run(), nullptr) << "runs a case that is not in its file";
    save_picture();
    EXPECT_EQ(ok.words().filter("p.png").size(), 1) << ok.words().join("\n").toStdString();
  }
  EXPECT_EQ(content(file), turning_case("100 us"));
  EXPECT_FALSE(QFile::exists(picture));
  EXPECT_TRUE(desk.window->document().modified());
  EXPECT_EQ(desk.window->document().value("stage[0].end"), "\"50 us\"");
  save_picture();
  EXPECT_TRUE(content(picture).startsWith("\x89PNG"));
  press(desk);
  ASSERT_TRUE(completes(desk));
  EXPECT_EQ(content(file), turning_case("50 us"));
}

TEST(Trouble, ACaseInAFolderThatIsOnlyReadRunsElsewhereAndItsEditsAreNotLost) {
  OneRank desk;
  const QString folder = desk.scratch.filePath("colleague"), file = folder + "/case.toml";
  ASSERT_TRUE(QDir().mkpath(folder));
  write(file, turning_case("100 us"));
  const QFile::Permissions read = QFile::ReadOwner | QFile::ExeOwner;
  ASSERT_TRUE(QFile::setPermissions(file, QFile::ReadOwner) && QFile::setPermissions(folder, read));
  const PlainUser user;
  if (!user.holds()) GTEST_SKIP() << "permissions do not hold for this user";
  desk.window->open_path(file);
  press(desk);
  ASSERT_TRUE(completes(desk));
  EXPECT_TRUE(desk.window->run()->record().folder.startsWith(desk.scratch.filePath("projects")));
  desk.window->document().set_value("stage[0].end", "\"50 us\"");
  const QString before = desk.window->run()->record().folder;
  {
    const Answer ok(QMessageBox::Ok);
    press(desk);
    EXPECT_EQ(ok.words().filter("case.toml").size(), 1) << ok.words().join("\n").toStdString();
    EXPECT_EQ(desk.window->run()->record().folder, before) << "runs a case that is not in its file";
  }
  EXPECT_TRUE(desk.window->document().modified());
  EXPECT_EQ(content(file), turning_case("100 us"));
  EXPECT_EQ(QDir(folder).entryList(QDir::Files), QStringList{"case.toml"}) << "nothing else is left there";
  ASSERT_TRUE(QFile::setPermissions(folder, read | QFile::WriteOwner));
}

TEST(Trouble, AMeshThatCannotBeReadIsToldInTheViewAndIsDrawnOnceItCan) {
  Desk desk;
  QByteArray text = content(QString(BRECCIA_MESHES) + "/block_wall/case_smoke.toml");
  ASSERT_TRUE(text.contains("\"geometry.geo\""));
  text.replace("\"geometry.geo\"", "\"none.geo\"");
  desk.window->open_path(written_case(desk.scratch, text));
  View3D& view = desk.window->view();
  EXPECT_TRUE(view.caption().contains("problems")) << view.caption().toStdString();
  EXPECT_EQ(messages(desk).filter("none.geo").size(), 1);
  write(desk.scratch.filePath("broken.geo"), "Box(1) = {;\n");
  desk.window->document().set_value("mesh.file", "\"broken.geo\"");
  ASSERT_TRUE(wait_until([&] { return view.caption().startsWith("no mesh:"); }, kSolver)) << "it is said to be meshed";
  EXPECT_FALSE(messages(desk).filter("broken.geo").empty()) << messages(desk).join("\n").toStdString();
  ASSERT_TRUE(QFile::copy(QString(BRECCIA_MESHES) + "/block_wall/geometry.geo", desk.scratch.filePath("geometry.geo")));
  desk.window->document().set_value("mesh.file", "\"geometry.geo\"");
  EXPECT_TRUE(wait_until([&] { return view.scene().has_data(); }, kSolver));
}

TEST(Trouble, NamesOfAnyKindAreRunAndAFolderThatIsRemovedMeanwhileHarmsNothing) {
  Desk desk;
  const QString folder =
      desk.scratch.filePath(QString::fromUtf8("\u00dcbung 1 'b\u00e4r' & \"co\"/") + QString(120, 'x'));
  ASSERT_TRUE(QDir().mkpath(folder));
  const QString file = folder + QString::fromUtf8("/mein F\u00e4ll #1.toml");
  write(file, turning_case("100 us"));
  desk.window->open_path(file);
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_TRUE(completes(desk)) << desk.window->run()->failure().toStdString();
  ASSERT_FALSE(desk.window->run()->frames().empty());
  desk.click_stage("Results");
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
  ASSERT_TRUE(QDir(desk.window->run()->record().folder).removeRecursively());
  QTest::qWait(3 * SolverRun::kInterval);
  desk.click("previous_frame");
  desk.click("next_frame");
  QTest::qWait(500);
  desk.click_stage("Materials");
  desk.click_stage("Run");
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  EXPECT_TRUE(completes(desk));
}

TEST(Trouble, FilesThatAreNoCasesAreOpenedWithTheirProblemsAndLeftAsTheyAre) {
  Desk desk;
  QByteArray noise;
  for (int i = 0; i < 20000; ++i) noise += static_cast<char>((i * 2654435761U) >> 13);
  const QString file = desk.scratch.filePath("case.toml");
  for (const QByteArray& text : {QByteArray(), noise, QByteArray(200000, '['), QByteArray("title = [\n")}) {
    write(file, text);
    desk.window->open_path(file);
    EXPECT_FALSE(messages(desk).empty());
    for (const char* stage : {"Materials", "Joints", "Run"}) desk.click_stage(stage);
    EXPECT_EQ(content(file), text);
    EXPECT_FALSE(desk.window->document().modified());
  }
}

TEST(Trouble, AnEntryWhoseFormIsShownCanBeUndoneAndANameThatNothingHasAnyMoreIsMarked) {
  Desk desk;
  const QByteArray text = turning_case("50 us");
  desk.window->open_path(written_case(desk.scratch, text));
  Document& document = desk.window->document();
  document.add_entry("stage[0].constraint", "group = \"block.x0\"\nfixed = \"xyz\"\n");
  QTest::qWait(300);
  desk.click_stage("constraint");
  document.set_value("stage[0].constraint[0].fixed", "\"x\"");
  while (document.undo_stack().canUndo()) document.undo_stack().undo();
  QTest::qWait(300);
  EXPECT_EQ(document.text(), text);
  EXPECT_TRUE(messages(desk).empty()) << messages(desk).join("\n").toStdString();
  desk.click_stage("material: block");
  desk.type("field:material[0].group", "stone");
  ASSERT_TRUE(wait_until([&] { return !messages(desk).filter("block").empty(); }, kSolver));
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  EXPECT_EQ(desk.window->run(), nullptr);
  document.undo_stack().undo();
  ASSERT_TRUE(wait_until([&] { return messages(desk).empty(); }, kSolver)) << messages(desk).join("\n").toStdString();
}

/// Edits of a case that a session which was killed has left.
void leave_edits(const Desk& desk, const QString& file, const QByteArray& edited) {
  ASSERT_TRUE(QDir().mkpath(desk.scratch.filePath("state")));
  write(desk.scratch.filePath("state/unsaved-0-1.json"),
        "{\"file\": \"" + file.toUtf8() + "\", \"process\": 99999999, \"text\": \"" + edited.toBase64() + "\"}");
}

TEST(Trouble, EditsThatASessionLeftAreOfferedWhenTheirCaseIsOpened) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("50 us"));
  const QByteArray edited = turning_case("70 us");
  leave_edits(desk, file, edited);
  const Answer yes(QMessageBox::Yes);
  desk.window->open_path(file);
  EXPECT_EQ(yes.words().filter("without saving").size(), 1);
  EXPECT_EQ(yes.details(), QStringList("- end = \"50 us\"\n+ end = \"70 us\"")) << "what would come back";
  EXPECT_EQ(desk.window->document().text(), edited);
  EXPECT_TRUE(desk.window->document().modified());
  EXPECT_EQ(snapshots(desk).size(), 1) << "they are kept on";
}

TEST(Trouble, EditsThatASessionLeftAreKeptUntilTheyAreTakenUpOrDiscarded) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("50 us"));
  leave_edits(desk, file, turning_case("70 us"));
  {
    const Answer escape(QMessageBox::NoButton);
    desk.window->open_path(file);
    EXPECT_EQ(escape.words().filter("without saving").size(), 1);
    EXPECT_EQ(snapshots(desk).size(), 1) << "the key of Escape has thrown them away";
    EXPECT_EQ(desk.window->document().text(), turning_case("50 us"));
  }
  const Answer discard(QMessageBox::Discard);
  desk.window->open_path(file);
  EXPECT_EQ(discard.words().filter("without saving").size(), 1) << "offered again";
  EXPECT_TRUE(snapshots(desk).isEmpty());
}

TEST(Trouble, WhoSavesOverAnotherProgramsEditsCanTakeThoseInstead) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us"));
  desk.window->open_path(file);
  Document& document = desk.window->document();
  document.set_value("stage[0].end", "\"70 us\"");
  write(file, turning_case("50 us"));
  const Answer theirs(QMessageBox::Open);
  QTest::keyClick(desk.window.get(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(theirs.words().filter("Another program has changed").size(), 1);
  EXPECT_TRUE(theirs.details().join("").contains("- end = \"70 us\"\n+ end = \"50 us\""));
  EXPECT_EQ(content(file), turning_case("50 us"));
  EXPECT_EQ(document.text(), turning_case("50 us"));
  document.undo_stack().undo();
  EXPECT_EQ(document.value("stage[0].end"), "\"70 us\"") << "what was here before is lost";
}

}  // namespace
}  // namespace breccia::gui::test::trouble_test
