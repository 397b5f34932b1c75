// What is refused before a run, without MPI, and what an adaptor leaves behind.

#include <dirent.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "unit/system/file_size_limit.hpp"

namespace breccia::test::preflight_test {
namespace {

constexpr int kWithoutMpi = -1;

std::filesystem::path folder_of(const std::string& name) {
  const auto folder = std::filesystem::path(BRECCIA_TEST_FOLDER) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string script(const std::string& name) { return std::string(BRECCIA_SCRIPTS) + "/" + name; }

/// What preflight says; "" when it says that all can run.
std::string preflight(Config& config) {
  Text text;
  const bool refused = plugin().preflight(&config.get(), text.text, sizeof text.text) != 0;
  EXPECT_EQ(refused, !text.string().empty());
  return text.string();
}

/// Sets an environment variable, or removes it (nullptr), as long as it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { old_.empty() ? unsetenv(name_) : setenv(name_, old_.c_str(), 1); }

 private:
  const char* name_;
  std::string old_;
};

/// Processes called `name` whose parent is this one.
int children_called(const std::string& name) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string pid, command, state;
    pid_t parent = 0;
    if (stat >> pid >> command >> state >> parent && command == "(" + name + ")" && parent == getpid() && state != "Z")
      ++count;
  }
  return count;
}

/// An X server without GLX, as long as it lives.
class PoorServer {
 public:
  /// @param file  gets the number of its display
  explicit PoorServer(const std::filesystem::path& file) {
    child_ = ::fork();
    if (child_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      static_cast<void>(!std::freopen(file.c_str(), "w", stdout));
      ::execlp("Xvfb", "Xvfb", "-displayfd", "1", "-nolisten", "tcp", "-extension", "GLX", nullptr);
      ::_exit(127);
    }
    std::string number;
    for (int tenths = 0; number.empty() && tenths < 600; ++tenths) {
      ::usleep(100000);
      std::ifstream(file) >> number;
    }
    EXPECT_NE(number, "");
    name_ = ":" + number;
  }
  PoorServer(const PoorServer&) = delete;
  PoorServer& operator=(const PoorServer&) = delete;
  ~PoorServer() {
    ::kill(child_, SIGTERM);
    ::waitpid(child_, nullptr, 0);
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  pid_t child_;
  std::string name_;
};

TEST(Preflight, AcceptsWhatCanRun) {
  Config config(folder_of("fine"), kWithoutMpi, 0, 1);
  config.add("volume").add("history").add("live", 1U << BRECCIA_SURFACE).live(22222).add(script("exported.py"));
  EXPECT_EQ(preflight(config), "");
}

TEST(Preflight, NamesEveryProblemOnALineOfItsOwn) {
  Config config("/proc", kWithoutMpi, 0, 1);
  config.add("nonsense")
      .add(script("missing.py"))
      .add(script("syntax_error.py"))
      .add("surface", {"width"}, {3.0})
      .add("live")
      .live(70000)
      .add("volume")
      .add("volume");
  std::istringstream lines(preflight(config));
  std::vector<std::string> problems;
  for (std::string line; std::getline(lines, line);) problems.push_back(line);
  EXPECT_THAT(
      problems,
      testing::UnorderedElementsAre(
          testing::StartsWith("/proc: cannot be written into: "),
          testing::AllOf(testing::StartsWith("nonsense: no pipeline has this name; allowed: volume, joints, fractures"),
                         testing::HasSubstr("absolute path")),
          script("missing.py") + ": No such file or directory",
          testing::AllOf(testing::StartsWith(script("syntax_error.py") + ": "),
                         testing::EndsWith("(syntax_error.py:3)")),
          "surface: has no parameter 'width', it has none", "live: the port must be 1 to 65535, it is 70000",
          "volume: writes into the same folder as the pipeline volume"));
}

TEST(Preflight, KnowsTheParametersOfItsOwnScriptsAndOfAUsersTheNearestFirst) {
  Config config(folder_of("parameters"), kWithoutMpi, 0, 1);
  config.add("stress", {"widht"}, {640.0}).add(script("exported.py"), {"anything"}, {1.0});
  config.add(script("count_cells.py"), {"factr"}, {1.0});
  std::istringstream lines(preflight(config));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_THAT(line, testing::StartsWith("stress: has no parameter 'widht'; allowed: width, "));
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, script("exported.py") + ": has no parameter 'anything', it has none");
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, script("count_cells.py") + ": has no parameter 'factr'; allowed: factor, label");
}

