// What ParaView's implementation is given, and the bridge to its Python; what is refused before a run.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"
#include "catalyst2/blueprint_check.hpp"
#include "catalyst2/opened_standin.hpp"

namespace breccia::test::scripts_test {
namespace {

const std::string kScript = std::string(BRECCIA_CATALYST_SCRIPTS) + "/uses_surface.py";
constexpr std::uint32_t kAll = (1U << BRECCIA_NUM_CHANNELS) - 1;
constexpr std::uint32_t kSurface = 1U << BRECCIA_SURFACE, kFractures = 1U << BRECCIA_FRACTURES;

/// The functions of the bridge, in their order.
struct Bridge {
  const char* (*scripts)();
  const char* (*turn)();
  int (*agree)(const char* text);
  void (*done)(const char* error);
  int (*request)(const char* name, double value);
  void (*spare)(void* display);
  void (*note)(const char* script, const char* lines);
};

TEST(Catalyst2Scripts, OfParaViewRunOneAtATimeAndSayWhatTheyFailOf) {
  Standin& standin = fresh_standin("paraview");
  SyntheticRun run(2, world().rank, world().size);
  const auto folder = fresh_folder("scripts");
  Config config(folder, world().communicator, world().rank, world().size);
  config.add(kScript, {"width"}, {640}).text("caption", "half \"open\"").add("stress");
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    const StandinTree& given = standin.initialized;
    EXPECT_EQ(names_below(given, "catalyst/scripts"),
              (std::vector<std::string>{"breccia_bridge", "uses_surface", "stress"}));
    EXPECT_TRUE(std::filesystem::exists(leaf_of(given, "catalyst/scripts/breccia_bridge/filename")->words));
    EXPECT_EQ(leaf_of(given, "catalyst/scripts/uses_surface/filename")->words, kScript);
    EXPECT_EQ(leaf_of(given, "catalyst/scripts/uses_surface/args/0")->words,
              "folder=" + (folder / "uses_surface").string());
    EXPECT_EQ(leaf_of(given, "catalyst/scripts/uses_surface/args/1")->words, "caption=half \"open\"");
    EXPECT_EQ(leaf_of(given, "catalyst/scripts/uses_surface/args/2")->words, "width=640");
    const std::string address = leaf_of(given, "catalyst/scripts/breccia_bridge/args/0")->words;
    const Bridge& bridge = *reinterpret_cast<const Bridge*>(std::strtoull(address.c_str(), nullptr, 10));
    EXPECT_EQ(nlohmann::json::parse(bridge.scripts())[0]["parameters"],
              (nlohmann::json{{"caption", {nullptr, "half \"open\""}}, {"width", {640, nullptr}}}))
        << bridge.scripts();

    // All scripts are read at the first execution, which therefore has all their channels.
    EXPECT_EQ(adaptor.channels(0, 0, 0), kSurface | kFractures);
    std::string turn;
    standin.on_execute = [&] {
      turn = bridge.turn();
      bridge.request("stop", 1);
      if (world().rank == 0) bridge.note(kScript.c_str(), "one\nwarning: two\n");  // what others have is taken out
      bridge.done("");
    };
    EXPECT_EQ(adaptor.execute(1, run.at(0, kAll)), 0) << adaptor.text;
    EXPECT_EQ(turn, kScript);
    EXPECT_EQ(adaptor.requests.stop, 1);
    EXPECT_EQ(adaptor.notices(), "pipeline " + kScript + ": one\nwarning: pipeline " + kScript + ": two\n");
    EXPECT_EQ(adaptor.notices(), "") << "each is reported once";
    EXPECT_EQ(leaf_of(standin.executed.back(), "catalyst/state/parameters/0")->words, "pipeline=" + kScript);

    // From then on its own, and no cell of the others.
    EXPECT_EQ(adaptor.channels(0, 10, 0), kSurface);
    EXPECT_EQ(adaptor.execute(1, run.at(10, kAll)), 0) << adaptor.text;
    const StandinTree& tree = standin.executed.back();
    EXPECT_EQ(names_below(tree, "catalyst/channels"), (std::vector<std::string>{"fractures", "surface"}));
    EXPECT_EQ(leaf_of(tree, "catalyst/channels/fractures/data/topologies/mesh/elements/connectivity")->count, 0);
    EXPECT_NE(leaf_of(tree, "catalyst/channels/fractures/data/fields/time_of_failure/values"), nullptr);

    standin.on_execute = [&] {
      if (world().rank == world().size - 1)
        bridge.done("ValueError: on purpose (uses_surface.py:4)");
      else
        bridge.done("");
    };
    EXPECT_EQ(adaptor.execute(1, run.at(20, kAll)), 1);
    EXPECT_EQ(adaptor.text, kScript + ": ValueError: on purpose (uses_surface.py:4)");
    standin.on_execute = nullptr;
    EXPECT_EQ(adaptor.execute(2, run.at(20, kAll)), 2);
    EXPECT_NE(adaptor.text.find("stress: ParaView has not run the script"), std::string::npos) << adaptor.text;
    EXPECT_EQ(standin.problems, std::vector<std::string>{});
  }
  // Before the end nothing of the solver's memory is pointed to any more.
  for (const StandinLeaf& leaf : standin.executed.back()) EXPECT_EQ(leaf.count, 0) << leaf.path;
  EXPECT_EQ(standin.finalized, 1);
  EXPECT_EQ(standin.live_nodes, 0);

