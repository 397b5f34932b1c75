#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "end_to_end/process_tree.hpp"
#include "end_to_end/program.hpp"

/// Runs that end before their time and go on from a checkpoint, against the same run undisturbed.
namespace breccia::test::resume_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Boxes that break, flow plastically, touch and rub, are held, pushed and damped, in two stages.
std::string eventful_case() {
  std::string text = changed("poisson = 0.3",
                             "poisson = 0.3\nlaw = \"drucker_prager\"\nfriction_angle = \"30 deg\"\n"
                             "dilation_angle = \"10 deg\"\ncohesion = \"20 kPa\"\nhardening = \"100 kPa\"\n"
                             "cap_pressure = \"60 kPa\"\ncap_hardening = \"200 kPa\"");
  const std::string end = "end = \"4 ms\"";
  text.replace(text.find(end), end.size(), "end = \"2 ms\"");
  const std::string output = "[output]";
  text.replace(text.find(output), output.size(),
               "[[stage]]\nname = \"push\"\nend = \"4 ms\"\nmass_damping = 20\ngravity = [0, 0, \"-9.81 m/s2\"]\n"
               "[[stage.pressure]]\nsurface = \"box.x1\"\nvalue = \"1 kPa\"\n"
               "[[stage.constraint]]\ngroup = \"box.x0\"\n"
               "displacement = { z = { table = [[\"2 ms\", 0], [\"4 ms\", \"0.1 mm\"]] } }\n"
               "[time]\nsafety = 0.4\n[output]");
  return text;
}

json summary_of(const fs::path& run) { return json::parse(read_text(run / "summary.json"), nullptr, false); }

std::vector<json> status_lines(const fs::path& run) {
  std::vector<json> lines;
  std::ifstream file(run / "status.jsonl");
  for (std::string line; std::getline(file, line);) lines.push_back(json::parse(line, nullptr, false));
  return lines;
}

std::vector<fs::path> checkpoints(const fs::path& run) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(run / "checkpoints", error))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::set<fs::path> files_in(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) files.insert(entry.path());
  return files;
}

class Resume : public testing::Test {
 protected:
  Resume() : case_(scratch_.write("case.toml", eventful_case())) {
    const Outcome whole = call("run " + case_ + " --progress none -o " + quoted("whole"));
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_GT(summary_of(folder("whole")).at("broken_joints"), 0);
    EXPECT_GT(summary_of(folder("whole")).at("energy").at("plastic"), 0);
  }

  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }

  /// A run that ends after so many steps, with checkpoints every 50.
  void run_up_to(int steps, const std::string& name, int ranks = 1, const std::string& settings = "") {
    const Outcome begun =
        call_ranks(ranks, "run " + case_ + " --progress none --set checkpoint.steps=50 --set time.max_steps=" +
                              std::to_string(steps) + " -o " + quoted(name) + " " + settings);
    ASSERT_EQ(begun.exit_code, 0) << begun.err;
  }
  Outcome resume(const std::string& name, int ranks = 1, const std::string& settings = "") {
    return call_ranks(ranks, "resume " + quoted(name) + " --progress none --set time.max_steps=0 " + settings);
  }
  void expect_same_as_undisturbed(const std::string& name) {
    const json whole = summary_of(folder("whole")), resumed = summary_of(folder(name));
    ASSERT_TRUE(resumed.is_object()) << name;
    EXPECT_EQ(resumed.at("state_hash"), whole.at("state_hash")) << name;
    EXPECT_EQ(resumed.at("energy"), whole.at("energy")) << name;
    EXPECT_TRUE(history_without_couples(folder(name) / "history.csv") ==
                history_without_couples(folder("whole") / "history.csv"))
        << name;
    EXPECT_EQ(read_text(folder(name) / "frames/elements.hdf.series"),
              read_text(folder("whole") / "frames/elements.hdf.series"))
        << name;
  }

  Scratch scratch_;
  std::string case_;
};