TEST(Preflight, RefusesANumberWhereAScriptAsksForATextAndTheOtherWayRound) {
  Config config(folder_of("kinds"), kWithoutMpi, 0, 1);
  config.add(script("count_cells.py"), {"label"}, {3.5}).text("factor", "wide");
  EXPECT_EQ(preflight(config), script("count_cells.py") +
                                   ": the parameter 'factor' is a number, or a text with a unit; given: \"wide\"\n" +
                                   script("count_cells.py") + ": the parameter 'label' is a text; given: 3.5");
  Config pictures(folder_of("pictures_of_kinds"), kWithoutMpi, 0, 1);
  pictures.add("stress", {"width"}, {640}).text("title", "half open");
  EXPECT_EQ(preflight(pictures), "");
}

TEST(Preflight, RefusesPointDataThatThereIsNone) {
  Config config(folder_of("point_data"), kWithoutMpi, 0, 1);
  config.add("surface").text("point_data", "velocty");
  config.add("volume").text("point_data", "stress, von_mises");
  config.add("fractures").text("point_data", "stress");
  config.add("domains", {"point_data"}, {3});
  EXPECT_EQ(preflight(config),
            "surface: point_data has no field 'velocty'; allowed: displacement, velocity, stress, von_mises, "
            "principal, plastic_shear, compaction, plastic_work\n"
            "fractures: point_data: only the channels elements and surface have values at points\n"
            "domains: point_data is a text, names of fields separated by commas");
}

TEST(Preflight, RefusesAScriptThatAsksForValuesAtPointsWhereThePipelineDoesNot) {
  Config config(folder_of("no_point_data"), kWithoutMpi, 0, 1);
  config.add(script("contours.py"));
  EXPECT_EQ(preflight(config), script("contours.py") +
                                   ": the array 'von_mises' is one of cells; at points too with parameters = { "
                                   "point_data = \"von_mises\" } (contours.py:6)");
  EXPECT_EQ(preflight(config.text("point_data", "von_mises")), "");
}

TEST(Preflight, RefusesAScriptThatAsksForAnArrayThatItIsNotHanded) {
  Config config(folder_of("not_handed"), kWithoutMpi, 0, 1);
  config.add(script("exported.py")).fields({"id", "stress"});
  EXPECT_THAT(preflight(config), testing::AllOf(testing::StartsWith(script("exported.py") + ": the array '"),
                                                testing::HasSubstr("' is not handed over, it is not among the "
                                                                   "pipeline's fields: id, stress (exported.py:")));
}

TEST(Preflight, RefusesAScriptWhoseSourcesOrArraysAreMisspeltOrOfAnotherChannel) {
  Config config(folder_of("misspelt"), kWithoutMpi, 0, 1);
  std::istringstream lines(preflight(config.add(script("misspelt.py"))));
  std::vector<std::string> problems;
  for (std::string line; std::getline(lines, line);) problems.push_back(line);
  const std::string begin = script("misspelt.py") + ": ";
  EXPECT_THAT(
      problems,
      testing::UnorderedElementsAre(
          testing::AllOf(testing::StartsWith(begin + "the source 'fractrues' is no channel; allowed: fractures, "),
                         testing::EndsWith("(misspelt.py:7)")),
          testing::AllOf(testing::StartsWith(begin + "'von_misses' is no array of surface; allowed: von_mises, "),
                         testing::EndsWith("(misspelt.py:8)")),
          begin + "the array 'opening' is one of joints, fractures; the script uses surface (misspelt.py:9)"));
}

TEST(Preflight, RefusesPicturesWhereThereIsNeitherDisplayNorXvfb) {
  const auto tools = folder_of("tools");
  const Environment no_display("DISPLAY", nullptr);
  Config config(folder_of("no_display"), kWithoutMpi, 0, 1);
  config.add(script("draws_surface.py")).add(script("exported.py"));
  EXPECT_EQ(preflight(config), "") << "Xvfb is installed";
  const Environment no_xvfb("PATH", tools.c_str());
  EXPECT_THAT(preflight(config),
              testing::AllOf(testing::StartsWith(script("draws_surface.py") + ": pictures need an X display"),
                             testing::HasSubstr("xvfb"), testing::Not(testing::HasSubstr("exported"))));
}

