#include "contact/displacement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "mesh/raster.hpp"

namespace breccia::displacement_test {
namespace {

constexpr double kRoundOff = 1e-12;  // m, of displacements and positions below 10 m

/// Two separate boxes.
class TwoBoxes {
 public:
  TwoBoxes() {
    const Mesh mesh = make_raster({.boxes = {2, 1, 1}, .gap = {1, 0, 0}}).mesh;
    local_ = build_local_mesh(mesh, {Discretisation::own_nodes}, {1000.0});
    now_ = local_.reference;
  }
  void move(Index body, const Vec3& by) {
    for (Index s = 0; s < local_.num_slots; ++s) {
      for (int c = 0; c < 4 && local_.slot_body[static_cast<std::size_t>(s)] == body; ++c)
        move_node(local_.corner_node(s, c), by);
    }
  }
  void move_node(Index node, const Vec3& by) { store_node(now_.data(), node, load_node(now_.data(), node) + by); }
  [[nodiscard]] double displacement() const { return relative_displacement(local_, now_, local_.reference, {}); }
  [[nodiscard]] const LocalMesh& local() const { return local_; }
  [[nodiscard]] const Field<double>& now() const { return now_; }

 private:
  LocalMesh local_;
  Field<double> now_;
};

TEST(Displacement, IsNothingWhenAllMoveTogether) {
  TwoBoxes boxes;
  for (const Index body : {0, 1}) boxes.move(body, {3, -4, 5});
  EXPECT_NEAR(boxes.displacement(), 0, kRoundOff);
}

TEST(Displacement, IsHalfTheWayBetweenTwoThatMeet) {
  TwoBoxes boxes;
  boxes.move(1, {-0.3, 0.4, 1.2});
  EXPECT_NEAR(boxes.displacement(), 0.65, kRoundOff);
}

TEST(Displacement, IsThatOfTheFastestWhenTheyFlyApart) {
  TwoBoxes boxes;
  boxes.move(0, {1, 0, 0});
  boxes.move(1, {-1, 0, 0});
  EXPECT_NEAR(boxes.displacement(), 1, kRoundOff);
}

TEST(Displacement, BoundsHowFarAnyTwoNodesHaveMovedAgainstEachOther) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    TwoBoxes boxes;
    const Vec3 drift(normal(random), normal(random), normal(random));
    std::vector<Vec3> moved;
    for (Index n = 0; n < boxes.local().num_nodes; ++n) {
      const Vec3 by = drift + 0.2 * Vec3(normal(random), normal(random), normal(random));
      boxes.move_node(n, by);
      if (boxes.local().counted[static_cast<std::size_t>(n)] != 0) moved.push_back(by);
    }
    double apart = 0;
    for (const Vec3& a : moved) {
      for (const Vec3& b : moved) apart = std::max(apart, (a - b).norm());
    }
    EXPECT_LE(apart, 2 * boxes.displacement() + kRoundOff);
  }
}

TEST(DisplacementWatch, ActsOnWhatHasReallyMovedAndOnNothingElse) {
  TwoBoxes boxes;
  DisplacementWatch watch;
  watch.restart();
  const auto used_up = [&](double ahead) {
    return watch.used_up(1.0, ahead, boxes.local(), boxes.now(), boxes.local().reference, {});
  };
  for (int i = 0; i < 100; ++i) {  // trembling: 10 m of path
    boxes.move(1, {i % 2 == 0 ? 0.1 : -0.1, 0, 0});
    watch.step(0.1);
    ASSERT_FALSE(used_up(0));
  }
  double moved = 0;  // beside the other box: half of it counts
  while (!used_up(0) && moved < 10) {
    boxes.move(1, {0, 0.1, 0});
    watch.step(0.1);
    moved += 0.1;
    ASSERT_LE(boxes.displacement(), 1.0 + kRoundOff);
  }
  EXPECT_GT(moved, 1.4);
  EXPECT_LE(moved, 2.0 + kRoundOff);
  watch.restart();
  watch.step(0.9);
  EXPECT_FALSE(used_up(0.1));
  EXPECT_TRUE(used_up(0.2)) << "what is still to come counts";
}

/// A box that goes further with every step, the other at rest; lengths are told a step late or two.
TEST(DisplacementWatch, CountsStepsTwiceThatAreNotKnownYet) {
  for (const int late : {0, 1, 2}) {
    TwoBoxes boxes;
    DisplacementWatch watch(late);
    Field<double> then = boxes.now();
    int times = 0;
    std::vector<double> lengths(static_cast<std::size_t>(late), 0.0);
    for (int step = 0; step < 200; ++step) {
      lengths.push_back(0.01 + 0.0002 * step);
      boxes.move(1, {lengths.back(), 0, 0});
      watch.step(lengths[lengths.size() - 1 - static_cast<std::size_t>(late)]);
      const bool used_up = watch.used_up(0.3, 0, boxes.local(), boxes.now(), then, {});
      EXPECT_LE(relative_displacement(boxes.local(), boxes.now(), then, {}), 0.3) << late << " late, step " << step;
      if (!used_up) continue;
      ++times;
      then = boxes.now();
      watch.restart();
    }
    // 5.98 m of way, half of it counts: ten times the allowance.
    EXPECT_GE(times, 10) << late;
    EXPECT_LE(times, 14) << late;
  }
}

}  // namespace
}  // namespace breccia::displacement_test
