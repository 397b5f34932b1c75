#include "core/solver_run.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <functional>
#include <memory>

#include "core/solver_query.hpp"

namespace breccia::gui {
namespace {

bool wait_until(const std::function<bool()>& ready, int ms) {
  QElapsedTimer timer;
  timer.start();
  while (!ready() && timer.elapsed() < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
  return ready();
}

/// A case that runs for minutes unless it is stopped.
QString long_case(const QTemporaryDir& scratch) {
  const QString file = scratch.filePath("case.toml");
  QFile out(file);
  if (out.open(QIODevice::WriteOnly)) {
    out.write(R"(title = "long"
[mesh.raster]
cells = [4, 4, 4]
cell_size = "10 mm"
group = "block"
[[material]]
group = "block"
young = "40 GPa"
poisson = 0.2
density = 2400
[[joint]]
group = "block"
tensile_strength = "5 MPa"
energy_mode_1 = "100 J/m2"
[[stage]]
end = "10 s"
[output]
frame_interval = "100 us"
history_interval = "100 us"
)");
  }
  return file;
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
}  // namespace breccia::gui