TEST(Preflight, RefusesADisplayOnWhichNothingCanBeDrawn) {
  const auto folder = folder_of("no_glx");
  Config config(folder, kWithoutMpi, 0, 1);
  config.add(script("draws_surface.py"));
  const std::string begin = script("draws_surface.py") + ": pictures need an X display: ";
  std::string name;
  {
    const PoorServer server(folder / "number");
    name = server.name();
    {
      const Environment chosen("BRECCIA_DISPLAY", name.c_str());
      EXPECT_EQ(preflight(config),
                begin + name + ", of BRECCIA_DISPLAY, has no GLX, without which nothing can be drawn");
    }
    const Environment given("DISPLAY", name.c_str());
    EXPECT_EQ(preflight(config), "") << "Xvfb is installed";
    const Environment no_xvfb("PATH", folder.c_str());
    EXPECT_THAT(preflight(config), testing::StartsWith(begin + name +
                                                       " has no GLX, without which nothing can be drawn "
                                                       "and Xvfb is not installed"));
  }
  const Environment gone("BRECCIA_DISPLAY", name.c_str());
  EXPECT_EQ(preflight(config), begin + name + ", of BRECCIA_DISPLAY, does not open");
}

TEST(Preflight, RefusesAProgramOfAnotherInterface) {
  Config config(folder_of("interface"), kWithoutMpi, 0, 1);
  BrecciaConfig other = config.add("surface").get();
  other.abi_version = BRECCIA_INSITU_ABI_VERSION + 1;
  Text text;
  EXPECT_NE(plugin().preflight(&other, text.text, sizeof text.text), 0);
  EXPECT_THAT(text.string(), testing::HasSubstr("do not belong together"));
}

TEST(Preflight, CutsItsTextToTheRoomThatThereIs) {
  Config config("/proc", kWithoutMpi, 0, 1);
  char text[8] = "xxxxxxx";
  EXPECT_NE(plugin().preflight(&config.add("nonsense").get(), text, sizeof text), 0);
  EXPECT_STREQ(text, "/proc: ");
}

TEST(Extracts, ReportAFolderThatHasGoneAndGoOnWhenItIsBack) {
  const auto folder = folder_of("going");
  SyntheticRun run(2, 0, 1);
  Config config(folder, kWithoutMpi, 0, 1);
  Adaptor adaptor(config.add("surface").add("history").get());
  const auto both = (1U << BRECCIA_SURFACE) | (1U << BRECCIA_HISTORY);
  EXPECT_EQ(adaptor.execute(3, run.at(1, both)), 0U) << adaptor.text;
  std::filesystem::rename(folder / "surface", folder / "away");
  std::ofstream(folder / "surface") << "in the way";
  EXPECT_EQ(adaptor.execute(3, run.at(2, both)), 1U) << adaptor.text;
  EXPECT_THAT(adaptor.text, testing::AllOf(testing::StartsWith("surface: " + (folder / "surface").string()),
                                           testing::Not(testing::HasSubstr("\n"))));
  std::filesystem::remove(folder / "surface");
  std::filesystem::rename(folder / "away", folder / "surface");
  EXPECT_EQ(adaptor.execute(3, run.at(3, both)), 0U) << adaptor.text;
  std::ostringstream index;
  index << std::ifstream(folder / "surface/surface.pvd").rdbuf();
  EXPECT_THAT(index.str(), testing::AllOf(testing::HasSubstr("surface_000000001.pvtp"),
                                          testing::Not(testing::HasSubstr("surface_000000002.pvtp")),
                                          testing::HasSubstr("surface_000000003.pvtp")));
}