TEST_F(Resume, GivesTheSameBitsOnAnotherNumberOfRanks) {
  for (const auto& [before, after] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 4}}) {
    const std::string name = "from_" + std::to_string(before) + "_to_" + std::to_string(after);
    run_up_to(120 + before, name, before);
    const Outcome resumed = resume(name, after);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_same_as_undisturbed(name);
    EXPECT_EQ(summary_of(folder(name)).at("ranks"), after);
  }
}

TEST_F(Resume, GivesTheSameBitsWithAnotherDivisionSearchAndInstructionSet) {
  run_up_to(130, "grid", 2, "--set domains.kind=grid");
  EXPECT_EQ(resume("grid", 2, "--set domains.kind=rcb --set detection.algorithm=ms").exit_code, 0);
  expect_same_as_undisturbed("grid");
  run_up_to(90, "wide");
  const Outcome narrow =
      call("resume " + quoted("wide") + " --progress none --set time.max_steps=0", "BRECCIA_SIMD=sse2");
  EXPECT_EQ(narrow.exit_code, 0) << narrow.err;
  EXPECT_EQ(summary_of(folder("wide")).at("simd"), "sse2");
  expect_same_as_undisturbed("wide");
}

TEST_F(Resume, GivesTheSameBitsAfterKillsAtAnyMoment) {
  const std::string settings = " --progress none --set checkpoint.steps=20";
  pid_t process = start_ranks(2, "run " + case_ + settings + " -o " + quoted("killed"));
  for (int kill_number = 0; kill_number < 4; ++kill_number) {
    const auto before = checkpoints(folder("killed"));
    for (int look = 0; look < 500 && (checkpoints(folder("killed")).empty() || checkpoints(folder("killed")) == before);
         ++look)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::this_thread::sleep_for(std::chrono::milliseconds(7 * kill_number));
    // The ranks die with their launcher, at once or when they next hear of it.
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const int ranks = 1 + (kill_number + 1) % 3;
    process = start_ranks(ranks, "resume " + quoted("killed") + settings);
  }
  waitpid(process, nullptr, 0);
  expect_same_as_undisturbed("killed");
}

/// mpiexec kills its ranks a second after Ctrl-C, here four, as ranks may share cores with other tests; each write and
/// fsync in the run's folder takes so long that no checkpoint is complete by then.
TEST_F(Resume, GivesTheSameBitsAfterCtrlCUnderMpiexecOnASlowDisk) {
  const std::string slow = "LD_PRELOAD=" BRECCIA_FAULTY_DISK " FAULTY_DISK='/ended_ 0 0 40000'";
  setenv("OMPI_MCA_odls_base_sigkill_timeout", "4", 1);
  for (const int ranks : {1, 2, 3}) {
    const std::string name = "ended_" + std::to_string(ranks);
    const pid_t launcher = start_ranks(ranks, "run " + case_ + " --progress none -o " + quoted(name), slow);
    ASSERT_TRUE(
        wait_until([&] { return read_text(folder(name) / "status.jsonl").find("\"step\":") != std::string::npos; }));
    kill(launcher, SIGINT);
    waitpid(launcher, nullptr, 0);
    ASSERT_TRUE(checkpoints(folder(name)).empty()) << "nothing is shown: it was written before the kill";
    const Outcome refused = resume(name);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("another run writes here: process "), std::string::npos) << refused.err;
    const auto ended = [&] { return status_lines(folder(name)).back().value("state", "") == "interrupted"; };
    ASSERT_TRUE(wait_until(ended));
    const std::vector<json> lines = status_lines(folder(name));
    EXPECT_NE(lines[lines.size() - 2].value("text", "").find("writes its checkpoint step_"), std::string::npos);
    EXPECT_NE(lines.back().value("message", "").find("is complete"), std::string::npos) << lines.back();
    ASSERT_EQ(checkpoints(folder(name)).size(), 1U);
    EXPECT_TRUE(wait_until([&] { return resume(name, ranks).exit_code == 0; }));
    expect_same_as_undisturbed(name);
  }
  unsetenv("OMPI_MCA_odls_base_sigkill_timeout");
}

