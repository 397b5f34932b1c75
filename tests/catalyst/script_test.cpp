// Scripts under the plug-in. ParaView starts once in a process, so all pipelines are those of one adaptor.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::script_test {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Scripts, SeeTheChannelsOfTheirRankAndTheirParametersAndReachTheSolver) {
  const auto folder = fresh_folder("scripts");
  SyntheticRun run(3, world().rank, world().size);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add(std::string(BRECCIA_SCRIPTS) + "/count_cells.py", {"factor"}, {2.5}).text("label", "half open");
  std::string expected;
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (std::int64_t step = 1; step <= 3; ++step) {
      const std::uint32_t channels = adaptor.channels(0, step, SyntheticRun::time_of(step));
      EXPECT_EQ(channels, 1U << BRECCIA_ELEMENTS);
      EXPECT_EQ(adaptor.execute(1, run.at(step, channels)), 0U) << adaptor.text;
      run.take_away();
      EXPECT_EQ(adaptor.requests.stop, step == 2 ? 1 : 0);
      EXPECT_EQ(adaptor.requests.frame_interval, step == 2 ? 2.5e-6 : 0.0);
      run.give_back();
      const auto share = run.share(BRECCIA_ELEMENTS, step);
      expected += std::to_string(step) + " " + std::to_string(share.end - share.first) + " 2.5 half open\n";
    }
    run.take_away();
  }
  EXPECT_EQ(content(folder / "count_cells" / ("rank_" + std::to_string(world().rank) + ".txt")), expected);
}

/// Pipelines of one adaptor by the names of their scripts.
class OpenScripts {
 public:
  OpenScripts(const std::filesystem::path& folder, const std::vector<std::string>& pipelines)
      : config_(folder, world().communicator, world().rank, world().size) {
    for (const std::string& name : pipelines) config_.add(name.ends_with(".py") ? script(name) : name);
    adaptor_.emplace(config_.get());
  }
  static std::string script(const std::string& name) { return std::string(BRECCIA_SCRIPTS) + "/" + name; }
  Adaptor& operator*() { return *adaptor_; }
  Adaptor* operator->() { return &*adaptor_; }

 private:
  Config config_;
  std::optional<Adaptor> adaptor_;
};

/// Executes all pipelines of the mask that have something to do, as the solver would.
std::uint32_t step(Adaptor& adaptor, SyntheticRun& run, std::int64_t number, int pipelines) {
  std::uint32_t due = 0;
  std::uint32_t channels = 0;
  for (int i = 0; i < pipelines; ++i) {
    const std::uint32_t wanted = adaptor.channels(i, number, SyntheticRun::time_of(number));
    if (wanted != 0) due |= 1U << i;
    channels |= wanted;
  }
  const std::int64_t failed = due == 0 ? 0 : adaptor.execute(due, run.at(number, channels));
  EXPECT_GE(failed, 0);
  run.take_away();
  run.give_back();
  return static_cast<std::uint32_t>(failed);
}

