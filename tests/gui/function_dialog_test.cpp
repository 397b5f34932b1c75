#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QClipboard>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTableWidget>

#include "gui/desk.hpp"
#include "widgets/function_dialog.hpp"

namespace breccia::gui::test::function_dialog_test {
namespace {

constexpr const char* kPressure = "stage[0].pressure[0].value";

QByteArray pressed(const QByteArray& value) {
  return block_case(2, "1 ms") + "[[stage.pressure]]\nsurface = \"block.x1\"\nvalue = " + value +
         "  # mine\n[[stage]]\nend = \"2 ms\"\n";
}

/// The dialog that the button of a field opens.
struct Opened {
  Desk desk;
  FunctionDialog* dialog = nullptr;

  explicit Opened(const QByteArray& text, const QString& stage = "pressure", const QString& path = kPressure) {
    desk.window->open_path(written_case(desk.scratch, text));
    desk.click_stage(stage);
    desk.click("function:" + path);
    dialog = desk.window->findChild<FunctionDialog*>();
    if (dialog == nullptr) throw std::runtime_error("no dialog");
    (void)QTest::qWaitForWindowExposed(dialog);
  }

  template <class Widget>
  Widget* find(const QString& name) {
    auto* found = dialog->findChild<Widget*>(name);
    if (found == nullptr) throw std::runtime_error("no widget " + name.toStdString());
    return found;
  }

  /// As with the arrow keys of the list.
  void choose(const QString& list, const QString& words) {
    auto* box = find<QComboBox>(list);
    box->setCurrentIndex(box->findText(words));
    emit box->activated(box->currentIndex());
    QTest::qWait(1);  // what was there before is gone
  }

  void type(const QString& path, const QString& text) {
    auto* line = find<QLineEdit>("number:" + path);
    line->setFocus();
    line->selectAll();
    QTest::keyClicks(line, text);
    emit line->editingFinished();
  }

  void accept() { dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->click(); }
};

TEST(FunctionDialog, AConstantBecomesARampThatIsDrawnOverTheRunWithTheEndsOfItsStages) {
  Opened opened(pressed("\"8 MPa\""));
  opened.choose("function_kind", words_of_kind("ramp"));
  opened.type(QString(kPressure) + ".ramp.end", "400 us");
  auto* chart = opened.find<LineChart>("function_chart");
  ASSERT_EQ(chart->lines().size(), 1U);
  EXPECT_EQ(chart->lines()[0].y.back(), 8e6);
  EXPECT_EQ(chart->lines()[0].x.back(), 2e-3) << "the end of the run";
  EXPECT_EQ(chart->y_title(), "Value [MPa]");
  ASSERT_EQ(chart->marks().size(), 2U);
  EXPECT_EQ(chart->marks()[0].at, 1e-3);
  opened.desk.picture("function_ramp", opened.dialog);
  opened.accept();
  Document& document = opened.desk.window->document();
  EXPECT_EQ(document.text(), pressed("{ ramp = { to = \"8 MPa\", end = \"400 us\" } }"));
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), pressed("\"8 MPa\""));
}

TEST(FunctionDialog, AMistakeIsToldInTheWordsOfTheSolver) {
  Opened opened(pressed("{ linear = \"20 GPa/s\" }"));
  auto* words = opened.find<QLabel>("function_problem");
  EXPECT_EQ(words->text(), "");
  opened.type(QString(kPressure) + ".linear", "20 GPa");
  EXPECT_TRUE(words->text().contains("is of dimension pressure, not pressure rate")) << words->text().toStdString();
  EXPECT_TRUE(opened.find<LineChart>("function_chart")->lines().empty());
  opened.dialog->reject();
  EXPECT_FALSE(opened.desk.window->document().modified()) << "as it was";
}

