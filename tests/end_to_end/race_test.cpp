#include <gtest/gtest.h>
#include <signal.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "end_to_end/program.hpp"

namespace breccia::test::race_test {
namespace {

using nlohmann::json;

const std::string kCubes = "'" BRECCIA_MESHES "/bouncing_cubes/case_smoke.toml'";
/// Long enough for the boxes to meet, short enough for a test.
const std::string kShort =
    " --from '40 us' --steps 60 --buffers 0.5,3 --algorithms packed_tree,ms,brute_force --progress json";

/// The racers of a race with --progress json, the fastest first; the last line is checked and left out.
std::vector<json> racers(const Outcome& outcome, const std::string& state = "complete") {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<json> found;
  json last;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    last = json::parse(line);
    if (last.contains("algorithm")) found.push_back(last);
  }
  EXPECT_EQ(last.value("state", ""), state) << outcome.out;
  return found;
}

std::string final_hash(const std::string& file, const Scratch& scratch, const std::string& arguments) {
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " -f --progress none -o '" + folder + "' " + arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(read_text(folder + "/summary.json"))["state_hash"];
}

TEST(Race, EveryAlgorithmRacesWithEveryBufferAndWithTheCaseSOwn) {
  const std::vector<json> found = racers(call("race " + kCubes + kShort));
  std::set<std::string> names, hashes;
  double before = 0;
  for (const json& racer : found) {
    names.insert(racer["algorithm"].get<std::string>() + " " + racer["buffer"].get<std::string>());
    hashes.insert(racer["state_hash"].get<std::string>());
    EXPECT_EQ(racer["steps"], 60);
    EXPECT_GE(racer["searches"].get<int>(), 1);
    EXPECT_GT(racer["couples"].get<int>(), 0);
    EXPECT_GT(racer["search_s"].get<double>(), 0);
    EXPECT_GT(racer["contact_s"].get<double>(), 0);
    const double searches = racer["searches"], used = racer["used_up"], one = racer["one_search_s"],
                 search = racer["search_s"];
    EXPECT_GE(used, searches - 1);
    EXPECT_LE(used, searches);
    EXPECT_GT(one, 0);
    EXPECT_LE(searches * one, 1.001 * search) << "searches are a part of all searching";
    EXPECT_LT(search - (searches - used) * one + racer["contact_s"].get<double>(), 60 * racer["step_s"].get<double>());
    EXPECT_GE(racer["step_s"].get<double>(), before) << "the fastest comes first";
    before = racer["step_s"];
  }
  EXPECT_EQ(found.size(), 9u);
  EXPECT_EQ(names.size(), 9u);
  EXPECT_EQ(hashes.size(), 1u);
  const auto own = std::count_if(found.begin(), found.end(), [](const json& r) {
    return r["as_in_case"] && r["algorithm"] == "packed_tree" && r["buffer"] == "auto";
  });
  EXPECT_EQ(own, 1);
}

TEST(Race, ALargerBufferMeansMoreCouplesAndFewerSearchesWhoeverLooks) {
  std::set<std::pair<int, int>> found;  // searches and couples: one pair for each of 0.5, 1 and 3 mm
  for (const json& racer : racers(call("race " + kCubes + " --set 'detection.buffer=1 mm'" + kShort)))
    found.emplace(racer["searches"], racer["couples"]);
  ASSERT_EQ(found.size(), 3u);
  int couples = std::numeric_limits<int>::max();
  for (const auto& pair : found) {
    EXPECT_LT(pair.second, couples) << "with " << pair.first << " searches";
    couples = pair.second;
  }
}

TEST(Race, TwoRanksEndInTheStateOfOne) {
  const std::vector<json> one = racers(call("race " + kCubes + kShort));
  const std::vector<json> two = racers(call_ranks(2, "race " + kCubes + kShort));
  ASSERT_EQ(two.size(), one.size());
  EXPECT_EQ(two.front()["state_hash"], one.front()["state_hash"]);
}

TEST(Race, AllEndWhereARunEnds) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);  // joints break in it, and a stage constrains
  const std::string hash = final_hash(file, scratch, "");
  for (const char* from : {"0", "'2 ms'", "'3.5 ms'"}) {
    const auto found =
        racers(call("race " + file + " --from " + from + " --time '1 s' --buffers 2 --algorithms ms --progress json"));
    ASSERT_FALSE(found.empty()) << from;
    EXPECT_EQ(found.front()["state_hash"], hash) << from;
  }
}