TEST(Scripts, ThatFailAreToldInOneLineEachWithTheirPlaceOnAllRanksAndTheOthersGoOn) {
  const auto folder = fresh_folder("bad_scripts");
  // The writer's folder is a file.
  if (world().rank == 0) {
    std::filesystem::create_directories(folder / "failing_writer");
    std::ofstream(folder / "failing_writer/not_a_folder") << "in the way";
  }
  barrier();
  SyntheticRun run(3, world().rank, world().size, world().size - 1 > 0 ? world().size - 1 : -1);
  testing::internal::CaptureStderr();
  {
    OpenScripts scripts(folder, {"raises_at_seventh_call.py", "raises_at_import.py", "calls_sys_exit.py",
                                 "raises_on_one_rank.py", "failing_writer.py", "exported.py", "surface"});
    ASSERT_TRUE(scripts->is_open());
    for (std::int64_t number = 1; number <= 8; ++number) {
      const std::uint32_t failed = step(*scripts, run, number, 7);
      EXPECT_EQ(failed & 1U, number == 7 ? 1U : 0U) << "step " << number;
      EXPECT_EQ((failed >> 1) & 1U, number == 1 ? 1U : 0U) << "what cannot be imported fails once and is due no more";
      EXPECT_EQ((failed >> 2) & 7U, 7U) << "step " << number;
      EXPECT_EQ(failed >> 5, 0U) << "step " << number << ": " << scripts->text;
      const std::string calls =
          OpenScripts::script("calls_sys_exit.py") + ": SystemExit: called sys.exit (calls_sys_exit.py:12)\n";
      EXPECT_THAT(scripts->text, testing::HasSubstr(calls));
      EXPECT_THAT(scripts->text, testing::HasSubstr(OpenScripts::script("raises_on_one_rank.py") +
                                                    ": RuntimeError: only here (raises_on_one_rank.py:16)\n"));
      EXPECT_THAT(scripts->text, testing::HasSubstr(OpenScripts::script("failing_writer.py") + ": "));
      if (number == 1) {
        EXPECT_THAT(scripts->text, testing::HasSubstr(OpenScripts::script("raises_at_import.py") +
                                                      ": ValueError: this cannot continue (raises_at_import.py:5)\n"));
      }
      if (number == 7) {
        EXPECT_THAT(scripts->text, testing::HasSubstr("KeyError: 'seven' (raises_at_seventh_call.py:14)"));
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  barrier();
  EXPECT_TRUE(std::filesystem::exists(folder / "exported/Threshold1_000008.pvtu"));
  EXPECT_FALSE(std::filesystem::exists("datasets"));
  EXPECT_TRUE(std::filesystem::exists(folder / "surface/surface_000000008.pvtp"));
}

/// The solver's memory is not there any more when the adaptor is closed.
TEST(Scripts, ThatReadAtTheirEndFindNoCells) {
  const auto folder = fresh_folder("ends");
  SyntheticRun run(3, world().rank, world().size);
  {
    OpenScripts scripts(folder, {"reads_at_its_end.py"});
    ASSERT_TRUE(scripts->is_open());
    for (std::int64_t number = 1; number <= 2; ++number) EXPECT_EQ(step(*scripts, run, number, 1), 0U) << scripts->text;
    run.take_away();
  }
  barrier();
  EXPECT_EQ(content(folder / "reads_at_its_end/cells.txt"), "0");
}

TEST(Scripts, InAReplayGetEachRecordedCellOnceWhateverTheNumberOfRanks) {
  const auto records = fresh_folder("records");
  SyntheticRun run(3, world().rank, world().size);
  {
    Config config(records, world().communicator, world().rank, world().size);
    Adaptor adaptor(config.add("volume").add("fractures").add("history").get());
    const std::uint32_t all = (1U << BRECCIA_ELEMENTS) | (1U << BRECCIA_FRACTURES) | (1U << BRECCIA_HISTORY);
    for (const std::int64_t number : {1, 2, 5}) ASSERT_EQ(adaptor.execute(7, run.at(number, all)), 0U) << adaptor.text;
  }
  barrier();
  // By fewer ranks than have recorded: the first alone.
  if (world().rank == 0) {
    const auto folder = records / "replayed";
    std::filesystem::create_directories(folder);
    const std::string recorded = content(records / "history/history.csv");
    std::ofstream(records / "history/history.csv", std::ios::app) << "7,0.0";  // where a run was killed
    Config config(folder, -1, 0, 1);
    config.add(OpenScripts::script("raises_with_elements.py"));  // the others go on
    config.add(OpenScripts::script("count_cells.py"), {"factor"}, {3})
        .text("label", "a b")
        .add("volume")
        .add("history");
    Text text;
    EXPECT_NE(plugin().replay(&config.get(), records.c_str(), text.text, sizeof text.text), 0);
    EXPECT_EQ(text.string(), "step 2: " + OpenScripts::script("raises_with_elements.py") +
                                 ": ValueError: enough (raises_with_elements.py:11)");
    const std::string cells = std::to_string(run.total(BRECCIA_ELEMENTS, 1));
    EXPECT_EQ(content(folder / "count_cells/rank_0.txt"),
              "1 " + cells + " 3.0 a b\n2 " + cells + " 3.0 a b\n5 " + cells + " 3.0 a b\n");
    EXPECT_EQ(content(folder / "history/history.csv"), recorded);
    EXPECT_EQ(content(folder / "elements/elements.pvd"), content(records / "elements/elements.pvd"));
  }
  barrier();
  const auto again = fresh_folder("replayed_again");
  Config config(again, world().communicator, world().rank, world().size);
  config.add("surface");
  Text text;
  EXPECT_NE(plugin().replay(&config.get(), records.c_str(), text.text, sizeof text.text), 0);
  EXPECT_THAT(text.string(), testing::AllOf(testing::HasSubstr("surface: needs surface"),
                                            testing::HasSubstr("it has elements, fractures, history")));
  Config nothing(again, world().communicator, world().rank, world().size);
  nothing.add("surface");
  EXPECT_NE(plugin().replay(&nothing.get(), again.c_str(), text.text, sizeof text.text), 0);
  EXPECT_THAT(text.string(), testing::HasSubstr("nothing is recorded there"));
}

}  // namespace
}  // namespace breccia::test::script_test
