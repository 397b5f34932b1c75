#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "end_to_end/program.hpp"

/// Keys of the case that stand for others, or for the content of files: the run is that of the case written out.
namespace breccia::test::case_keys_test {
namespace {

using nlohmann::json;

/// The state hash of a run.
std::string hash_of(const std::filesystem::path& folder) {
  return json::parse(read_text(folder / "summary.json")).at("state_hash");
}

std::string run(const Scratch& scratch, const std::string& file, const std::string& name, int ranks = 1) {
  const std::string folder = scratch.path(name).string();
  const std::string arguments =
      "run " + file + " --progress none --set time.max_steps=60 --set output.frame_interval=0 -o '" + folder + "'";
  const Outcome outcome = ranks == 1 ? call(arguments) : call_ranks(ranks, arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return hash_of(folder);
}

TEST(EveryGroup, OfMaterialsAndJointsRunsAsTheGroupsByNameOnAnyRanks) {
  const Scratch scratch;
  std::string text = kSmallCase;
  for (const char* list : {"[[material]]\n", "[[joint]]\n"}) {
    const std::string named = std::string(list) + "group = \"box\"";
    text.replace(text.find(named), named.size(), std::string(list) + "group = \"*\"");
  }
  const std::string expected = run(scratch, scratch.write("named.toml", kSmallCase), "named");
  const std::string any = scratch.write("any.toml", text);
  EXPECT_EQ(run(scratch, any, "any"), expected);
  EXPECT_EQ(run(scratch, any, "two", 2), expected);
  const Outcome resumed = call("resume '" + scratch.path("any").string() + "' --set time.max_steps=80 --progress none");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

TEST(TimeHistory, OfAFileRunsAsTheSamePointsInTheCaseAlsoWhenResumedWithoutTheFile) {
  const Scratch scratch;
  scratch.write("p.csv", "\xef\xbb\xbft [us];p (kPa)\r\n0;0\r\n30;2\r\n90;-1.5\r\n");
  const auto with = [](const std::string& value) {
    return changed("[output]", "[[stage.pressure]]\nsurface = \"box.x1\"\nvalue = " + value + "\n[output]");
  };
  const std::string points = "{ table = [[0, 0], [\"30 us\", \"2 kPa\"], [\"90 us\", \"-1.5 kPa\"]] }";
  const std::string expected = run(scratch, scratch.write("table.toml", with(points)), "table");
  const std::string file = scratch.write("csv.toml", with("{ csv = { file = \"p.csv\" } }"));
  EXPECT_EQ(run(scratch, file, "csv"), expected);
  EXPECT_EQ(run(scratch, file, "two", 2), expected);
  const Outcome check = call("check " + file);
  EXPECT_NE(check.out.find("stage[0].pressure[0].value: p.csv, 3 points from 0 s to 90 us, from -1.5 kPa to 2 kPa"),
            std::string::npos)
      << check.out;
  EXPECT_NE(check.out.find("p.csv ends at 90 us"), std::string::npos) << check.out;
  const json provenance = json::parse(read_text(scratch.path("csv") / "provenance.json"));
  EXPECT_NE(provenance.dump().find("p.csv"), std::string::npos) << provenance.dump();

  std::filesystem::remove(scratch.path("p.csv"));
  const std::string on = " --set time.max_steps=90 --progress none";
  for (const char* name : {"table", "csv"}) {
    const Outcome resumed = call("resume '" + scratch.path(name).string() + "'" + on);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  }
  EXPECT_EQ(hash_of(scratch.path("csv")), hash_of(scratch.path("table")));
}

}  // namespace
}  // namespace breccia::test::case_keys_test