TEST(Race, ARaceMayGoThroughSeveralStages) {
  const Scratch scratch;
  const std::string second =
      "end = \"2 ms\"\n[[stage]]\nname = \"fall\"\nend = \"4 ms\"\ngravity = [0, 0, \"-9.81 m/s2\"]\n";
  const std::string file = scratch.write("case.toml", changed("end = \"4 ms\"\n", second));
  const std::string hash = final_hash(file, scratch, "");
  for (const char* from : {"'1 ms'", "'3 ms'"}) {
    const auto found =
        racers(call("race " + file + " --from " + from + " --time '1 s' --buffers 2 --algorithms ms --progress json"));
    ASSERT_FALSE(found.empty()) << from;
    EXPECT_EQ(found.front()["state_hash"], hash) << from;
  }
}

TEST(Race, TheTableEndsWithLinesThatTheCaseTakes) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("race " + file + " --steps 50 --progress none");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"* ", "ms_slices", "sorted_grid", "packed_tree", "brute_force", "as in the case",
                           "element-steps/s", "best: "}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in\n" << outcome.out;
  }
  const std::size_t from = outcome.out.find("[detection]");
  ASSERT_NE(from, std::string::npos) << outcome.out;
  std::string lines = outcome.out.substr(from);
  lines = lines.substr(0, lines.find("\n\n"));
  const Outcome checked = call("check " + scratch.write("with.toml", kSmallCase + lines + "\n"));
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

TEST(Race, WritesALineForEachRacerOnlyWhenAsked) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::string folder = scratch.path("out").string();
  ASSERT_EQ(
      call("race " + file + " --steps 20 --buffers 2 --algorithms ms,sorted_grid --progress none -o '" + folder + "'")
          .exit_code,
      0);
  const std::string csv = read_text(folder + "/race.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4) << csv;
  EXPECT_EQ(csv.rfind("algorithm,buffer,", 0), 0u) << csv;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(Race, BruteForceStaysAwayFromALargeModelUnlessNamed) {
  const Scratch scratch;
  // 4,608 elements, all contactors, and 2,304 points or more on free faces: over ten million pairs.
  const std::string file = scratch.write("case.toml", changed("cells = [2, 2, 1]", "cells = [8, 8, 3]"));
  const Outcome chosen = call("race " + file + " --steps 1 --buffers 1 --progress none");
  EXPECT_EQ(chosen.exit_code, 0) << chosen.err;
  EXPECT_NE(chosen.out.find("brute_force was left out"), std::string::npos) << chosen.out;
  EXPECT_EQ(chosen.out.find("brute_force  "), std::string::npos) << chosen.out;
  const Outcome named = call("race " + file + " --steps 1 --buffers 1 --algorithms brute_force --progress none");
  EXPECT_NE(named.out.find("* brute_force"), std::string::npos) << named.out << named.err;
}

TEST(Race, AnInterruptEndsItInOrder) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), out = scratch.path("out").string();
  const std::string arguments =
      "race " + file + " --progress json --set 'stage[0].end=100 s' --from '90 s' > '" + out + "'";
  EXPECT_EQ(call_interrupted(arguments, SIGINT, [&] { return !read_text(out).empty(); }), 130);
  EXPECT_NE(read_text(out).find("{\"state\":\"stopped\""), std::string::npos) << read_text(out);
}

}  // namespace
}  // namespace breccia::test::race_test
