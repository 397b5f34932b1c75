#include "widgets/paraview_results.hpp"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <set>

#include "gui/block_case.hpp"

namespace breccia::gui::test::paraview_results_test {
namespace {

void write(const QString& name, const QByteArray& text) {
  QFile file(name);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
}

QByteArray content(const QString& name) {
  QFile file(name);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

TEST(ParaViewResults, SettingsAreACopyOfTheUsersThatShowsNoWelcome) {
  const QTemporaryDir users;
  QDir(users.path()).mkdir("ParaView");
  write(users.filePath("ParaView/ParaView5.11.0.ini"), "[MainWindow]\nSize=1\n");
  EXPECT_EQ(paraview_settings(users.path(), "5.11.0"), users.filePath("breccia"));
  const QString own = users.filePath("breccia/ParaView/ParaView5.11.0.ini");
  EXPECT_TRUE(content(own).contains("Size=1"));
  EXPECT_TRUE(content(own).contains("ShowWelcomeDialog=false"));
  const QByteArray once = content(own);
  EXPECT_EQ(paraview_settings(users.path(), "5.11.0"), users.filePath("breccia"));
  EXPECT_EQ(content(own), once) << "said once";
  EXPECT_FALSE(content(users.filePath("ParaView/ParaView5.11.0.ini")).contains("Welcome")) << "the user's own stay";
}

/// ParaView opened an empty screen, whose readers had to be applied and coloured by hand.
TEST(ParaViewResults, TheScriptShowsARunInColours) {
  const QString python = QStandardPaths::findExecutable("pvpython");
  if (python.isEmpty()) GTEST_SKIP() << "there is no pvpython";
  const QTemporaryDir scratch;
  const QString file = written_case(scratch, turning_case("300 us")), run = scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
  const QString script = scratch.filePath("results.py"), picture = scratch.filePath("picture.png");
  write(script, ParaViewResults::script() + R"(
from paraview.simple import GetActiveView, GetSources, SaveScreenshot
for (name, number), source in GetSources().items():
    print("source", name)
SaveScreenshot(os.environ["PICTURE"], GetActiveView(), ImageResolution=[800, 600])
)");
  QProcess paraview;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("BRECCIA_RESULTS", run);
  environment.insert("BRECCIA_RESULTS_UP", "z");
  environment.insert("PICTURE", picture);
  paraview.setProcessEnvironment(environment);
  paraview.setProcessChannelMode(QProcess::MergedChannels);
  paraview.start(python, {script});
  ASSERT_TRUE(paraview.waitForFinished(240000));
  const QByteArray said = paraview.readAll();
  ASSERT_EQ(paraview.exitCode(), 0) << said.toStdString();
  EXPECT_TRUE(said.contains("source von Mises stress")) << said.toStdString();
  EXPECT_TRUE(said.contains("source time of failure"));
  const QImage image(picture);
  ASSERT_FALSE(image.isNull());
  if (qEnvironmentVariableIsSet("BRECCIA_SCREENSHOTS"))
    image.save(QDir(qEnvironmentVariable("BRECCIA_SCREENSHOTS")).filePath("paraview.png"));
  std::set<QRgb> colours;  // of the middle, where the block is
  for (int y = image.height() / 4; y < 3 * image.height() / 4; ++y)
    for (int x = image.width() / 4; x < 3 * image.width() / 4; ++x) colours.insert(image.pixel(x, y));
  EXPECT_GT(colours.size(), 100U) << "stresses differ from element to element";
}

}  // namespace
}  // namespace breccia::gui::test::paraview_results_test
