#include "output/folder/control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "base/error.hpp"
#include "output/folder/run_folder.hpp"
#include "output/folder/run_lock.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::control_test {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = Command::Kind;

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::app) << text; }

TEST(Command, OfOneWordIsKnown) {
  EXPECT_EQ(parse_command("pause").kind, Kind::pause);
  EXPECT_EQ(parse_command("  resume\r").kind, Kind::resume);
  EXPECT_EQ(parse_command("stop").kind, Kind::stop);
  EXPECT_EQ(parse_command("extract").kind, Kind::extract);
  EXPECT_EQ(parse_command("frame").kind, Kind::frame);
}

TEST(Command, OfAnIntervalHasSeconds) {
  const Command command = parse_command("frame_interval 2 us id=7");
  EXPECT_EQ(command.kind, Kind::frame_interval);
  EXPECT_DOUBLE_EQ(command.value, 2e-6);
  EXPECT_EQ(command.text, "frame_interval 2 us");
  EXPECT_EQ(command.id, "7");
  EXPECT_EQ(parse_command("frame_interval 0 s").kind, Kind::frame_interval);
}

TEST(Command, ThatIsUnknownIsRefusedWithWhatIsAllowed) {
  for (const char* line : {"dance", "pause now", "frame_intervals", "", "id=3"}) {
    const Command command = parse_command(line);
    EXPECT_EQ(command.kind, Kind::refused) << line;
    EXPECT_THAT(command.complaint, HasSubstr("pause, resume, stop")) << line;
  }
}

TEST(Command, WithAWrongIntervalSaysWhy) {
  for (const char* time : {"3 m", "-2 us", "soon", "inf s", "1e400 s"}) {
    const Command command = parse_command(std::string("frame_interval ") + time);
    EXPECT_EQ(command.kind, Kind::refused) << time;
    EXPECT_THAT(command.complaint, HasSubstr(time));
  }
  EXPECT_THAT(parse_command("frame_interval id=3").complaint, HasSubstr("needs a simulated time"));
}

TEST(ControlFile, IsNotHeldUpByAPipeAFolderOrALink) {
  const TemporaryFolder folder;
  ControlFile control(folder / "control");
  ASSERT_EQ(::mkfifo((folder / "control").c_str(), 0600), 0);
  EXPECT_THAT(control.take(), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(folder / "control"));
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  write(folder / "elsewhere", "stop\n");
  std::filesystem::create_symlink(folder / "elsewhere", folder / "control");
  EXPECT_THAT(control.take(), IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(folder / "elsewhere"));
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  std::filesystem::create_directory(folder / "control");
  EXPECT_THAT(control.take(), IsEmpty());
}

