#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QToolButton>

#include "gui/desk.hpp"
#include "widgets/joint_plot.hpp"

namespace breccia::gui::test::problems_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

const QByteArray kLoads = R"(absorbing = ["block.x0"]
[[stage.pressure]]
surface = "block.y1"
value = "1 MPa"
)";

void open_loads(Desk& desk) {
  desk.window->open_path(written_case(desk.scratch, block_case(2, "1 ms") + kLoads));
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data() && !desk.window->busy(); }, kSolver));
  ASSERT_EQ(desk.find<QListWidget>("problems")->count(), 0);
}

TEST(Problems, AGroupThatTheMeshHasNotIsMarkedCountedAndLeadsToItsField) {
  Desk desk;
  open_loads(desk);
  desk.click_stage("pressure");
  desk.type("field:stage[0].pressure[0].surface", "block.top");
  auto* problems = desk.find<QListWidget>("problems");
  ASSERT_TRUE(wait_until([&] { return problems->count() == 1; }, 5000)) << "only the run would have said it";
  EXPECT_TRUE(problems->item(0)->text().contains("block.top"));
  EXPECT_TRUE(problems->item(0)->text().contains("surface of pressure block.top: ")) << "in words";
  EXPECT_EQ(problems->item(0)->toolTip(), "stage[0].pressure[0].surface") << "as in the text";
  EXPECT_TRUE(desk.find<QLabel>("mark:stage[0].pressure[0].surface")->isVisible());
  EXPECT_TRUE(desk.find<QAbstractButton>("run")->text().contains("1 problem"));
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  EXPECT_EQ(desk.window->run(), nullptr);
  desk.click_stage("Materials");
  QTest::keyClick(desk.window.get(), Qt::Key_F8);
  ASSERT_TRUE(desk.find<QWidget>("field:stage[0].pressure[0].surface")->isVisible());
  EXPECT_TRUE(desk.find<QWidget>("field:stage[0].pressure[0].surface")->hasFocus());
  desk.type("field:stage[0].pressure[0].surface", "block.y0");
  EXPECT_TRUE(wait_until([&] { return problems->count() == 0; }, 5000)) << "what is solved is still told";
}

TEST(Problems, WhatOnlyTheSolverFindsIsMarkedUntilItIsEdited) {
  Desk desk;
  open_loads(desk);
  QFile broken(desk.scratch.filePath("broken.geo"));
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
  broken.write("Box(1) = {;\n");
  broken.close();
  desk.window->document().remove("mesh.raster");
  desk.window->document().set_value("mesh.file", "\"broken.geo\"");
  auto* problems = desk.find<QListWidget>("problems");
  ASSERT_TRUE(wait_until([&] { return problems->count() > 0 && !desk.window->busy(); }, kSolver));
  EXPECT_FALSE(desk.find<QAbstractButton>("run")->isEnabled());
  desk.click_stage("mesh");
  EXPECT_TRUE(desk.find<QLabel>("mark:mesh.file")->isVisible()) << problems->item(0)->text().toStdString();
  desk.window->document().undo_stack().undo();
  desk.window->document().undo_stack().undo();
  EXPECT_TRUE(wait_until([&] { return problems->count() == 0; }, kSolver)) << problems->item(0)->text().toStdString();
}

TEST(Problems, AnEntryThatIsAddedIsOfAGroupOfTheMeshAndItsQuantitiesAreLeftToTheUser) {
  Desk desk;
  open_loads(desk);
  desk.click_stage("pressure");
  auto* menu = desk.find<QToolButton>("add_entry")->menu();
  emit menu->aboutToShow();
  for (QAction* action : menu->actions())
    if (action->text() == "stage[0].pressure") action->trigger();
  const Document& document = desk.window->document();
  EXPECT_EQ(document.value("stage[0].pressure[1].surface"), "\"block.x0\"");
  EXPECT_EQ(document.value("stage[0].pressure[1].value"), "");
  EXPECT_TRUE(wait_until([&] { return desk.find<QLabel>("mark:stage[0].pressure[1].value")->isVisible(); }, 5000));
}

TEST(Problems, APickAddsASurfaceToAListAndAMeshFileIsChosenAmongFiles) {
  Desk desk;
  open_loads(desk);
  desk.click_stage("stage");
  EXPECT_NE(desk.window->findChild<QToolButton*>("pick:stage[0].broken"), nullptr);
  desk.click("pick:stage[0].absorbing");
  QTest::mouseClick(desk.find<QWidget>("canvas"), Qt::LeftButton, {}, desk.place_of("block.z1"));
  EXPECT_EQ(desk.window->document().value("stage[0].absorbing"), R"(["block.x0", "block.z1"])");
  desk.click("pick:stage[0].absorbing");
  const QString file = desk.scratch.filePath("part.geo");
  QFile out(file);
  ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  out.close();
  desk.click_stage("mesh");
  desk.click_and_name("browse:mesh.file", file);
  EXPECT_EQ(desk.window->document().value("mesh.file"), "\"part.geo\"");
}

TEST(Problems, AGroupThatIsChosenForAnEntryOfSeveralJoinsThemAndForOneOfOneTakesItsPlace) {
  Desk desk;
  open_loads(desk);
  desk.click_stage("pressure");
  const Document& document = desk.window->document();
  const QString path = "stage[0].pressure[0].surface";
  auto* box = desk.find<QComboBox>("field:" + path);
  const auto choose = [&](const char* group) {
    box->showPopup();
    box->view()->setCurrentIndex(box->model()->index(box->findText(group), 0));
    QTest::keyClick(box->view(), Qt::Key_Return);
  };
  choose("block.z1");
  EXPECT_EQ(document.value(path), R"("block.z1")");
  desk.type("field:" + path, "block.z1, block.z0");
  EXPECT_EQ(document.value(path), R"(["block.z1", "block.z0"])");
  choose("block.y0");
  choose("block.z0");
  EXPECT_EQ(document.value(path), R"(["block.z1", "block.z0", "block.y0"])");
  EXPECT_EQ(box->currentText(), "block.z1, block.z0, block.y0");
}

TEST(Problems, ALawWithoutCurvesSaysWhyItHasNone) {
  Desk desk;
  open_loads(desk);
  auto* plot = desk.find<JointPlot>("joint_plot");
  const auto says = [&](const char* words) { return plot->accessibleDescription().contains(words); };
  desk.click_stage("joint: block");
  EXPECT_TRUE(says("works out")) << plot->accessibleDescription().toStdString();
  ASSERT_TRUE(wait_until([&] { return plot->num_points() > 0; }, kSolver));
  desk.click_stage("material: block");
  desk.type("field:material[0].young", "1 apple");
  desk.window->document().set_value("joint[0].group", "\"stone\"");
  desk.click_stage("joint: stone");
  EXPECT_TRUE(wait_until([&] { return says("problems"); }, 5000)) << plot->accessibleDescription().toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::problems_test