TEST(Extracts, TellOfAFullDiskAndGoOnWhenThereIsSpaceAgain) {
  constexpr rlim_t kNothingFits = 100;  // bytes
  const auto folder = folder_of("full");
  SyntheticRun run(4, 0, 1);
  Config config(folder, kWithoutMpi, 0, 1);
  Adaptor adaptor(config.add("volume").add("surface").add("history").get());
  const auto all = (1U << BRECCIA_ELEMENTS) | (1U << BRECCIA_SURFACE) | (1U << BRECCIA_HISTORY);
  EXPECT_EQ(adaptor.execute(7, run.at(1, all)), 0U) << adaptor.text;
  {
    const FileSizeLimit full(kNothingFits);
    EXPECT_EQ(adaptor.execute(7, run.at(2, all)), 7U) << adaptor.text;
  }
  EXPECT_EQ(std::count(adaptor.text.begin(), adaptor.text.end(), '\n'), 2) << adaptor.text;
  for (const std::string name : {"elements", "surface"})
    EXPECT_THAT(adaptor.text,
                testing::ContainsRegex(name + "_000000002/.0000.vt[pu].tmp: cannot be written: File too large"));
  EXPECT_EQ(adaptor.execute(7, run.at(3, all)), 0U) << adaptor.text;
  std::ifstream history(folder / "history/history.csv");
  std::vector<std::string> steps;
  for (std::string line; std::getline(history, line);) steps.push_back(line.substr(0, line.find(',')));
  EXPECT_EQ(steps, (std::vector<std::string>{"step", "1", "3"}));
}

TEST(Extracts, ContinueARecordingThatIsThereUpToTheirFirstStep) {
  const auto folder = folder_of("continued");
  SyntheticRun run(2, 0, 1);
  for (const auto& steps : {std::vector<std::int64_t>{1, 2, 3}, std::vector<std::int64_t>{3, 4}}) {
    Config config(folder, kWithoutMpi, 0, 1);
    Adaptor adaptor(config.add("domains").add("history").get());
    for (const auto step : steps)
      EXPECT_EQ(adaptor.execute(3, run.at(step, (1U << BRECCIA_DOMAINS) | (1U << BRECCIA_HISTORY))), 0U)
          << adaptor.text;
  }
  std::ostringstream index;
  index << std::ifstream(folder / "domains/domains.pvd").rdbuf();
  for (const char* entry : {"_000000001.", "_000000002.", "_000000003.", "_000000004."})
    EXPECT_THAT(index.str(), testing::HasSubstr(entry));
  EXPECT_EQ(index.str().find("_000000003."), index.str().rfind("_000000003."));
  std::ifstream history(folder / "history/history.csv");
  std::string line;
  int lines = 0;
  while (std::getline(history, line)) ++lines;
  EXPECT_EQ(lines, 5);
}

void on_signal(int) {}

TEST(Adaptor, DrawsOnADisplayOfItsOwnWithoutMpiAndLeavesSignalsDisplayAndProcessesAsTheyWere) {
  const Environment no_display("DISPLAY", nullptr);
  constexpr int kSignals[] = {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGUSR1, SIGHUP, SIGPIPE};
  plugin();  // loads Open MPI 5 with UCX, which takes signals while it is loaded; the solver has loaded it before it
             // takes its own
  for (const int signal : kSignals) std::signal(signal, &on_signal);
  const auto expect_signals = [&](const char* when) {
    for (const int signal : kSignals) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      EXPECT_EQ(action.sa_handler, &on_signal) << "signal " << signal << " after " << when;
    }
  };
  const auto folder = folder_of("drawn");
  SyntheticRun run(4, 0, 1);
  {
    Config config(folder, kWithoutMpi, 0, 1);
    Adaptor adaptor(config.add(script("draws_surface.py")).get());
    ASSERT_TRUE(adaptor.is_open());
    expect_signals("open");
    EXPECT_EQ(children_called("Xvfb"), 1);
    EXPECT_EQ(adaptor.channels(0, 1, 0.0), 1U << BRECCIA_SURFACE);
    EXPECT_EQ(adaptor.execute(1, run.at(1, 1U << BRECCIA_SURFACE)), 0U) << adaptor.text;
    run.take_away();
    expect_signals("execute");
    EXPECT_GT(adaptor.bytes(0), 1000);
  }
  expect_signals("close");
  EXPECT_EQ(children_called("Xvfb"), 0);
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
  EXPECT_GT(std::filesystem::file_size(folder / "draws_surface/surface_000001.png"), 1000U);
}

}  // namespace
}  // namespace breccia::test::preflight_test