TEST(ControlFile, TakesRequestsAfterAFolderThatCannotBeRemoved) {
  const TemporaryFolder folder;
  ControlFile control(folder / "control");
  for (int i = 0; i < 2; ++i) {
    std::filesystem::create_directory(folder / "control");
    write(folder / "control/file", "stop\n");
    EXPECT_THAT(control.take(), IsEmpty());
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
  write(folder / "control", "stop\n");
  EXPECT_THAT(control.take(), ElementsAre("stop"));
}

TEST(ControlFile, GivesNoMoreLinesThanARunCanAnswerAndNoneThatFillsItsStatus) {
  const TemporaryFolder folder;
  ControlFile control(folder / "control");
  std::string many = std::string(10'000'000, 'a') + "\n";
  write(folder / "control", many);
  const std::vector<std::string> one = control.take();
  ASSERT_EQ(one.size(), 1U);
  EXPECT_LT(one.front().size(), 300U);
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  many.clear();
  for (int i = 0; i < 10000; ++i) many += "pause\n";
  write(folder / "control", many);
  EXPECT_EQ(control.take().size(), 100U);
}

TEST(ControlFile, LosesNoneOfManyThatAskAtOnce) {
  constexpr int kAskers = 6;
  const TemporaryFolder folder;
  const RunFolder run{folder.path()};
  write(run.status(), "{\"state\":\"running\"}\n");
  std::vector<std::thread> askers;
  std::atomic<int> answered{0}, ended{0};
  for (int i = 0; i < kAskers; ++i) {
    askers.emplace_back([&] {
      try {
        answered += ask_run(folder.path(), "frame", 60) == "done" ? 1 : 0;
      } catch (const OutputError& error) {
        ADD_FAILURE() << error.what();
      }
      ++ended;
    });
  }
  ControlFile control(run.control());
  while (ended < kAskers) {
    for (const std::string& line : control.take())
      write(run.status(),
            "{\"event\":\"control\",\"accepted\":true,\"text\":\"done\",\"id\":\"" + parse_command(line).id + "\"}\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(answered, kAskers);
}

TEST(ControlFile, OfAKilledRunIsNotWaitedFor) {
  const TemporaryFolder folder;
  write(RunFolder{folder.path()}.status(), "{\"state\":\"running\"}\n");
  { const RunLock lock(folder.path()); }
  try {
    (void)ask_run(folder.path(), "frame", 30);
    FAIL() << "nobody can have answered";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("interrupted"));
  }
}

TEST(ControlFile, TellsThatAStopWaitsAndLeavesItThere) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "control";
  EXPECT_FALSE(stop_waits(file));
  write(file, "pause\nstops\n");
  EXPECT_FALSE(stop_waits(file));
  write(file, "stop id=7\n");
  EXPECT_TRUE(stop_waits(file));
  EXPECT_THAT(ControlFile(file).take(), ElementsAre("pause", "stops", "stop id=7"));
  EXPECT_FALSE(stop_waits(file));
}

TEST(ControlFile, GivesEveryLineOnce) {
  const TemporaryFolder folder;
  ControlFile control(folder / "control");
  write(folder / "control", "pause\n\n  frame id=2 \n");
  EXPECT_THAT(control.take(), ElementsAre("pause", "frame id=2"));
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  EXPECT_THAT(control.take(), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(folder / "control"));
  write(folder / "control", "stop");
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  EXPECT_THAT(control.take(), ElementsAre("stop"));
}

TEST(ControlFile, IsLookedForFiveTimesASecondAtMost) {
  const TemporaryFolder folder;
  ControlFile control(folder / "control");
  EXPECT_THAT(control.take(), IsEmpty());
  write(folder / "control", "pause\n");
  EXPECT_THAT(control.take(), IsEmpty());  // a moment after the first look
  EXPECT_TRUE(std::filesystem::exists(folder / "control"));
}

std::string complaint_of(const std::filesystem::path& run, double patience) {
  try {
    (void)ask_run(run, "pause", patience);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

TEST(AskingARun, WithoutARunSaysSo) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint_of(folder.path(), 1), HasSubstr("no run of breccia writes here"));
}

TEST(AskingARun, ThatHasEndedSaysSo) {
  const TemporaryFolder folder;
  write(folder / "status.jsonl", "{\"state\":\"running\"}\n{\"state\":\"complete\"}\n");
  EXPECT_THAT(complaint_of(folder.path(), 1), HasSubstr("has ended"));
}

TEST(AskingARun, ThatDoesNotAnswerTakesTheCommandBack) {
  const TemporaryFolder folder;
  write(folder / "status.jsonl", "{\"state\":\"running\"}\n");
  EXPECT_THAT(complaint_of(folder.path(), 0.1), HasSubstr("does not respond"));
  EXPECT_FALSE(std::filesystem::exists(folder / "control"));
}

/// Answers the first command in the folder as a run would.
void answer(const std::filesystem::path& folder, bool accepted) {
  ControlFile control(folder / "control");
  for (int look = 0; look < 100; ++look) {
    for (const std::string& line : control.take()) {
      write(folder / "status.jsonl", "{\"event\":\"control\",\"accepted\":" + std::string(accepted ? "true" : "false") +
                                         ",\"text\":\"heard\",\"id\":\"" + parse_command(line).id + "\"}\n");
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST(AskingARun, GetsItsOwnAnswer) {
  const TemporaryFolder folder;
  write(folder / "status.jsonl", "{\"event\":\"control\",\"accepted\":true,\"text\":\"another's\",\"id\":\"1\"}\n");
  std::thread run(answer, folder.path(), true);
  EXPECT_EQ(ask_run(folder.path(), "pause", 10), "heard");
  run.join();
}

TEST(AskingARun, WaitsForTheRestOfAnAnswerThatIsHalfWritten) {
  const TemporaryFolder folder;
  write(folder / "status.jsonl", "{\"state\":\"running\"}\n");
  std::thread run([&] {
    ControlFile control(folder / "control");
    std::vector<std::string> lines;
    while (lines.empty()) lines = control.take();
    const std::string id = parse_command(lines.front()).id;
    write(folder / "status.jsonl", "{\"event\":\"control\",\"accepted\":true,\"te");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // some looks of who waits
    write(folder / "status.jsonl", "xt\":\"heard\",\"id\":\"" + id + "\"}\n");
  });
  EXPECT_EQ(ask_run(folder.path(), "pause", 5), "heard");
  run.join();
}

TEST(AskingARun, ThatRefusesIsAnError) {
  const TemporaryFolder folder;
  write(folder / "status.jsonl", "{\"state\":\"running\"}\n");
  std::thread run(answer, folder.path(), false);
  EXPECT_THAT(complaint_of(folder.path(), 10), HasSubstr("refuses: heard"));
  run.join();
}

}  // namespace
}  // namespace breccia::control_test
