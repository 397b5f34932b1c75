#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QDirIterator>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPlainTextEdit>
#include <QSet>
#include <QStyleOptionComboBox>
#include <QTableWidget>

#include "case/schema.hpp"
#include "core/case_outline.hpp"
#include "core/value_text.hpp"
#include "gui/desk.hpp"
#include "gui/everything_case.hpp"

namespace breccia::gui::test::forms_test {
namespace {

TEST(Forms, EverySectionOfTheSchemaIsInAStage) {
  for (const case_::Key& key : case_::schema()) {
    if (!key.is_section() || key.path.starts_with('<')) continue;
    const std::string section(key.path);
    bool found = false;
    for (const WorkStage& stage : work_stages())
      for (const std::string& own : stage.sections) found = found || own == section;
    EXPECT_TRUE(found) << section;
  }
}

TEST(Forms, EveryKeyOfTheSchemaHasItsFieldWithTheValueOfTheCase) {
  Desk desk;
  desk.window->open_path(everything(desk.scratch));
  const Document& document = desk.window->document();
  auto* tree = desk.find<QTreeWidget>("stages");
  QSet<QString> seen;
  for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
    tree->setCurrentItem(*it);
    for (QWidget* field : desk.window->findChildren<QWidget*>()) {
      if (!field->objectName().startsWith("field:")) continue;
      const QString path = field->objectName().mid(6);
      seen << QString::fromStdString(case_::pattern_of(path.toStdString()));
      if (auto* line = qobject_cast<QLineEdit*>(field)) {
        EXPECT_EQ(line->text(), shown_value(case_::key_of(case_::pattern_of(path.toStdString())), document.value(path)))
            << path.toStdString();
      }
    }
  }
  for (const case_::Key& key : case_::schema()) {
    if (key.is_section() || key.path.starts_with('<')) continue;
    EXPECT_TRUE(seen.contains(QString::fromUtf8(key.path.data(), static_cast<int>(key.path.size())))) << key.path;
  }
}

TEST(Forms, EveryShippedCaseOpensAndLookingAtItChangesNothing) {
  Desk desk;
  QDirIterator files(BRECCIA_MESHES, {"*.toml"}, QDir::Files, QDirIterator::Subdirectories);
  int cases = 0;
  while (files.hasNext()) {
    const QString file = files.next();
    desk.window->open_path(file);
    const QByteArray before = desk.window->document().text();
    auto* tree = desk.find<QTreeWidget>("stages");
    for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
      tree->setCurrentItem(*it);
      for (auto* line : desk.window->findChildren<QLineEdit*>())
        if (line->objectName().startsWith("field:") || line->objectName().startsWith("parameter:"))
          emit line->editingFinished();
    }
    EXPECT_EQ(desk.window->document().text(), before) << file.toStdString();
    EXPECT_FALSE(desk.window->document().modified()) << file.toStdString();
    EXPECT_EQ(desk.find<QListWidget>("problems")->count(), 0) << file.toStdString();
    ++cases;
  }
  EXPECT_GT(cases, 20);
}

TEST(Forms, TextAndFormFollowEachOther) {
  Desk desk;
  desk.window->open_path(everything(desk.scratch));
  auto* text = desk.find<QPlainTextEdit>("case_text");
  auto* tree = desk.find<QTreeWidget>("stages");
  tree->setCurrentItem(tree->topLevelItem(1)->child(0));
  desk.type("field:material[0].young", "12 GPa");
  EXPECT_TRUE(text->toPlainText().contains("young = \"12 GPa\""));
  QString changed = text->toPlainText();
  changed.replace("12 GPa", "13 GPa");
  text->setPlainText(changed);
  EXPECT_EQ(desk.find<QLineEdit>("field:material[0].young")->text(), "13 GPa");
  desk.type("field:material[0].young", "");
  EXPECT_FALSE(text->toPlainText().contains("13 GPa"));
}

TEST(Forms, LinesOfTheTextAreNumberedAndThoseWithAProblemMarked) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  auto* text = desk.find<QPlainTextEdit>("case_text");
  auto* numbers = desk.find<QWidget>("line_numbers");
  EXPECT_GE(text->viewport()->geometry().left(), numbers->geometry().right());
  const auto has_red = [&] {
    numbers->resize(numbers->width(), 400);  // though another page may be seen
    const QImage image = numbers->grab().toImage();
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (image.pixelColor(x, y).red() > image.pixelColor(x, y).green() + 80) return true;
    return false;
  };
  EXPECT_FALSE(has_red());
  desk.window->document().set_value("material[0].young", "\"12 GN\"");
  ASSERT_TRUE(wait_until([&] { return desk.find<QListWidget>("problems")->count() > 0; }, 60000));
  EXPECT_TRUE(has_red());
}

TEST(Forms, OfALongValueTheBeginningIsSeen) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  const QString title(200, 'x');
  desk.window->document().set_value("title", '"' + title + '"');
  auto* line = desk.find<QLineEdit>("field:title");
  EXPECT_EQ(line->text(), title);
  EXPECT_EQ(line->cursorPosition(), 0);
}

