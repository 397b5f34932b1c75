#include "core/run_queue.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <QDir>
#include <QProcess>

#include "gui/block_case.hpp"
#include "gui/full_disk.hpp"

namespace breccia::gui::run_queue_test {
namespace {

using test::turning_case, test::wait_until, test::written_case;

const Launch kLaunch{BRECCIA_PROGRAM, BRECCIA_MPIEXEC};

/// A queue of its own, worked by this process where it calls look().
struct Bench {
  QTemporaryDir scratch;
  QString state = scratch.filePath("state");
  RunQueue queue{state};
  RunRegistry registry{state + "/runs.json"};
  QString file = written_case(scratch, turning_case("100 us"));

  RunWish wish(const QString& name, const QByteArray& end = "100 us", int ranks = 1) const {
    return {file, scratch.filePath("runs/" + name), turning_case(end), ranks, {}, {}};
  }
  void add(const std::vector<RunWish>& wishes) const { EXPECT_EQ(queue.add(kLaunch, wishes), QString()); }
  [[nodiscard]] QString states() const {
    QStringList words;
    for (const QueuedRun& run : queue.load().runs) words << run.words + " " + run.state;
    return words.join(", ");
  }
  [[nodiscard]] bool look_until(const QString& wanted) const {
    return wait_until(
        [&] {
          (void)queue.advance(registry);
          return states() == wanted;
        },
        60000);
  }
  void kill(const QString& name) const {
    for (const QueuedRun& run : queue.load().runs)
      if (run.words == name) signal_session(run.record.session, SIGKILL);
  }
  [[nodiscard]] int snapshots() const {
    return static_cast<int>(QDir(scratch.path()).entryList({".breccia-queued-*"}, QDir::Files | QDir::Hidden).size());
  }
};

TEST(RunQueue, ARunThatCannotBeWrittenIntoTheQueueIsToldAndNotStarted) {
  const Bench bench;
  QFile in_the_way(bench.state);
  ASSERT_TRUE(in_the_way.open(QIODevice::WriteOnly));
  EXPECT_TRUE(bench.queue.add(kLaunch, {bench.wish("one")}).contains(bench.state));
  in_the_way.remove();
  bench.add({bench.wish("one")});
  {
    const test::FullDisk full;
    EXPECT_FALSE(bench.queue.advance(bench.registry)) << "the next look would start it again";
  }
  EXPECT_EQ(bench.states(), "one waiting");
  EXPECT_FALSE(QFileInfo::exists(bench.scratch.filePath("runs/one.log")));
  EXPECT_TRUE(bench.look_until("one complete"));
}

TEST(RunQueue, RunsFollowEachOtherAndOneThatFailsDoesNotHoldUpTheOthers) {
  const Bench bench;
  bench.queue.set_cores(1);
  RunWish refused = bench.wish("refused"), unwritable = bench.wish("unwritable");
  refused.overrides << "material[0].young=-1";
  unwritable.folder = bench.file + "/runs/unwritable";
  bench.add({refused, unwritable, bench.wish("good", "1 ms"), bench.wish("killed", "10 s"), bench.wish("last")});
  EXPECT_EQ(bench.states(), "refused waiting, unwritable waiting, good waiting, killed waiting, last waiting");
  // A run that is refused ends within a hundredth of a second: it need not be seen running.
  ASSERT_TRUE(bench.look_until("refused failed, unwritable failed, good running, killed waiting, last waiting"));
  EXPECT_TRUE(bench.queue.load().runs[0].message.contains("material.block.young") ||
              bench.queue.load().runs[0].message.contains("material[0].young"))
      << bench.queue.load().runs[0].message.toStdString();
  EXPECT_TRUE(bench.queue.load().runs[1].message.contains("cannot be written"));
  ASSERT_TRUE(bench.look_until("refused failed, unwritable failed, good complete, killed running, last waiting"));
  ASSERT_TRUE(wait_until([&] { return is_run_folder(bench.scratch.filePath("runs/killed")); }, 60000));
  bench.kill("killed");
  ASSERT_TRUE(
      wait_until([&] { return !bench.queue.advance(bench.registry) && bench.states().endsWith("complete"); }, 60000))
      << bench.states().toStdString();
  EXPECT_EQ(bench.registry.load().size(), 3U) << "those that made a folder are found again";
  EXPECT_EQ(bench.snapshots(), 0);
  bench.queue.remove_ended();
  EXPECT_TRUE(bench.queue.load().runs.empty());
}

TEST(RunQueue, ARunThatIsStoppedBeforeItSaysAnythingIsStoppedAndHasNotFailed) {
  const Bench bench;
  bench.queue.set_cores(1);
  EXPECT_EQ(bench.queue.add({test::silent_program(bench.scratch), ""}, {bench.wish("killed"), bench.wish("asked")}),
            "");
  ASSERT_TRUE(bench.look_until("killed running, asked waiting"));
  bench.kill("killed");
  ASSERT_TRUE(bench.look_until("killed failed, asked running")) << "killed from elsewhere";
  bench.queue.note_stop(bench.scratch.filePath("runs/asked"));
  bench.kill("asked");
  ASSERT_TRUE(wait_until(
      [&] { return !bench.queue.advance(bench.registry) && bench.states() == "killed failed, asked stopped"; }, 60000))
      << bench.states().toStdString();
  EXPECT_EQ(bench.queue.load().runs[1].message, QString());
}

TEST(RunQueue, AsManyRunsGoOnAtATimeAsCoresAreFreeAndTheFirstAloneIfItWantsMore) {
  const Bench bench;
  bench.queue.set_cores(2);
  bench.add({bench.wish("a", "10 s"), bench.wish("b", "10 s"), bench.wish("c", "10 s", 3), bench.wish("d")});
  ASSERT_TRUE(bench.look_until("a running, b running, c waiting, d waiting"));
  bench.kill("a");
  ASSERT_TRUE(
      wait_until([&] { return bench.queue.advance(bench.registry) && !bench.states().contains("a running"); }, 10000));
  EXPECT_TRUE(bench.states().endsWith("b running, c waiting, d waiting")) << "d does not overtake c";
  bench.queue.hold(true);
  bench.kill("b");
  ASSERT_TRUE(wait_until([&] { return !bench.queue.advance(bench.registry); }, 10000));
  EXPECT_TRUE(bench.states().endsWith("c waiting, d waiting")) << "held";
  bench.queue.hold(false);
  (void)bench.queue.advance(bench.registry);
  EXPECT_TRUE(bench.states().endsWith("c running, d waiting")) << bench.states().toStdString();
  bench.queue.remove(bench.scratch.filePath("runs/c"));
  EXPECT_TRUE(bench.states().endsWith("c running, d waiting")) << "what runs is not forgotten";
  bench.kill("c");
}

TEST(RunQueue, WhatWaitsIsReorderedAndRemoved) {
  const Bench bench;
  bench.add({bench.wish("a"), bench.wish("b"), bench.wish("c")});
  bench.queue.move(bench.scratch.filePath("runs/c"), -1);
  EXPECT_EQ(bench.states(), "a waiting, c waiting, b waiting");
  bench.queue.move(bench.scratch.filePath("runs/a"), 5);
  EXPECT_EQ(bench.states(), "c waiting, b waiting, a waiting");
  EXPECT_EQ(bench.snapshots(), 1) << "of one text";
  bench.queue.remove(bench.scratch.filePath("runs/b"));
  bench.queue.remove(bench.scratch.filePath("runs/a"));
  EXPECT_EQ(bench.snapshots(), 1);
  bench.queue.remove(bench.scratch.filePath("runs/c"));
  EXPECT_EQ(bench.states(), "");
  EXPECT_EQ(bench.snapshots(), 0);
}

TEST(RunQueue, ARunReadsTheCaseAsItWasWhenItWasAdded) {
  const Bench bench;
  bench.add({bench.wish("a")});
  QFile(bench.file).remove();
  ASSERT_TRUE(bench.look_until("a complete")) << bench.states().toStdString();
  EXPECT_EQ(bench.queue.load().runs[0].record.case_file, bench.file);
}

TEST(RunQueue, AWorkerGoesOnWithoutAWindowAndIsTheOnlyOne) {
  const Bench bench;
  bench.queue.set_cores(1);
  bench.add({bench.wish("a"), bench.wish("b")});
  EXPECT_TRUE(bench.queue.wants_worker());
  QProcess worker, second;
  worker.start(BRECCIA_GUI, {"--work-queue", bench.state});
  ASSERT_TRUE(wait_until([&] { return bench.queue.is_worked(); }, 20000));
  EXPECT_FALSE(bench.queue.wants_worker());
  second.start(BRECCIA_GUI, {"--work-queue", bench.state});
  EXPECT_TRUE(second.waitForFinished(20000));
  EXPECT_TRUE(wait_until([&] { return worker.state() == QProcess::NotRunning; }, 120000));
  EXPECT_EQ(bench.states(), "a complete, b complete");
  EXPECT_FALSE(bench.queue.wants_worker());
}

TEST(RunQueue, AWorkerThatWasKilledLeavesItsRunToTheNextOne) {
  const Bench bench;
  bench.queue.set_cores(1);
  bench.add({bench.wish("a", "300 us"), bench.wish("b")});
  QProcess worker;
  worker.start(BRECCIA_GUI, {"--work-queue", bench.state});
  ASSERT_TRUE(wait_until([&] { return bench.states() == "a running, b waiting"; }, 20000));
  worker.kill();
  ASSERT_TRUE(worker.waitForFinished());
  EXPECT_TRUE(bench.queue.wants_worker());
  EXPECT_EQ(work_queue(bench.state), 0);
  EXPECT_EQ(bench.states(), "a complete, b complete");
}

}  // namespace
}  // namespace breccia::gui::run_queue_test
