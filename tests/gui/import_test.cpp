#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QInputDialog>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>

#include "gui/desk.hpp"

namespace breccia::gui::test::import_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

/// A box of 60 x 20 x 10 as STL; `sides` of its six.
QByteArray stl_box(int sides) {
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  constexpr int kSize[3] = {60, 20, 10};
  QByteArray text = "solid slab\n";
  for (int f = 0; f < sides; ++f)
    for (const int half : {0, 1}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : {0, 1 + half, 2 + half}) {
        text += "vertex";
        for (int a = 0; a < 3; ++a) text += " " + QByteArray::number((kFaces[f][corner] >> a & 1) != 0 ? kSize[a] : 0);
        text += "\n";
      }
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid slab\n";
}

QString written(const Desk& desk, const QString& name, const QByteArray& text) {
  QFile out(desk.scratch.filePath(name));
  EXPECT_TRUE(out.open(QIODevice::WriteOnly) && out.write(text) == text.size());
  return out.fileName();
}

TEST(Import, AnStlBecomesACaseInMillimetresWhichTheSolverMeshes) {
  Desk desk;
  const QString file = written(desk, "slab.stl", stl_box(6));
  QString question;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, desk.window.get(), [&] {
    auto* dialog = desk.window->findChild<QInputDialog*>();
    if (dialog == nullptr) return;
    answer.stop();
    question = dialog->labelText() + "\n" + dialog->comboBoxItems().join('\n');
    desk.picture("import", dialog);
    QTest::keyClick(dialog, Qt::Key_Return);
  });
  desk.click_and_name("import_geometry", file);
  answer.start(100);
  ASSERT_TRUE(wait_until([&] { return desk.window->document().is_open(); }, kSolver));
  EXPECT_TRUE(question.contains("60 x 20 x 10")) << question.toStdString();
  EXPECT_TRUE(question.contains("millimetre: 0.06 x 0.02 x 0.01 m")) << question.toStdString();
  const Document& document = desk.window->document();
  EXPECT_EQ(document.value("mesh.scale"), "0.001");
  EXPECT_EQ(document.value("material[0].group"), "\"slab\"");
  EXPECT_TRUE(document.problems().empty());
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
  EXPECT_EQ(desk.window->view().scene().groups(), std::vector<std::string>{"slab"});
  const auto coarse = desk.window->view().scene().num_faces();
  desk.click_stage("mesh");
  desk.type("field:mesh.size", "1.5 mm");
  ASSERT_EQ(document.value("mesh.size"), "\"1.5 mm\"");
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().num_faces() > coarse; }, kSolver));
  desk.picture("imported");
}

TEST(Import, AMeshOfAnotherProgramBecomesACaseWithItsGroups) {
  Desk desk;
  const QString file = written(desk, "wedge.inp",
                               "*NODE\n1, 0, 0, 0\n2, 30, 0, 0\n3, 0, 30, 0\n4, 0, 0, 30\n5, 30, 30, 30\n"
                               "*ELEMENT, TYPE=C3D4, ELSET=wedge\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n");
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, desk.window.get(), [&] {
    auto* dialog = desk.window->findChild<QInputDialog*>();
    if (dialog == nullptr) return;
    answer.stop();
    QTest::keyClick(dialog, Qt::Key_Return);
  });
  desk.click_and_name("import_geometry", file);
  answer.start(100);
  ASSERT_TRUE(wait_until([&] { return desk.window->document().is_open(); }, kSolver));
  const Document& document = desk.window->document();
  EXPECT_EQ(document.value("mesh.file"), "\"wedge.inp\"");
  EXPECT_EQ(document.value("mesh.scale"), "0.001");
  EXPECT_EQ(document.value("material[0].group"), "\"wedge\"");
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
}

TEST(Import, AnOpenStlIsRefusedInTheSolversWords) {
  Desk desk;
  const QString file = written(desk, "open.stl", stl_box(5));
  QString told;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, desk.window.get(), [&] {
    auto* box = desk.window->findChild<QMessageBox*>();
    if (box == nullptr) return;
    answer.stop();
    told = box->text();
    QTest::keyClick(box, Qt::Key_Return);
  });
  desk.click_and_name("import_geometry", file);
  answer.start(100);
  ASSERT_TRUE(wait_until([&] { return !told.isEmpty(); }, kSolver));
  EXPECT_TRUE(told.contains("the surface is open: 4 edges belong to one triangle only")) << told.toStdString();
  EXPECT_FALSE(desk.window->document().is_open());
}

}  // namespace
}  // namespace breccia::gui::test::import_test
