#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <QComboBox>
#include <QSlider>
#include <QSpinBox>
#include <fcntl.h>

#include "gui/answer.hpp"
#include "gui/run_desk.hpp"

// What is seen in the first minutes: of the first run while it goes on and in its end, and of runs of other cases.

namespace breccia::gui::test::first_minutes_test {
namespace {

constexpr Colouring kSizes = colouring_by(Quantity::fragment_size);

TEST(FirstMinutes, CracksAreBrokenJointsAndThoseThatHoldAreSeenOnRequest) {
  RunDesk desk(turning_case("200 us"));
  auto* least = desk.find<QComboBox>("joints_damage");
  EXPECT_EQ(least->currentText(), "broken");
  const auto cracks = desk.scene().num_joints();
  ASSERT_GT(cracks, 0);
  EXPECT_EQ(cracks, desk.scene().num_broken());
  vtkIdType before = cracks;
  for (int row = 1; row < least->count(); ++row) {
    least->setCurrentIndex(row);
    EXPECT_GE(desk.scene().num_joints(), before) << least->currentText().toStdString();
    before = desk.scene().num_joints();
  }
  EXPECT_GT(before, cracks);
  least->setCurrentIndex(0);
  EXPECT_EQ(desk.scene().num_joints(), cracks);
}

TEST(FirstMinutes, TheLastPictureOfARunIsOfItsFragmentsBySizeUnlessAColourIsChosen) {
  Desk desk;
  View3D& view = desk.window->view();
  desk.window->open_path(written_case(desk.scratch, turning_case("1 ms")));
  ASSERT_TRUE(wait_until([&] { return view.scene().has_data() && !desk.window->busy(); }, kSolver));
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.click_stage("Run");
  desk.click("run");
  SolverRun* run = desk.window->run();
  ASSERT_NE(run, nullptr);
  ASSERT_TRUE(wait_until([&] { return run->frames().size() > 1 || !run->alive(); }, kSolver));
  if (run->alive()) {
    EXPECT_EQ(view.scene().colouring(), Colouring::group);
  }
  ASSERT_TRUE(wait_until([&] { return run->state() == "complete" && !desk.window->busy(); }, kSolver));
  ASSERT_TRUE(wait_until([&] { return view.scene().colouring() == kSizes; }, kSolver));
  const auto [least, largest] = view.scene().range();
  EXPECT_GT(largest, least) << "fragments of several sizes";
  desk.click_stage("material: block");
  EXPECT_EQ(view.scene().colouring(), Colouring::group) << "the mesh at rest has colours of its own";
  desk.click_stage("Results");
  EXPECT_EQ(view.scene().colouring(), kSizes);
  auto* colour = desk.find<QComboBox>("colour_by");
  colour->setFocus();
  QTest::keyClick(colour, Qt::Key_Down);
  const Colouring chosen = view.scene().colouring();
  EXPECT_NE(chosen, kSizes);
  QTest::keyClick(desk.find<QSlider>("frame"), Qt::Key_Left);
  ASSERT_TRUE(wait_until([&] { return !desk.window->busy(); }, kSolver));
  EXPECT_EQ(view.scene().colouring(), chosen);
}

/// A cube of 20 mm: the sphere of its volume has a diameter of 20 mm cbrt(6 / pi).
TEST(FirstMinutes, ABodyThatIsWholeHasTheSizeOfTheSphereOfItsVolume) {
  RunDesk desk(pulled_block());
  EXPECT_EQ(desk.scene().colouring(), Colouring::group) << "nothing is broken";
  desk.window->view().set_colouring(kSizes);
  EXPECT_NEAR(desk.scene().range()[1], 20 * std::cbrt(6 / M_PI), 0.1);
}

TEST(FirstMinutes, ABlockAtRestHasNoColoursOfRoundingErrors) {
  RunDesk desk(block_case(2, "20 us") + "[[stage.constraint]]\ngroup = \"block.x0\"\nfixed = \"xyz\"\n");
  for (int i = static_cast<int>(Quantity::speed); i < kNumQuantities; ++i) {
    desk.window->view().set_colouring(colouring_by(static_cast<Quantity>(i)));
    EXPECT_EQ(desk.scene().range(), (std::array<double, 2>{0, 1})) << title_of(static_cast<Quantity>(i));
  }
}

TEST(FirstMinutes, ANewCaseOpensInTheColoursOfItsGroups) {
  RunDesk desk(turning_case("100 us"));
  desk.window->view().set_colouring(colouring_by(Quantity::von_mises));
  desk.scene().set_colour_range({1, 2});
  QFile other(desk.scratch.filePath("other.toml"));
  ASSERT_TRUE(other.open(QIODevice::WriteOnly) && other.write(block_case(3, "1 ms")) > 0);
  other.close();
  desk.window->open_path(other.fileName());
  EXPECT_EQ(desk.scene().colouring(), Colouring::group);
  desk.window->view().set_colouring(colouring_by(Quantity::von_mises));
  EXPECT_EQ(desk.scene().colour_range(), ColourRange{});
}

/// The folder of a run that goes on, as this process has its lock, with the joints of its first frame alone.
struct BegunRun {
  QString folder;
  int lock = -1;