TEST_F(Resume, GoesOnInAnotherFolderAndLeavesTheFirstAsItIs) {
  run_up_to(150, "first");
  const std::string before = read_text(folder("first") / "history.csv");
  const Outcome resumed = resume("first", 1, "-o " + quoted("second"));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_same_as_undisturbed("second");
  EXPECT_EQ(read_text(folder("first") / "history.csv"), before);
  const Outcome again = resume("first", 1, "-o " + quoted("second"));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("holds the results of an earlier run; allowed: another folder (-o)\n"), std::string::npos)
      << "resume has no -f: " << again.err;
}

TEST_F(Resume, StopsWhereItIsToldAndGoesOnFromThere) {
  run_up_to(100, "stopped");
  EXPECT_EQ(resume("stopped", 1, "--until '3 ms'").exit_code, 0);
  const json stopped = summary_of(folder("stopped"));
  EXPECT_NEAR(stopped.at("simulated_time"), 3e-3, 1e-5);
  EXPECT_EQ(stopped.at("status"), "stopped: --until reached");
  EXPECT_EQ(resume("stopped").exit_code, 0);
  expect_same_as_undisturbed("stopped");
}

TEST_F(Resume, TellsThatARunIsCompleteAndExtendsIt) {
  const std::string hash = summary_of(folder("whole")).at("state_hash");
  const Outcome nothing = resume("whole");
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_NE(nothing.out.find("is complete at 4 ms"), std::string::npos) << nothing.out;
  EXPECT_EQ(resume("whole", 2, "--until '4.5 ms'").exit_code, 0);
  EXPECT_NEAR(summary_of(folder("whole")).at("simulated_time"), 4.5e-3, 1e-8);
  EXPECT_NE(summary_of(folder("whole")).at("state_hash"), hash);
}

TEST_F(Resume, ExtendedFromAnEarlyStageChangesTheLastOneOnly) {
  const Outcome longer = call("run " + case_ + " --progress none --set 'stage[1].end=4.5 ms' -o " + quoted("longer"));
  ASSERT_EQ(longer.exit_code, 0) << longer.err;
  run_up_to(50, "early");
  EXPECT_EQ(resume("early", 1, "--until '4.5 ms'").exit_code, 0);
  EXPECT_EQ(summary_of(folder("early")).at("state_hash"), summary_of(folder("longer")).at("state_hash"));
}

TEST_F(Resume, HasTheSameResultsAsTheSameRun) {
  ASSERT_EQ(call("run " + case_ + " --progress none -o " + quoted("again")).exit_code, 0);
  const Outcome diff = call("diff " + quoted("whole") + " " + quoted("again"));
  EXPECT_EQ(diff.exit_code, 0);
  EXPECT_NE(diff.out.find("results: the same"), std::string::npos) << diff.out;
}

/// A bar that is held, and driven at full speed at once in the second stage.
std::string sudden_case() {
  return "[mesh.raster]\ncells = [3, 1, 1]\ncell_size = 0.02\ngroup = \"b\"\n"
         "[[material]]\ngroup = \"b\"\nyoung = 26.6e9\npoisson = 0.2\ndensity = 2340\njoints = \"none\"\n"
         "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = 2.66e9\n"
         "[[stage]]\nname = \"held\"\nend = 1e-5\n[[stage.constraint]]\ngroup = \"b.x0\"\nfixed = \"xyz\"\n"
         "[[stage]]\nname = \"driven\"\nend = 3e-5\n[[stage.constraint]]\ngroup = \"b.x0\"\n"
         "velocity = { x = 150 }\n"
         "[checkpoint]\nsteps = 1\nkeep = 1000\n[time]\nresidual_limit = 10\nenergy_gain_limit = 10\n";
}