TEST(Forms, WhatIsBeingTypedIsInTheFileThatTheKeyOfSaveWrites) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  desk.click_stage("material: block");
  desk.type_and_stay("field:material[0].young", "12 GPa");
  QTest::keyClick(desk.find<QWidget>("field:material[0].young"), Qt::Key_S, Qt::ControlModifier);
  QFile file(desk.scratch.filePath("case.toml"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains("young = \"12 GPa\""));
  EXPECT_FALSE(desk.window->document().modified());
}

TEST(Forms, AnEntryIsAddedAndRemoved) {
  Desk desk;
  desk.window->open_path(everything(desk.scratch));
  auto* tree = desk.find<QTreeWidget>("stages");
  const QByteArray before = desk.window->document().text();
  tree->setCurrentItem(tree->topLevelItem(1)->child(0));
  desk.window->document().add_entry("material", "group = \"other\"\n");
  EXPECT_EQ(tree->topLevelItem(1)->childCount(), 2);
  tree->setCurrentItem(tree->topLevelItem(1)->child(1));
  desk.click("remove_entry");
  EXPECT_EQ(tree->topLevelItem(1)->childCount(), 1);
  while (desk.window->document().undo_stack().canUndo()) desk.window->document().undo_stack().undo();
  EXPECT_EQ(desk.window->document().text(), before);
}

TEST(Forms, APairOfGroupsGetsItsContactFromTheMatrix) {
  Desk desk;
  desk.window->open_path(QString(BRECCIA_MESHES) + "/glass_impact/case.toml");
  auto* table = desk.find<QTableWidget>("contact_matrix");
  desk.click_stage("contact:");
  ASSERT_EQ(table->rowCount(), 3);
  table->setCurrentCell(0, 2);
  desk.click("own_contact");
  EXPECT_EQ(desk.window->document().value("contact[1].between"), "[\"glass\", \"projectile\"]");
  EXPECT_TRUE(desk.find<QWidget>("field:contact[1].penalty")->isVisible());
  EXPECT_FALSE(desk.find<QAbstractButton>("own_contact")->isEnabled());
  desk.type("field:contact[1].friction", "0.55");
  EXPECT_TRUE(table->item(2, 0)->text().endsWith("0.55"));
  EXPECT_FALSE(table->item(0, 0)->text().endsWith("0.55"));
  EXPECT_TRUE(desk.window->document().problems().empty());
  desk.window->document().add_entry("contact", "between = [\"glass\", \"glass\"]\ninteraction = \"none\"\n");
  EXPECT_EQ(table->item(0, 0)->text(), "do not meet");
  EXPECT_TRUE(desk.window->document().problems().empty());
  desk.window->document().undo_stack().undo();
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, 60000));
  desk.picture("contacts");
}

TEST(Forms, NumbersOfTheGeometryHaveARowEachWithTheirDefaultsAndThoseThatItDoesNotKnowAreMarked) {
  Desk desk;
  Places places;
  places.meshes = BRECCIA_MESHES;
  places.projects = desk.scratch.filePath("own");
  QString error;
  const QString file = copy_template(templates(places)[0], places, &error);
  desk.window->open_path(file);
  Document& document = desk.window->document();
  desk.click_stage("mesh");
  ASSERT_TRUE(wait_until([&] { return desk.window->findChild<QLineEdit*>("parameter:h_edge") != nullptr; }, 20000));
  const auto* edge = desk.find<QLineEdit>("parameter:h_edge");
  EXPECT_EQ(edge->text(), "");
  EXPECT_EQ(edge->placeholderText(), "h");
  EXPECT_TRUE(edge->toolTip().contains("and at the edge of the plate"));
  const QByteArray before = document.text();
  desk.type("parameter:h_edge", "4 mm");
  EXPECT_EQ(document.value("mesh.parameters.h_edge"), "\"4 mm\"");
  QTest::keyClick(desk.find<QWidget>("parameter:h_edge"), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document.text(), before);
  ASSERT_TRUE(wait_until([&] { return !desk.window->busy() && desk.window->view().scene().has_data(); }, 60000));
  desk.picture("parameters");
  document.set_value("mesh.parameters.hh", "3");
  ASSERT_TRUE(wait_until([&] { return desk.window->findChild<QLineEdit*>("parameter:hh") != nullptr; }, 5000));
  ASSERT_TRUE(wait_until([&] { return desk.find<QLabel>("mark:mesh.parameters.hh")->isVisible(); }, 30000));
  EXPECT_TRUE(desk.find<QLabel>("mark:mesh.parameters.hh")->toolTip().contains("the script defines no such parameter"));
  EXPECT_FALSE(desk.find<QLabel>("mark:mesh.parameters.h")->isVisible());
  desk.type("parameter:hh", "");
  ASSERT_TRUE(wait_until([&] { return desk.window->findChild<QLineEdit*>("parameter:hh") == nullptr; }, 5000));
  EXPECT_EQ(document.text(), before);
}

