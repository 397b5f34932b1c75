#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/recorder.hpp"

namespace breccia::test::impact_test {
namespace {

/// Two elastic cubes of 24 tetrahedra, turned at random, fly at each other and part again.
std::string colliding_cubes(int seed) {
  return "title = \"two cubes\"\n[mesh.raster]\ncells = 1\ncell_size = 0.1\nboxes = [2, 1, 1]\ngap = [0.08, 0, "
         "0]\ngroup = \"cube\"\n"
         "random_orientation = true\nseed = " +
         std::to_string(seed) +
         "\n[[material]]\ngroup = \"cube\"\nyoung = \"4 MPa\"\npoisson = 0.3\ndensity = 2340\njoints = \"none\"\n"
         "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"40 MPa\"\n[contact_points]\nper_face = 6\n"
         "[[initial_velocity]]\ngroup = \"cube\"\nrandom = [0.3, 0.5]\nseed = " +
         std::to_string(seed) + "\n[[stage]]\nname = \"fly\"\nend = 0.6\n[time]\nsafety = 0.1\n";
}

TEST(CollidingCubes, KeepLinearAndAngularMomentumToRoundOffAndTheirEnergy) {
  int collisions = 0;
  for (const int seed : {10, 14, 19, 24}) {  // of those whose cubes meet
    const Recording run = run_case_text(colliding_cubes(seed));
    const HistoryRow &first = run.rows.front(), &last = run.rows.back();
    const double speed = first.max_speed, mass = 2 * 2340 * 1e-3;
    constexpr double kRoundOff = 1e-12;
    EXPECT_LT((last.momentum - first.momentum).norm(), kRoundOff * mass * speed);
    EXPECT_LT((last.angular_momentum - first.angular_momentum).norm(), kRoundOff * mass * speed * 1.0);
    constexpr double kLost = 5e-3;  // kinks of the overlap at edges, met with finite steps
    EXPECT_LT(run.worst_residual(), kLost);
    for (const HistoryRow& row : run.rows) collisions += row.contacts > 0 ? 1 : 0;
  }
  EXPECT_GT(collisions, 0) << "nothing has touched: the test shows nothing";
}

TEST(SlidingBlock, StopsWhereFrictionHasTakenItsEnergy) {
  const Recording run = run_case_file("sliding_block/case.toml");
  constexpr double kExpected = 1.0 / (2 * 0.5 * 9.81);  // m, v^2 / (2 mu g)
  constexpr double kTolerance = 0.01;
  EXPECT_NEAR(run.rows.back().gauges[0].displacement[0] / kExpected, 1.0, kTolerance);
  EXPECT_LT(run.worst_residual(), 1e-3);
}

/// Points on the lower edge of its front are on that face as well, which looks along the floor: pushed by what lies
/// below, they stopped it after four fifths of the way.
TEST(SlidingBlock, StopsThereWithPointsOnItsCornersAsWell) {
  const Recording run = run_case_file("sliding_block/case.toml", {"contact_points.per_face=4"});
  constexpr double kExpected = 1.0 / (2 * 0.5 * 9.81);  // m
  constexpr double kTolerance = 0.01;
  EXPECT_NEAR(run.rows.back().gauges[0].displacement[0] / kExpected, 1.0, kTolerance);
  EXPECT_LT(run.worst_residual(), 1e-3);
}

TEST(SlidingBlock, IsNotStoppedByEdgesOfACoarseFloor) {
  // Of those whose front has met points of the floor just above its lower edge.
  struct Slide {
    double speed, friction, block, floor;
  };
  constexpr double kGravity = 9.81, kTolerance = 0.02;
  for (const Slide& s : {Slide{1.0, 0.7, 0.008, 0.04}, {1.0, 0.5, 0.008, 0.03}, {1.3, 0.7, 0.008, 0.05}}) {
    const double way = s.speed * s.speed / (2 * s.friction * kGravity);
    const auto quoted = [](double number) { return std::to_string(number); };
    const Recording run = run_case_file(
        "sliding_block/case.toml",
        {"mesh.parameters.h=" + quoted(s.block), "mesh.parameters.floor_h=" + quoted(s.floor),
         "contact[0].friction=" + quoted(s.friction), "initial_velocity.block.velocity=[" + quoted(s.speed) + ",0,0]"});
    EXPECT_NEAR(run.rows.back().gauges[0].displacement[0] / way, 1.0, kTolerance) << s.speed << " m/s, " << s.friction;
  }
}

TEST(ContactPair, ReturnsTwoOverBPlusOneOfWhatItTook) {
  // Work goes in until the turn and comes out on the way back; sampled at the history interval.
  for (const auto& [file, returned] :
       {std::pair{"contact_pair/case.toml", 1.0}, {"contact_pair/case_b.toml", 2.0 / 3.0}}) {
    const Recording run = run_case_file(file);
    double largest = 0;
    for (const HistoryRow& row : run.rows) largest = std::max(largest, row.energy.external_work);
    constexpr double kSampling = 2e-3;
    EXPECT_NEAR(1 - run.rows.back().energy.external_work / largest, returned, kSampling) << file;
    EXPECT_LT(run.worst_residual(), 1e-3);
  }
}

}  // namespace
}  // namespace breccia::test::impact_test