TEST_F(Resume, FromEveryStepAroundASuddenMotionGoesOnAsTheRunDid) {
  case_ = scratch_.write("sudden.toml", sudden_case());
  ASSERT_EQ(call_ranks(2, "run " + case_ + " --progress none -o " + quoted("sudden")).exit_code, 0);
  const json hash = summary_of(folder("sudden")).at("state_hash");
  const auto files = checkpoints(folder("sudden"));
  ASSERT_GT(files.size(), 12U);
  for (std::size_t i = 5; i < 10; ++i) {
    const int ranks = 1 + static_cast<int>(i % 2);
    fs::remove_all(folder("again"));
    const Outcome resumed =
        call_ranks(ranks, "resume '" + files[i].string() + "' --progress none -o " + quoted("again"));
    ASSERT_EQ(resumed.exit_code, 0) << files[i] << resumed.err;
    EXPECT_EQ(summary_of(folder("again")).at("state_hash"), hash) << files[i];
  }
}

TEST_F(Resume, NamesADamagedCheckpointAndUsesTheOneBefore) {
  run_up_to(120, "damaged");
  const auto files = checkpoints(folder("damaged"));
  ASSERT_EQ(files.size(), 2U);
  fs::resize_file(files[1], fs::file_size(files[1]) - 1);
  const Outcome resumed = resume("damaged");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find(files[1].filename().string()), std::string::npos) << resumed.err;
  EXPECT_NE(resumed.err.find("cut off"), std::string::npos) << resumed.err;
  expect_same_as_undisturbed("damaged");
}

TEST_F(Resume, NamesEachCheckpointOnceWhereAllAreDamaged) {
  run_up_to(120, "lost");
  const auto files = checkpoints(folder("lost"));
  ASSERT_EQ(files.size(), 2U);
  for (const fs::path& file : files) fs::resize_file(file, fs::file_size(file) - 1);
  const Outcome resumed = resume("lost");
  EXPECT_EQ(resumed.exit_code, 2);
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const std::size_t first = resumed.err.find(name);
    ASSERT_NE(first, std::string::npos) << resumed.err;
    EXPECT_EQ(resumed.err.find(name, first + 1), std::string::npos) << resumed.err;
  }
}

TEST_F(Resume, RefusesEveryFlippedBit) {
  run_up_to(60, "flipped", 2, "--set checkpoint.keep=1");
  const fs::path file = checkpoints(folder("flipped")).at(0);
  const std::string sound = read_text(file);
  constexpr std::size_t kFlips = 12;
  for (std::size_t i = 0; i < kFlips; ++i) {
    std::string text = sound;
    const std::size_t at = i == 0 ? 40 : sound.size() * i / kFlips;
    text[at] = static_cast<char>(text[at] ^ (1 << i % 8));
    std::ofstream(file, std::ios::binary) << text;
    const Outcome resumed = resume("flipped", i % 2 == 0 ? 1 : 2);
    EXPECT_EQ(resumed.exit_code, 2) << at;
    EXPECT_NE(resumed.err.find(file.filename().string()), std::string::npos) << at << resumed.err;
    EXPECT_NE(resumed.err.find("damaged"), std::string::npos) << at << resumed.err;
  }
}