/// Room for the text of a box to choose from, pixels.
int room_for_text(const QComboBox& box) {
  if (box.lineEdit() != nullptr) return box.lineEdit()->width();
  QStyleOptionComboBox option;
  option.initFrom(&box);
  option.subControls = QStyle::SC_All;
  return box.style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box).width();
}

/// Words of boxes in sight that would be cut if they were chosen.
QStringList cut_words(const QWidget& window) {
  QStringList cut;
  for (const auto* box : window.findChildren<QComboBox*>()) {
    if (!box->isVisible()) continue;
    for (int i = 0; i < box->count(); ++i)
      if (const int needed = box->fontMetrics().horizontalAdvance(box->itemText(i)); needed > room_for_text(*box))
        cut << QString("%1 '%2' has %3 of %4")
                   .arg(box->objectName(), box->itemText(i))
                   .arg(room_for_text(*box))
                   .arg(needed);
  }
  return cut;
}

TEST(Forms, EveryWordThatCanBeChosenIsSeenWholeInAWindowOf1280Pixels) {
  Desk desk;
  desk.window->resize(1280, 800);
  desk.window->open_path(everything(desk.scratch));
  auto* tree = desk.find<QTreeWidget>("stages");
  for (int stage = 0; stage < tree->topLevelItemCount(); ++stage) {
    const QTreeWidgetItem* item = tree->topLevelItem(stage);
    EXPECT_LE(tree->fontMetrics().horizontalAdvance(work_stages()[static_cast<std::size_t>(stage)].name),
              tree->visualItemRect(item).width())
        << item->text(0).toStdString();
  }
  for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
    tree->setCurrentItem(*it);
    QTest::qWait(1);
    EXPECT_EQ(cut_words(*desk.window).join('\n').toStdString(), "") << (*it)->text(0).toStdString();
  }
  for (const char* panel : {"Study", "Histogram"}) {
    desk.show_tab(panel);
    QTest::qWait(1);
    EXPECT_EQ(cut_words(*desk.window).join('\n').toStdString(), "") << panel;
  }
}

/// What can get the focus by Tab and is no part inside another widget.
bool counts(const QWidget& widget) {
  if ((widget.focusPolicy() & Qt::TabFocus) == 0 || !widget.isVisible()) return false;
  if (widget.objectName().startsWith("qt_")) return false;
  for (const QWidget* up = widget.parentWidget(); up != nullptr; up = up->parentWidget())
    if (up->inherits("QComboBox") || up->inherits("QAbstractSpinBox") || up->inherits("QAbstractItemView") ||
        up->inherits("QTabBar"))
      return false;
  return !widget.inherits("QTabBar") && !widget.inherits("QMenuBar");
}

TEST(Accessibility, EveryWidgetThatTakesTheFocusHasANameAndATooltipAndIsReachedByTab) {
  Desk desk;
  desk.window->open_path(everything(desk.scratch));
  auto* tree = desk.find<QTreeWidget>("stages");
  int seen = 0;
  const auto check = [&] {
    QTest::qWait(1);
    QSet<const QWidget*> reached;
    for (const QWidget* w = desk.window->nextInFocusChain(); w != desk.window.get(); w = w->nextInFocusChain())
      reached << w;
    for (const QWidget* widget : desk.window->findChildren<QWidget*>()) {
      if (!counts(*widget)) continue;
      const std::string who = std::string(widget->metaObject()->className()) + " " + widget->objectName().toStdString();
      EXPECT_FALSE(widget->accessibleName().isEmpty()) << who;
      EXPECT_FALSE(widget->toolTip().isEmpty()) << who;
      EXPECT_TRUE(reached.contains(widget)) << who;
      if (widget->objectName().startsWith("field:") || widget->objectName().startsWith("parameter:")) {
        EXPECT_TRUE(widget->toolTip().contains("Unit:")) << who;
      }
      ++seen;
    }
  };
  for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
    tree->setCurrentItem(*it);
    check();
  }
  for (const char* panel : {"Plots", "Text", "Runs", "Queue", "Study", "Histogram", "Conditions", "Contacts"}) {
    desk.show_tab(panel);
    check();
  }
  EXPECT_GT(seen, 300);
}

/// The time is told: it is another machine's everywhere else.
TEST(Forms, EveryEditIsOneStepBackAndItsFieldFollowsAtOnce) {
  Desk desk;
  desk.window->open_path(QString(BRECCIA_MESHES) + "/glass_impact/case.toml");
  constexpr int kEdits = 20;
  desk.click_stage("material: ");
  QElapsedTimer timer;
  timer.start();
  for (int i = 0; i < kEdits; ++i) {
    const QString value = QString("%1 GPa").arg(60 + i);
    desk.window->document().set_value("material[0].young", '"' + value + '"');
    EXPECT_EQ(desk.find<QLineEdit>("field:material[0].young")->text(), value);
  }
  std::printf("an edit with its fields: %.1f ms\n", static_cast<double>(timer.elapsed()) / kEdits);
  EXPECT_EQ(desk.window->document().undo_stack().count(), kEdits);
}

}  // namespace
}  // namespace breccia::gui::test::forms_test
