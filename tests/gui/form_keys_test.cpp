#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QTreeWidget>
#include <QWheelEvent>

#include "gui/desk.hpp"
#include "gui/everything_case.hpp"

// Enter, Escape, Tab, arrow keys and wheel in the fields of the forms, and Enter in the dialogs.

namespace breccia::gui::test::form_keys_test {
namespace {

void turn_wheel(QWidget& over) {
  const QPointF place = over.rect().center();
  QWheelEvent event(place, over.mapToGlobal(place.toPoint()), {}, {0, -120}, Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&over, &event);
}

const QString kGroup = "field:material[0].group";

/// A case of three groups with one entry for two of them; its mesh is not read.
struct GroupDesk : Desk {
  GroupDesk() {
    window->open_path(written_case(scratch, R"([mesh]
file = "none.msh"
[[material]]
group = ["glass", "support"]
[[material]]
group = "projectile"
[[material]]
group = "glass_top"
)"));
    click_stage("material: glass, support");
  }
  [[nodiscard]] QString value() { return window->document().value("material[0].group"); }
  QComboBox* box() { return find<QComboBox>(kGroup); }
};

TEST(FormKeys, EnterInABoxOfGroupsLeavesTheEntryAsItIs) {
  GroupDesk desk;
  const QByteArray before = desk.window->document().text();
  desk.box()->setFocus();
  QTest::keyClick(desk.box(), Qt::Key_Return);
  EXPECT_EQ(desk.window->document().text(), before);
  EXPECT_EQ(desk.box()->currentText(), "glass, support");
  EXPECT_EQ(desk.box()->findText("glass, support"), -1) << "a list is no group";
}

TEST(FormKeys, WhatIsTypedIntoABoxOfGroupsIsTakenAsItWasTyped) {
  for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Tab}) {
    for (const auto& [typed, expected] : std::initializer_list<std::pair<QString, QString>>{
             {"projectile", "\"projectile\""},               // one of the list
             {"glass, projectile", "[\"glass\", \"projectile\"]"},
             {"gla", "\"gla\""},                             // with which others begin
             {"Glass", "\"Glass\""},                         // letters count
             {"mine", "\"mine\""}}) {                        // of nowhere
      GroupDesk desk;
      desk.type_and_stay(kGroup, typed);
      QTest::keyClick(desk.box(), key);
      EXPECT_EQ(desk.value(), expected) << key;
      EXPECT_EQ(desk.box()->currentText(), typed) << key;
      EXPECT_EQ(desk.window->document().undo_stack().count(), 1) << key;
    }
  }
}

TEST(FormKeys, OnlyAChoiceFromTheListAddsAGroup) {
  GroupDesk desk;
  desk.box()->setFocus();
  QTest::keyClick(desk.box(), Qt::Key_Down);
  EXPECT_EQ(desk.value(), "[\"glass\", \"support\"]") << "an arrow key opens the list";
  ASSERT_TRUE(desk.box()->view()->isVisible());
  desk.box()->view()->setCurrentIndex(desk.box()->model()->index(desk.box()->findText("projectile"), 0));
  QTest::keyClick(desk.box()->view(), Qt::Key_Return);
  EXPECT_EQ(desk.value(), "[\"glass\", \"support\", \"projectile\"]");
  EXPECT_EQ(desk.box()->currentText(), "glass, support, projectile");
}

TEST(FormKeys, EscapeTakesBackWhatWasTyped) {
  GroupDesk desk;
  desk.type_and_stay(kGroup, "mine");
  QTest::keyClick(desk.box(), Qt::Key_Escape);
  EXPECT_EQ(desk.box()->currentText(), "glass, support");
  desk.type_and_stay("field:material[0].young", "7 GPa");
  QTest::keyClick(desk.find<QWidget>("field:material[0].young"), Qt::Key_Escape);
  EXPECT_EQ(desk.find<QLineEdit>("field:material[0].young")->text(), "");
  desk.find<QWidget>("stages")->setFocus();
  EXPECT_FALSE(desk.window->document().modified());
}

TEST(FormKeys, NoKeyOfAFieldInWhichNothingWasTypedAndNoWheelChangesTheCase) {
  Desk desk;
  desk.window->open_path(everything(desk.scratch));
  const QByteArray before = desk.window->document().text();
  auto* tree = desk.find<QTreeWidget>("stages");
  int fields = 0;
  for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
    tree->setCurrentItem(*it);
    for (QWidget* field : desk.window->findChildren<QWidget*>()) {
      const QString name = field->objectName();
      auto* box = qobject_cast<QComboBox*>(field);
      if (!name.startsWith("field:") || (box == nullptr && qobject_cast<QLineEdit*>(field) == nullptr)) continue;
      ++fields;
      field->setFocus();
      turn_wheel(*field);
      for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Escape, Qt::Key_End, Qt::Key_Home})
        if (box == nullptr || box->isEditable() || (key != Qt::Key_End && key != Qt::Key_Home))
          QTest::keyClick(field, key);
      QTest::keyClick(field, Qt::Key_Tab);
      ASSERT_EQ(desk.window->document().text(), before) << name.toStdString();
    }
  }
  EXPECT_GT(fields, 100);
}