TEST_F(Resume, RefusesWhatIsNoRunAndWhatWouldChangeResults) {
  for (const auto& [arguments, message] :
       {std::pair{quoted("nowhere"), "there is no such run"},
        {"'" + folder("").string() + "'", "there are no checkpoints of a run here"},
        {"'" + (folder("whole") / "checkpoints").string() + "'", "this is the folder of a run's checkpoints"},
        {case_, "this is no checkpoint of breccia"},
        {quoted("whole") + " --set time.safety=0.1", "would change the results"},
        {quoted("whole") + " --set 'stage[1].end=9'", "would change the results"},
        {quoted("whole") + " --until 1e300",
         "--until: resume: is out of range; allowed: a time in s > 0 and <= 1e+10"}}) {
    const Outcome refused = call("resume " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_NE(refused.err.find(message), std::string::npos) << refused.err;
  }
}

TEST_F(Resume, RefusedForALostFileLeavesTheFolderAsItWas) {
  for (const char* lost : {"history.csv", "status.jsonl"}) {
    const std::string name = std::string("without_") + lost;
    run_up_to(120, name);
    fs::remove(folder(name) / lost);
    const std::set<fs::path> before = files_in(folder(name));
    for (const std::string& target : {std::string(), " -o " + quoted("target")}) {
      const Outcome refused = resume(name, 1, target);
      EXPECT_EQ(refused.exit_code, 2) << refused.err;
      EXPECT_NE(refused.err.find("this file is missing"), std::string::npos) << refused.err;
      EXPECT_NE(refused.err.find("[start] from"), std::string::npos) << "the way on: " << refused.err;
      EXPECT_TRUE(files_in(folder(name)) == before) << name << target;
      EXPECT_FALSE(fs::exists(folder("target")));
    }
  }
}

TEST_F(Resume, GoesOnWithoutPipelinesWhereTheirScriptIsGone) {
  const std::string script = scratch_.path("script.py").string();
  scratch_.write("script.py", "# nothing\n");
  const std::string text = eventful_case() + "[[insitu.pipeline]]\nname = \"script.py\"\nevery_time = \"1 ms\"\n";
  case_ = scratch_.write("with_script.toml", text);
  const Outcome begun = call(
      "run " + case_ + " --progress none --set checkpoint.steps=50 --set time.max_steps=120 -o " + quoted("scripted"));
  if (begun.err.find("in-situ adaptor is not installed") != std::string::npos) GTEST_SKIP() << "no ParaView";
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  fs::remove(script);
  const Outcome refused = resume("scripted");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("script.py"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--without-insitu"), std::string::npos) << refused.err;
  const Outcome resumed = resume("scripted", 1, "--without-insitu");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(summary_of(folder("scripted")).at("state_hash"), summary_of(folder("whole")).at("state_hash"));
  std::ifstream history(folder("scripted") / "history.csv");
  std::string header;
  std::getline(history, header);
  for (std::string line; std::getline(history, line);)
    ASSERT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ',')) << line;
}

TEST_F(Resume, GoesOnAfterAPoliteKillFromTheStepInWhichItCame) {
  const std::string run = folder("polite").string();
  const int ended = call_interrupted("run " + case_ + " --progress none -o '" + run + "' > /dev/null 2>&1", SIGTERM,
                                     [&] { return read_text(run + "/history.csv").size() > 8000; });
  ASSERT_NE(ended, -1);
  const json stopped = summary_of(run);
  ASSERT_TRUE(stopped.is_object());
  EXPECT_FALSE(checkpoints(run).empty());
  if (stopped.at("status") != "complete") {
    EXPECT_EQ(resume("polite", 2).exit_code, 0);
  }
  expect_same_as_undisturbed("polite");
}

TEST_F(Resume, NeedsNoMoreThanTheLastCheckpointsWhichAreKept) {
  run_up_to(200, "kept", 1, "--set checkpoint.keep=3 --set checkpoint.steps=20");
  EXPECT_EQ(checkpoints(folder("kept")).size(), 3U);
  run_up_to(60, "none", 1, "--set checkpoint.keep=0");
  EXPECT_TRUE(checkpoints(folder("none")).empty());
}

TEST_F(Resume, HasEachCheckpointCountedOnce) {
  // So far apart that each is finished long before the next one begins.
  run_up_to(450, "seldom", 1, "--set checkpoint.steps=200");
  const json counts = summary_of(folder("seldom")).at("checkpoints");
  EXPECT_EQ(counts.at("written"), 3) << "and one at the end";
  EXPECT_EQ(counts.at("failed"), 0);
}

TEST_F(Resume, LeavesNoLineTwiceAndNoneOut) {
  run_up_to(130, "lines", 2);
  EXPECT_EQ(resume("lines", 1).exit_code, 0);
  std::int64_t last = -1, ends = 0;
  for (const json& line : status_lines(folder("lines"))) {
    ASSERT_TRUE(line.is_object());
    if (!line.contains("state")) continue;
    EXPECT_GE(line.at("step").get<std::int64_t>(), last);
    last = line.at("step");
    if (line.at("state") != "running") ++ends;
  }
  EXPECT_EQ(ends, 1) << "the end that was not the last is dropped";
}

}  // namespace
}  // namespace breccia::test::resume_test