TEST(FunctionDialog, ATableGetsPointsLosesThemAndIsPasted) {
  Opened opened(pressed("{ table = [[0, 0], [\"1 ms\", \"1 MPa\"]] }"));
  ASSERT_EQ(opened.find<QTableWidget>("points")->rowCount(), 2);
  opened.find<QTableWidget>("points")->item(1, 1)->setText("3 MPa");
  EXPECT_EQ(opened.find<LineChart>("function_chart")->lines()[0].y.back(), 3e6);
  opened.find<QAbstractButton>("point_add")->click();
  QTest::qWait(1);
  ASSERT_EQ(opened.find<QTableWidget>("points")->rowCount(), 3);
  EXPECT_TRUE(opened.find<QLabel>("function_problem")->text().contains("not later than that of the point before"));
  opened.find<QAbstractButton>("point_remove")->click();
  QTest::qWait(1);
  QGuiApplication::clipboard()->setText("t [ms]\tp [MPa]\n0\t0\n0.2\t9\n0.5\t4\n1.4\t2\n");
  opened.find<QAbstractButton>("points_paste")->click();
  QTest::qWait(1);
  ASSERT_EQ(opened.find<QTableWidget>("points")->rowCount(), 4);
  opened.desk.picture("function_table", opened.dialog);
  opened.desk.window->set_dark(true);
  opened.desk.picture("function_table_dark", opened.dialog);
  opened.desk.window->set_dark(false);
  opened.accept();
  EXPECT_EQ(opened.desk.window->document().value(QString(kPressure) + ".table[1]"), "[\"0.2 ms\", \"9 MPa\"]");
  EXPECT_TRUE(opened.desk.window->document().problems().empty());
}

TEST(FunctionDialog, EachAxisHasItsOwnAndPartsAddUp) {
  const QByteArray begin = block_case(2, "1 ms") + "[[stage.constraint]]\ngroup = \"block\"\n";
  const QString path = "stage[0].constraint[0].velocity";
  Opened opened(begin + "velocity = { x = \"1 m/s\" }\n", "constraint", path);
  opened.choose("function_component", "z");
  EXPECT_EQ(opened.find<QComboBox>("function_kind")->currentText(), "not prescribed");
  opened.choose("function_kind", words_of_kind("linear"));
  opened.type(path + ".z.linear", "-1000 m/s2");
  for (QAction* action : opened.find<QPushButton>("function_add")->menu()->actions())
    if (action->objectName() == "add:sine") action->trigger();
  QTest::qWait(1);
  opened.type(path + ".z.sine.amplitude", "0.2 m/s");
  opened.type(path + ".z.sine.frequency", "5 kHz");
  opened.type(path + ".z.sine.phase", "90");
  EXPECT_EQ(opened.find<LineChart>("function_chart")->lines().size(), 2U);
  opened.desk.picture("function_sum", opened.dialog);
  opened.accept();
  EXPECT_EQ(opened.desk.window->document().text(),
            begin +
                "velocity = { x = \"1 m/s\", z = { linear = \"-1000 m/s2\", sine = { amplitude = \"0.2 m/s\", "
                "frequency = \"5 kHz\", phase = \"90 deg\" } } }\n");
}

TEST(FunctionDialog, EveryWidgetThatTakesTheFocusHasANameAndATooltip) {
  for (const char* value : {"1", "{ table = [[0, 0]] }", "{ sine = { amplitude = 1, frequency = 1 }, linear = 1 }"}) {
    Opened opened(pressed(value));
    for (const QWidget* widget : opened.dialog->findChildren<QWidget*>()) {
      if ((widget->focusPolicy() & Qt::TabFocus) == 0 || !widget->isVisible()) continue;
      const std::string who = std::string(widget->metaObject()->className()) + " " + widget->objectName().toStdString();
      EXPECT_FALSE(widget->accessibleName().isEmpty()) << who;
      EXPECT_FALSE(widget->toolTip().isEmpty()) << who;
    }
  }
}

}  // namespace
}  // namespace breccia::gui::test::function_dialog_test