TEST(FormKeys, TheWheelOverABoxThatHasNotTheCursorChangesNothing) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  for (const char* stage : {"mesh", "material: block", "domains", "Run", "Results"}) {
    desk.click_stage(stage);
    desk.find<QWidget>("stages")->setFocus();
    for (auto* box : desk.window->findChildren<QAbstractSpinBox*>()) {
      const QString before = box->text();
      turn_wheel(*box);
      EXPECT_EQ(box->text(), before) << box->objectName().toStdString();
    }
    for (auto* box : desk.window->findChildren<QComboBox*>()) {
      const int before = box->currentIndex();
      turn_wheel(*box);
      EXPECT_EQ(box->currentIndex(), before) << box->objectName().toStdString();
    }
  }
}

TEST(FormKeys, TheHeadingOfAFormFollowsANewNameAndItsUndo) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  desk.click_stage("material: block");
  auto* heading = desk.find<QLabel>("section_help");
  EXPECT_TRUE(heading->text().contains("material: block"));
  desk.type(kGroup, "brick");
  EXPECT_TRUE(desk.find<QLabel>("section_help")->text().contains("material: brick"));
  desk.window->document().undo_stack().undo();
  EXPECT_TRUE(desk.find<QLabel>("section_help")->text().contains("material: block"));
  const QByteArray text = desk.window->document().text();
  desk.window->document().set_text(QByteArray(text).replace("group = \"block\"  # mine", "group = \"b\""));
  EXPECT_TRUE(desk.find<QLabel>("section_help")->text().contains("material: b<")) << "typed into the text";
}

/// Of the dialog: the one that Enter in a field presses.
QString default_button(const QDialog& dialog) {
  for (const auto* button : dialog.findChildren<QPushButton*>())
    if (button->isDefault()) return button->text().remove('&');
  return {};
}

/// Does it with the dialog that opens meanwhile.
void in_dialog(Desk& desk, const std::function<void(QDialog&)>& act) {
  QTimer::singleShot(500, desk.window.get(), [act] {
    auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) throw std::runtime_error("no dialog");
    dialog->activateWindow();
    (void)QTest::qWaitForWindowActive(dialog);
    act(*dialog);
  });
}

TEST(FormKeys, EnterInTheLibraryTakesTheMaterial) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms")));
  desk.click_stage("material: block");
  in_dialog(desk, [](QDialog& dialog) {
    auto* filter = dialog.findChild<QLineEdit*>("library_filter");
    filter->setFocus();
    QTest::keyClicks(filter, "soda");
    EXPECT_EQ(default_button(dialog), "Take these values");
    QTest::keyClick(filter, Qt::Key_Return);
  });
  desk.click("from_library");
  EXPECT_EQ(desk.window->document().value("joint[0].energy_mode_1"), "\"8 J/m2\"");
}

TEST(FormKeys, EnterInAFieldOfAFunctionTakesTheFunctionAndRemovesNoPart) {
  Desk desk;
  const QByteArray text = block_case(1, "1 ms") + R"([[stage.constraint]]
group = "block"
velocity = { x = { constant = "1 m/s", linear = "5 m/s2" } }
)";
  desk.window->open_path(written_case(desk.scratch, text));
  desk.click_stage("constraint");
  desk.click("function:stage[0].constraint[0].velocity");
  auto* dialog = desk.find<QDialog>("function_dialog");
  ASSERT_TRUE(QTest::qWaitForWindowActive(dialog));
  EXPECT_EQ(default_button(*dialog), "OK");
  QLineEdit* first = nullptr;
  for (auto* line : dialog->findChildren<QLineEdit*>())
    if (first == nullptr && line->objectName().startsWith("number:")) first = line;
  ASSERT_NE(first, nullptr);
  first->setFocus();
  first->selectAll();
  QTest::keyClicks(first, "3");
  QTest::keyClick(first, Qt::Key_Return);
  EXPECT_FALSE(dialog->isVisible());
  const QString value = desk.window->document().value("stage[0].constraint[0].velocity");
  EXPECT_TRUE(value.contains("3") && value.contains("5 m/s2")) << value.toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::form_keys_test