  Text text;
  EXPECT_EQ(plugin().open(&config.get(), text.text, sizeof text.text), nullptr);
  EXPECT_NE(text.string().find("cannot be started twice"), std::string::npos) << text.string();
}

std::string problems(Config& config) {
  Text text;
  return plugin().preflight(&config.get(), text.text, sizeof text.text) == 0 ? "" : text.string();
}

Config config_of(const std::string& pipeline) {
  Config config("/tmp", -1, 0, 1);
  config.add(pipeline);
  return config;
}

TEST(Catalyst2Preflight, SaysWhatCannotWorkAndWhatToDo) {
  const auto told = [](const std::string& pipeline, const std::string& library, const std::string& implementation) {
    name_catalyst(library, implementation);
    Config config = config_of(pipeline);
    return problems(config);
  };
  EXPECT_EQ(told("stress", BRECCIA_STANDIN, "paraview"), "");
  EXPECT_EQ(told(kScript, BRECCIA_STANDIN, "paraview"), "");
  EXPECT_EQ(told("surface", BRECCIA_STANDIN, "standin"), "");
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(told("surface", BRECCIA_STANDIN, "paraview"),
         "surface: this recording is not made by ParaView's implementation");
  expect(told("live", BRECCIA_STANDIN, "standin"),
         "live: the live link is not Catalyst 2's; it needs the adaptor with");
  expect(told("stress", BRECCIA_STANDIN, "standin"), "stress: is a script for ParaView");
  expect(told("probes", BRECCIA_STANDIN, "standin"),
         "probes: samples are not made by Catalyst 2; that needs the adaptor with");
  name_catalyst(BRECCIA_STANDIN, "paraview");
  Config fields = config_of(kScript);
  expect(problems(fields.fields({"stress"})),
         "uses_surface.py: ParaView's implementation of Catalyst 2 reads all scripts");
  Config kinds = config_of("stress");
  expect(problems(kinds.text("width", "wide")), "stress: the parameter 'width' is a number, or a text with a unit");
  const std::string misspelt =
      told(std::string(BRECCIA_CATALYST_SCRIPTS) + "/../../catalyst/scripts/misspelt.py", BRECCIA_STANDIN, "paraview");
  expect(misspelt, "misspelt.py: the source 'fractrues' is no channel; allowed: fractures, ");
  expect(misspelt, "misspelt.py: 'von_misses' is no array of surface; allowed: von_mises, ");
  expect(told("surface", BRECCIA_STANDIN, "nobody"), "has no implementation 'nobody'; tried ");
  expect(told("surface", "/nowhere/libcatalyst.so.3", "standin"),
         "libcatalyst, the library of Catalyst 2, cannot be opened (/nowhere/");
  expect(told("surface", "/nowhere/libcatalyst.so.3", "standin"),
         "install a ParaView from 5.12 on that is built with Catalyst");
  expect(told("surface", BRECCIA_LACKING, "standin"),
         "is no libcatalyst of version 2, it lacks catalyst_finalize, catalyst_about, ");
}

TEST(Catalyst2Preflight, HonoursTheEnvironment) {
  unsetenv("BRECCIA_LIBCATALYST");
  setenv("CATALYST_IMPLEMENTATION_PATHS",
         ("/nowhere:" + std::filesystem::path(BRECCIA_STANDIN).parent_path().string() + "/catalyst").c_str(), 1);
  setenv("CATALYST_IMPLEMENTATION_NAME", "standin", 1);
  Text text;
  EXPECT_EQ(plugin().find(text.text, sizeof text.text), 0) << text.string();
  EXPECT_NE(text.string().find(BRECCIA_STANDIN), std::string::npos) << text.string();
  EXPECT_NE(text.string().find("'standin'"), std::string::npos) << text.string();
  unsetenv("CATALYST_IMPLEMENTATION_NAME");
  EXPECT_EQ(plugin().find(text.text, sizeof text.text), 0) << text.string();
  EXPECT_NE(text.string().find("'paraview'"), std::string::npos) << text.string();
  unsetenv("CATALYST_IMPLEMENTATION_PATHS");
}

}  // namespace
}  // namespace breccia::test::scripts_test
