#include <gtest/gtest.h>

#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QSpinBox>
#include <QTextBlock>

#include "gui/desk.hpp"

namespace breccia::gui::test::keys_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

void open_block(Desk& desk) {
  desk.window->open_path(written_case(desk.scratch, turning_case("1 ms")));
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data() && !desk.window->busy(); }, kSolver));
}

/// Name of the dock in which a widget stands; "view" in none.
QString dock_of(const QWidget* widget) {
  for (; widget != nullptr; widget = widget->parentWidget())
    if (qobject_cast<const QDockWidget*>(widget) != nullptr) return widget->objectName();
  return "view";
}

/// Whether its middle lies in the window: a dock behind others is put outside of it.
bool is_inside(const Desk& desk, const QWidget& widget) {
  const QWidget* dock = &widget;
  while (dock->parentWidget() != desk.window.get()) dock = dock->parentWidget();
  return desk.window->rect().contains(dock->mapTo(desk.window.get(), dock->rect().center()));
}

TEST(Keys, TabGoesFromTheStagesToTheFormTheViewAndTheDockInFrontAndTypesNothingOutOfSight) {
  Desk desk;
  open_block(desk);
  desk.click_stage("material: block");
  desk.show_tab("Messages");
  desk.find<QWidget>("stages")->setFocus();
  const int cores = desk.find<QSpinBox>("queue_cores")->value();
  QStringList docks;
  for (int i = 0; i < 150; ++i) {
    QWidget* now = QApplication::focusWidget();
    ASSERT_NE(now, nullptr);
    if (docks.isEmpty() || docks.back() != dock_of(now)) docks << dock_of(now);
    EXPECT_TRUE(is_inside(desk, *now)) << now->objectName().toStdString();
    if (docks.size() > 1 && dock_of(now) == "dock_stages") break;  // all around
    QTest::keyClick(now, Qt::Key_Tab);
  }
  // The tabs of the docks belong to none of them.
  EXPECT_EQ(docks, QStringList({"dock_stages", "dock_properties", "view", "dock_messages", "dock_stages"}));
  EXPECT_EQ(desk.find<QSpinBox>("queue_cores")->value(), cores);
  desk.find<QWidget>("stages")->setFocus();
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Backtab, Qt::ShiftModifier);
  EXPECT_EQ(dock_of(QApplication::focusWidget()), "dock_messages") << "and back";
}

TEST(Keys, AnOpenedCaseHasTheCursorInItsStages) {
  Desk desk;
  open_block(desk);
  EXPECT_EQ(QApplication::focusWidget(), desk.find<QWidget>("stages"));
}

/// The letter that Alt opens or clicks something by.
QChar letter_of(const QString& text) {
  const QString plain = QString(text).remove("&&");
  const auto at = plain.indexOf('&');
  return at < 0 || at + 1 == plain.size() ? QChar() : plain[at + 1].toUpper();
}

TEST(Keys, NoLetterThatOpensAMenuIsThatOfAButtonOrField) {
  Desk desk;
  open_block(desk);
  QString menus;
  for (const QAction* action : desk.window->menuBar()->actions()) menus += letter_of(action->text());
  EXPECT_EQ(menus.size(), 6);
  const auto check = [&](const QString& text) { EXPECT_FALSE(menus.contains(letter_of(text))) << text.toStdString(); };
  for (const auto* button : desk.window->findChildren<QAbstractButton*>()) check(button->text());
  for (const auto* label : desk.window->findChildren<QLabel*>())
    if (label->buddy() != nullptr) check(label->text());
}

TEST(Keys, UndoAndRedoInAFieldAreThoseOfTheCaseOnceNothingIsTypedThere) {
  Desk desk;
  open_block(desk);
  const Document& document = desk.window->document();
  desk.click_stage("material: block");
  desk.type("field:material[0].young", "60 GPa");
  EXPECT_EQ(document.value("material[0].young"), "\"60 GPa\"");
  auto* young = desk.find<QLineEdit>("field:material[0].young");
  ASSERT_NE(QApplication::focusWidget(), young);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document.value("material[0].young"), "\"40 GPa\"") << "in the field that follows";
  EXPECT_EQ(young->text(), "40 GPa");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(document.value("material[0].young"), "\"60 GPa\"");
  young->setFocus();
  QTest::keyClick(young, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document.value("material[0].young"), "\"40 GPa\"") << "in the field itself";
  EXPECT_EQ(young->text(), "40 GPa");
  QTest::keyClicks(young, "x");
  QTest::keyClick(young, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(young->text(), "40 GPa") << "what is being typed is taken back first";
  EXPECT_FALSE(desk.window->document().undo_stack().canUndo());
  QTest::keyClick(young, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(document.value("material[0].young"), "\"60 GPa\"");
  EXPECT_EQ(desk.window->document().undo_stack().undoText(), "set young of material: block");
}

TEST(Keys, TheTextStaysInFrontWhileOneTypesThere) {
  Desk desk;
  open_block(desk);
  desk.show_tab("Text");
  auto* text = desk.find<QPlainTextEdit>("case_text");
  text->setFocus();
  text->moveCursor(QTextCursor::Start);
  for (int i = 0; i < text->blockCount(); ++i) QTest::keyClick(text, Qt::Key_Down);
  text->moveCursor(QTextCursor::Start);
  while (!text->textCursor().block().text().startsWith("[[joint]]")) QTest::keyClick(text, Qt::Key_Down);
  QTest::keyClick(text, Qt::Key_Down);
  EXPECT_TRUE(desk.find<QWidget>("field:joint[0].tensile_strength")->isVisible()) << "the form follows the cursor";
  EXPECT_FALSE(desk.find<QWidget>("dock_text")->visibleRegion().isEmpty()) << "what is typed is not seen";
  QTest::keyClicks(text, "#new");
  EXPECT_TRUE(desk.window->document().text().contains("#new"));
}

}  // namespace
}  // namespace breccia::gui::test::keys_test
