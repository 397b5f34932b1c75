#include <gtest/gtest.h>

#include <QDesktopServices>
#include <QFile>
#include <QTextBrowser>
#include <QUrl>

#include "gui/desk.hpp"
#include "gui/everything_case.hpp"

// F1, and the fields that a form shows first.

namespace breccia::gui::test::guide_test {
namespace {

/// The program, installed with a guide of empty pages.
struct InstalledGuide {
  QTemporaryDir root;
  QTextBrowser browser;  ///< in the place of the user's

  InstalledGuide() {
    for (const char* folder : {"bin", "share/doc/breccia/guide/guide"}) QDir(root.path()).mkpath(folder);
    QFile::copy(BRECCIA_PROGRAM, root.filePath("bin/breccia"));
    for (const char* page : {"index", "guide/02-geometry-and-mesh", "guide/03-materials-and-joints",
                             "guide/04-contact-and-friction", "guide/05-loads-and-stages", "guide/08-results"})
      (void)QFile(root.filePath("share/doc/breccia/guide/" + QString(page) + ".html")).open(QIODevice::WriteOnly);
    qputenv("BRECCIA_PROGRAM", root.filePath("bin/breccia").toUtf8());
    QDesktopServices::setUrlHandler("file", &browser, "setSource");
  }
  ~InstalledGuide() {
    QDesktopServices::unsetUrlHandler("file");
    qunsetenv("BRECCIA_PROGRAM");
  }
  [[nodiscard]] QString page() const { return browser.source().fileName(); }
};

TEST(Guide, F1OpensThePageOfTheForm) {
  InstalledGuide guide;
  Desk desk;
  QTest::keyClick(desk.window.get(), Qt::Key_F1);
  EXPECT_TRUE(wait_until([&] { return guide.page() == "index.html"; }, 5000)) << guide.page().toStdString();
  desk.window->open_path(everything(desk.scratch));
  for (const auto& [line, page] :
       std::initializer_list<std::pair<QString, QString>>{{"mesh", "02-geometry-and-mesh.html"},
                                                          {"material: ", "03-materials-and-joints.html"},
                                                          {"contact: ", "04-contact-and-friction.html"},
                                                          {"pressure: ", "05-loads-and-stages.html"},
                                                          {"output", "08-results.html"}}) {
    desk.click_stage(line);
    QTest::keyClick(desk.window.get(), Qt::Key_F1);
    EXPECT_TRUE(wait_until([&] { return guide.page() == page; }, 5000))
        << line.toStdString() << ": " << guide.page().toStdString();
  }
}

TEST(Guide, AFormShowsTheKeysThatMostCasesNeedFirst) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, R"([mesh]
file = "none.msh"
time_limit = "1 h"
[[material]]
group = "glass"
)"));
  desk.click_stage("mesh");
  const auto seen = [&](const char* key) { return desk.find<QWidget>(QString("field:mesh.") + key)->isVisible(); };
  EXPECT_TRUE(seen("file"));
  EXPECT_TRUE(seen("time_limit")) << "is in the case";
  EXPECT_FALSE(seen("merge_nodes"));
  desk.picture("folded");
  desk.click("expert_keys");
  EXPECT_TRUE(seen("merge_nodes"));
  desk.click_stage("material: glass");
  EXPECT_TRUE(desk.find<QWidget>("field:material[0].viscosity")->isVisible()) << "the choice holds for the next form";
  desk.picture("unfolded");
}

}  // namespace
}  // namespace breccia::gui::test::guide_test
