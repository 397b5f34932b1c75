#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "case/reader.hpp"
#include "commands/race.hpp"
#include "detection/point_body/brute_force.hpp"
#include "model/parameters.hpp"
#include "support/raster_case.hpp"

namespace breccia {

namespace {

/// Finds all couples and loses those of odd points, as a search with a defect might.
class ForgetfulSearch final : public detection::PointBodySearch {
 public:
  void search(std::span<const Vec3> points, std::span<const detection::Corners> contactors, double buffer,
              std::vector<detection::Couple>& couples) override {
    complete_.search(points, contactors, buffer, couples);
    std::erase_if(couples, [](const detection::Couple& couple) { return couple.point % 2 != 0; });
  }

 private:
  detection::BruteForce complete_;
};

}  // namespace

/// Takes the place of the library's in this program: whoever asks for "ms" gets the forgetful search.
std::unique_ptr<detection::PointBodySearch> detection::make_search(Algorithm algorithm, double) {
  if (algorithm == Algorithm::ms) return std::make_unique<ForgetfulSearch>();
  return std::make_unique<BruteForce>();
}

namespace {

using enum case_::DetectionAlgorithm;

const std::string kTwoBoxesMeet = test::raster_case({.title = "two boxes meet",
                                                     .group = "box",
                                                     .boxes = {2, 1, 1},
                                                     .gap = 0.2e-3,
                                                     .young = 4e6,
                                                     .poisson = 0.3,
                                                     .density = 2340,
                                                     .contact_penalty = 40e6,
                                                     .end = 4e-3}) +
                                  R"(name = "fly"
[[initial_velocity]]
group = "box"
random = ["2 m/s", "4 m/s"]
seed = 5
[sphere]
centre = ["10 mm", "5 mm", "5 mm"]
radius = "16 mm"
penalty = "40 MPa"
)";

class RaceStates : public testing::Test {
 protected:
  RaceStates() : file_(testing::TempDir() + "/race_states_" + std::to_string(getpid()) + ".toml") {
    std::ofstream(file_) << kTwoBoxesMeet;
  }
  ~RaceStates() override { std::filesystem::remove(file_); }

  RaceResult race(std::vector<case_::DetectionAlgorithm> algorithms) {
    const case_::Case input = case_::read_case(file_);
    RaceSettings settings;
    settings.algorithms = std::move(algorithms);
    settings.buffers = {1};
    settings.time = input.stages.back().end;
    std::ostringstream shown;
    RaceProgress progress(ProgressMode::none, shown, 80);
    return race_case(input, settings, std::make_unique<Model>(build_model(input)), progress, {});
  }

 private:
  std::string file_;
};

TEST_F(RaceStates, AreToldWhenAllSearchesAreRight) {
  const RaceResult result = race({sorted_grid, brute_force});
  EXPECT_FALSE(result.state_hash.empty());
  ASSERT_EQ(result.entries.size(), 2u);
  EXPECT_GT(result.entries[0].least.searches, 1);
}

TEST_F(RaceStates, EndTheRaceWithAnErrorThatNamesBothWhereASearchLosesCouples) {
  try {
    (void)race({sorted_grid, ms});
    FAIL() << "two different states passed";
  } catch (const InternalError& error) {
    const std::string what = error.what();
    EXPECT_THAT(what, testing::ContainsRegex("\\(sorted_grid, buffer auto\\) ends in state [0-9a-f]+"));
    EXPECT_THAT(what, testing::ContainsRegex("\\(ms, buffer auto\\) in state [0-9a-f]+"));
  }
}

}  // namespace
}  // namespace breccia
