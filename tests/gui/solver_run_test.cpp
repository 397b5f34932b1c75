#include "core/solver_run.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <memory>

#include "core/solver_query.hpp"
#include "gui/block_case.hpp"

namespace breccia::gui::solver_run_test {
namespace {

using test::turning_case, test::wait_until, test::written_case;

/// A case that runs for minutes unless it is stopped or ends earlier.
QString long_case(const QTemporaryDir& scratch, const QByteArray& end = "10 s") {
  return written_case(scratch, turning_case(end));
}

const Launch kLaunch{BRECCIA_PROGRAM, BRECCIA_MPIEXEC};

std::unique_ptr<SolverRun> started(const QTemporaryDir& scratch, int ranks) {
  QString error;
  std::unique_ptr<SolverRun> run(
      SolverRun::start(kLaunch, long_case(scratch), scratch.filePath("runs/one"), ranks, &error, nullptr));
  EXPECT_NE(run, nullptr) << error.toStdString();
  return run;
}

TEST(SolverRun, ARunOnTwoRanksIsWatchedAndAStopLeavesNoProcess) {
  const QTemporaryDir scratch;
  const auto run = started(scratch, 2);
  ASSERT_TRUE(wait_until([&] { return run->status().step > 10 && run->frames().size() > 1; }, 60000))
      << run->failure().toStdString();
  EXPECT_EQ(run->state(), "running");
  EXPECT_GE(members_of(run->record().session).size(), 3);  // mpiexec and its ranks
  run->stop();
  EXPECT_EQ(run->state(), "stopping");
  ASSERT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
  EXPECT_EQ(run->state(), "stopped");
  EXPECT_TRUE(members_of(run->record().session).isEmpty());
  EXPECT_GT(run->history().rows(), 1);
}

TEST(SolverRun, APauseIsSeenAtOnceAndSoIsTheEndOfOne) {
  const QTemporaryDir scratch;
  const auto run = started(scratch, 1);
  ASSERT_TRUE(wait_until([&] { return run->state() == "running"; }, 60000)) << run->failure().toStdString();
  QStringList states;
  QObject::connect(run.get(), &SolverRun::status_changed, [&] { states << run->state(); });
  run->pause();
  EXPECT_EQ(states, QStringList("pausing"));
  ASSERT_TRUE(wait_until([&] { return run->state() == "paused"; }, 30000));
  run->resume();
  EXPECT_EQ(run->state(), "resuming");
  EXPECT_TRUE(wait_until([&] { return run->state() == "running"; }, 30000));
  run->stop();
  EXPECT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
}

TEST(SolverRun, TheEndOfARunIsToldOnceAndThatOfOneThatHadEndedBeforeIsNot) {
  const QTemporaryDir scratch;
  QString error;
  const std::unique_ptr<SolverRun> run(
      SolverRun::start(kLaunch, long_case(scratch, "50 us"), scratch.filePath("runs/one"), 1, &error, nullptr));
  ASSERT_NE(run, nullptr) << error.toStdString();
  int told = 0, told_again = 0;
  QObject::connect(run.get(), &SolverRun::ended, [&] { ++told; });
  ASSERT_TRUE(wait_until([&] { return told > 0; }, 60000));
  SolverRun found(run->record());
  QObject::connect(&found, &SolverRun::ended, [&] { ++told_again; });
  wait_until([] { return false; }, 8 * SolverRun::kInterval);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(told_again, 0) << "every start of the desktop announced old runs";
}

TEST(SolverRun, ARunThatIsStoppedBeforeItSaysAnythingIsStoppedAndHasNotFailed) {
  const QTemporaryDir scratch;
  QString error;
  const std::unique_ptr<SolverRun> run(SolverRun::start({test::silent_program(scratch), ""}, long_case(scratch),
                                                        scratch.filePath("runs/one"), 1, &error, nullptr));
  ASSERT_NE(run, nullptr) << error.toStdString();
  EXPECT_EQ(run->state(), "starting");
  run->stop();
  ASSERT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
  EXPECT_EQ(run->state(), "stopped");
}

TEST(SolverRun, AStopEndsARunOfWhichARankHangs) {
  const QTemporaryDir scratch;
  const auto run = started(scratch, 2);
  ASSERT_TRUE(wait_until([&] { return run->status().step > 1; }, 60000)) << run->failure().toStdString();
  const QList<pid_t> members = members_of(run->record().session);
  ::kill(members.back(), SIGSTOP);
  run->set_patience({500, 500});
  run->stop();
  EXPECT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
  EXPECT_TRUE(members_of(run->record().session).isEmpty());
}

/// Hash of the state at the end of a run.
QString hash_of(const QString& folder) {
  QFile file(folder + "/summary.json");
  return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object()["state_hash"].toString()
                                        : QString();
}

TEST(SolverRun, AStoppedRunGoesOnUnderAnotherNumberOfRanksToTheBitsOfTheUndisturbedOne) {
  const QTemporaryDir scratch;
  QString error;
  const QString file = long_case(scratch, "2 ms");
  const std::unique_ptr<SolverRun> whole(
      SolverRun::start(kLaunch, file, scratch.filePath("runs/whole"), 1, &error, nullptr));
  ASSERT_NE(whole, nullptr) << error.toStdString();
  ASSERT_TRUE(wait_until([&] { return !whole->alive(); }, 120000));
  ASSERT_EQ(whole->state(), "complete") << whole->failure().toStdString();
  EXPECT_FALSE(whole->can_go_on());
  EXPECT_GT(whole->status().broken_joints, 0);

  const std::unique_ptr<SolverRun> first(
      SolverRun::start(kLaunch, file, scratch.filePath("runs/two parts"), 2, &error, nullptr));
  ASSERT_NE(first, nullptr) << error.toStdString();
  ASSERT_TRUE(wait_until([&] { return first->status().step > 10; }, 60000)) << first->failure().toStdString();
  first->stop();
  ASSERT_TRUE(wait_until([&] { return !first->alive(); }, 30000));
  ASSERT_EQ(first->state(), "stopped");
  ASSERT_TRUE(first->can_go_on());
  EXPECT_GT(first->checkpoints().front().step, 10);

  const std::unique_ptr<SolverRun> second(SolverRun::go_on(kLaunch, first->record(), 1, &error, nullptr));
  ASSERT_NE(second, nullptr) << error.toStdString();
  EXPECT_EQ(second->state(), "starting");  // not what the ended run has said
  EXPECT_EQ(second->record().command.join(' '),
            QString(BRECCIA_PROGRAM) + " resume " + scratch.filePath("runs/two parts") + " --progress none");
  ASSERT_TRUE(wait_until([&] { return !second->alive(); }, 120000));
  EXPECT_EQ(second->state(), "complete") << second->failure().toStdString();
  EXPECT_FALSE(hash_of(second->record().folder).isEmpty());
  EXPECT_EQ(hash_of(second->record().folder), hash_of(whole->record().folder));
  EXPECT_EQ(second->history().rows(), [&] {
    whole->look();
    return whole->history().rows();
  }());
}

TEST(SolverRun, ARunOfWhichARankHungGoesOnFromItsCheckpoint) {
  const QTemporaryDir scratch;
  const auto run = started(scratch, 2);
  ASSERT_TRUE(wait_until([&] { return run->status().step > 1; }, 60000)) << run->failure().toStdString();
  run->checkpoint();
  ASSERT_TRUE(wait_until([&] { return !run->checkpoints().empty(); }, 30000));
  ::kill(members_of(run->record().session).back(), SIGSTOP);
  run->set_patience({500, 500});
  run->stop();
  ASSERT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
  EXPECT_TRUE(members_of(run->record().session).isEmpty());
  EXPECT_TRUE(run->state() == "interrupted" || run->state() == "stopped" || run->state() == "failed")
      << run->state().toStdString();
  ASSERT_TRUE(run->can_go_on());
  const qint64 from = run->checkpoints().front().step;
  QString error;
  const std::unique_ptr<SolverRun> second(SolverRun::go_on(kLaunch, run->record(), 2, &error, nullptr));
  ASSERT_NE(second, nullptr) << error.toStdString();
  EXPECT_TRUE(wait_until([&] { return second->status().step > static_cast<double>(from); }, 60000))
      << second->failure().toStdString();
  second->stop();
  EXPECT_TRUE(wait_until([&] { return !second->alive(); }, 30000));
}

TEST(SolverRun, ARunThatWasStartedElsewhereIsFollowedAndAskedToStopButNotKilled) {
  const QTemporaryDir scratch;
  const auto elsewhere = started(scratch, 1);
  SolverRun run({scratch.filePath("runs/one"), {}, 1, {}, {}});
  ASSERT_TRUE(wait_until([&] { return run.status().step > 1; }, 60000)) << elsewhere->failure().toStdString();
  EXPECT_TRUE(run.alive());
  EXPECT_EQ(run.state(), "running");
  run.pause();
  run.checkpoint();  // two requests at once: none is lost
  EXPECT_TRUE(wait_until([&] { return run.state() == "paused" && !run.checkpoints().empty(); }, 30000));
  run.stop();
  EXPECT_TRUE(wait_until([&] { return !run.alive(); }, 30000));
  EXPECT_EQ(run.state(), "stopped");
}

TEST(SolverRun, AFolderThatCannotBeWrittenIsTold) {
  const QTemporaryDir scratch;
  QFile file(scratch.filePath("file"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  QString error;
  EXPECT_EQ(SolverRun::start(kLaunch, long_case(scratch), scratch.filePath("file/run"), 1, &error, nullptr), nullptr);
  EXPECT_TRUE(error.contains("cannot be written")) << error.toStdString();
}

TEST(SolverRun, ACommandLineIsQuotedForAShell) {
  const QStringList words{"breccia", "run", "a b/it's $HOME.toml", "", "x;y", "é"};
  const QString line = shell_line(words);
  QProcess shell;
  shell.start("/bin/sh", {"-c", "printf '%s\n' " + line});
  ASSERT_TRUE(shell.waitForFinished());
  EXPECT_EQ(QString::fromUtf8(shell.readAllStandardOutput()), words.join('\n') + "\n");
  EXPECT_TRUE(line.startsWith("breccia run '"));
}

TEST(SolverRun, ARunOutlivesItsStarterAndIsFoundAgain) {
  const QTemporaryDir scratch;
  const QString registry = scratch.filePath("state/runs.json"), file = long_case(scratch);
  const pid_t child = ::fork();
  if (child == 0) {
    QString error;
    const SolverRun* run = SolverRun::start(kLaunch, file, scratch.filePath("runs/one"), 1, &error, nullptr);
    if (run == nullptr) ::_exit(1);
    RunRegistry(registry).add(run->record());
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  const std::vector<RunRecord> found = RunRegistry(registry).load();
  ASSERT_EQ(found.size(), 1U);
  SolverRun run(found[0]);
  EXPECT_TRUE(run.alive());
  EXPECT_TRUE(wait_until([&] { return run.status().step > 0; }, 30000));
  run.stop();
  EXPECT_TRUE(wait_until([&] { return !run.alive(); }, 30000));
}

TEST(SolverRun, ANumberOfAnotherProcessIsNotTakenForTheRun) {
  EXPECT_TRUE(members_of({::getpid(), 1}).isEmpty());
  EXPECT_TRUE(members_of({}).isEmpty());
}

TEST(SolverRun, ARefusedCaseFailsWithTheSolversWords) {
  const QTemporaryDir scratch;
  const QString file = long_case(scratch);
  QFile out(file);
  ASSERT_TRUE(out.open(QIODevice::Append));
  out.write("nonsense = 3\n");
  out.close();
  QString error;
  const std::unique_ptr<SolverRun> run(
      SolverRun::start(kLaunch, file, scratch.filePath("runs/one"), 1, &error, nullptr));
  ASSERT_NE(run, nullptr);
  ASSERT_TRUE(wait_until([&] { return !run->alive(); }, 30000));
  EXPECT_EQ(run->state(), "failed");
  EXPECT_TRUE(run->failure().contains("output.nonsense")) << run->failure().toStdString();
}

TEST(SolverRun, AProgramThatIsNotThereIsTold) {
  const QTemporaryDir scratch;
  QString error;
  EXPECT_EQ(SolverRun::start({"/no/such/program", ""}, long_case(scratch), scratch.filePath("r"), 1, &error, nullptr),
            nullptr);
  EXPECT_TRUE(error.contains("/no/such/program"));
}

TEST(SolverRun, TheCommandLineIsThatOfATerminal) {
  EXPECT_EQ(SolverRun::command_line({"breccia", "mpiexec"}, "a.toml", "runs/a", 1).join(' '),
            "breccia run a.toml -o runs/a --progress none");
  EXPECT_EQ(SolverRun::command_line({"breccia", "mpiexec"}, "a.toml", "runs/a", 1000).join(' '),
            "mpiexec --oversubscribe -n 1000 breccia run a.toml -o runs/a --progress none");
}

TEST(SolverQuery, AnswersAndProblemsComeAsJson) {
  const QTemporaryDir scratch;
  const QString file = long_case(scratch);
  SolverQuery query;
  QJsonObject answer;
  std::vector<Problem> problems;
  bool failed = false;
  QObject::connect(&query, &SolverQuery::answered, [&](const QJsonObject& json) { answer = json; });
  QObject::connect(&query, &SolverQuery::failed, [&](const QString&, const std::vector<Problem>& p) {
    problems = p;
    failed = true;
  });
  query.ask(BRECCIA_PROGRAM, {"mesh", file, "--json"});
  ASSERT_TRUE(wait_until([&] { return !answer.isEmpty(); }, 30000));
  EXPECT_EQ(answer["elements"].toInt(), 64 * 24);
  query.ask(BRECCIA_PROGRAM, {"mesh", file, "--json", "--set", "mesh.raster.cells=0"});
  ASSERT_TRUE(wait_until([&] { return failed; }, 30000));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].key, "mesh.raster.cells");
}

}  // namespace
}  // namespace breccia::gui::solver_run_test