  BegunRun(const QTemporaryDir& scratch, const QByteArray& text) : folder(scratch.filePath("begun")) {
    QDir().mkpath(folder + "/frames");
    const auto write = [&](const QString& name, const QByteArray& content) {
      QFile out(QDir(folder).filePath(name));
      EXPECT_TRUE(out.open(QIODevice::WriteOnly) && out.write(content) == content.size());
    };
    write("provenance.json", R"({"program": "breccia"})");
    write("case.toml", text);
    write("frames/joints_0.hdf", "joints");
    write("frames/joints.hdf.series", R"({"files": [{"name": "joints_0.hdf", "time": 0}]})");
    lock = ::open(QFile::encodeName(folder + "/run.lock").constData(), O_RDWR | O_CREAT, 0600);
    EXPECT_EQ(::flock(lock, LOCK_EX), 0);
  }
  ~BegunRun() { ::close(lock); }
};

TEST(FirstMinutes, ARunWhoseFirstFrameIsStillToComeIsWaitedFor) {
  Desk desk;
  const BegunRun run(desk.scratch, turning_case("1 ms"));
  desk.window->open_path(run.folder);
  ASSERT_TRUE(desk.window->run()->alive());
  EXPECT_EQ(desk.window->view().caption(), "waiting for the first frame...");
}

TEST(FirstMinutes, ARunWhoseFramesWillHaveNoElementsSaysSo) {
  Desk desk;
  const BegunRun run(desk.scratch, turning_case("1 ms") + "elements = false\n");
  desk.window->open_path(run.folder);
  ASSERT_TRUE(desk.window->run()->alive());
  EXPECT_TRUE(desk.window->view().caption().contains("no elements")) << desk.window->view().caption().toStdString();
}

/// A desktop with the case "mine" open, and a run of another one, of which the table of runs knows.
struct TwoCases : Desk {
  QString mine, other, run;
  TwoCases() {
    const auto write = [&](const QString& name, const QByteArray& text) {
      QDir().mkpath(scratch.filePath(name));
      QFile out(scratch.filePath(name + "/case.toml"));
      EXPECT_TRUE(out.open(QIODevice::WriteOnly) && out.write(text) == text.size());
      return out.fileName();
    };
    mine = write("mine", block_case(1, "1 ms"));
    other = write("other", turning_case("100 us"));
    run = scratch.filePath("elsewhere");
    EXPECT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", other, "-o", run, "--progress", "none"}), 0);
    window->open_path(mine);
  }
};

TEST(FirstMinutes, ARunOfAnotherCaseIsShownWithItsOwnCase) {
  TwoCases desk;
  desk.window->open_path(desk.run);
  EXPECT_EQ(desk.window->document().file(), desk.other);
  EXPECT_EQ(desk.window->run()->record().folder, desk.run);
  ASSERT_TRUE(wait_until([&] { return desk.window->view().caption().startsWith("time "); }, kSolver));
  EXPECT_TRUE(desk.window->windowTitle().contains("other")) << desk.window->windowTitle().toStdString();
}

TEST(FirstMinutes, ACaseWithEditsIsNotLeftUnaskedForARunOfAnother) {
  TwoCases desk;
  desk.window->document().set_value("title", "\"edited\"");
  {
    const Answer cancel(QMessageBox::Cancel);
    desk.window->open_path(desk.run);
    EXPECT_TRUE(cancel.words().join(' ').contains("Save the edits"));
  }
  EXPECT_EQ(desk.window->document().file(), desk.mine);
  EXPECT_EQ(desk.window->run(), nullptr) << "nor are results of another shown beside it";
  const Answer leave(QMessageBox::Discard);
  desk.window->open_path(desk.run);
  EXPECT_EQ(desk.window->document().file(), desk.other);
}

TEST(FirstMinutes, ARunWhoseCaseIsNoMoreIsShownWithTheCopyInItsFolder) {
  TwoCases desk;
  ASSERT_TRUE(QFile::remove(desk.other));
  desk.window->open_path(desk.run);
  EXPECT_EQ(desk.window->document().file(), desk.run + "/case.toml");
}

TEST(FirstMinutes, ARunOfTheOpenCaseLeavesItAsItIsEdited) {
  RunDesk desk(turning_case("100 us"));
  const QString file = desk.window->document().file();
  EXPECT_EQ(file, desk.scratch.filePath("case.toml")) << "the case itself, not the copy in the folder of the run";
  desk.window->document().set_value("title", "\"edited\"");
  desk.window->open_path(desk.run);
  EXPECT_EQ(desk.window->document().file(), file);
  EXPECT_EQ(desk.window->document().value("title"), "\"edited\"");
}

}  // namespace
}  // namespace breccia::gui::test::first_minutes_test
