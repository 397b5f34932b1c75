#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "physics/joint_forces.hpp"
#include "unit/physics/joints/joint_pair.hpp"

namespace breccia::joint_failure_test {
namespace {

using test::example_law;
using test::JointPair;
using test::kEnergy;
using test::NodalWork;
using test::prepared;

constexpr double kArea = 173.2050808e-6;  // m2
constexpr double kRoundOff = 1e-11;       // budget of some 10^4 steps
constexpr double kLastStep = 1e-6;        // of the budget: the last step ends beyond the critical opening
constexpr double kFriction = 0.6;

JointLawParams rough(int points_to_fail = 3) {
  JointLawParams law = example_law();
  law.friction = kFriction;
  law.points_to_fail = points_to_fail;
  return prepared(law);
}

/// Moves the opening from where it is to a target in equal steps and looks at every step.
struct Mover {
  JointPair& pair;
  NodalWork work{pair};
  Vec3 at{0, 0, 0};
  double largest_jump = 0;  // N a metre of opening

  void go(const Vec3& target, int steps, const auto& look) {
    const Vec3 from = at;
    for (int i = 1; i <= steps; ++i) {
      const Vec3 before = pair.force_on_b(), next = from + (target - from) * (static_cast<double>(i) / steps);
      pair.open(next);
      pair.evaluate();
      work.add();
      largest_jump = std::max(largest_jump, (pair.force_on_b() - before).norm() / (next - at).norm());
      at = next;
      look();
    }
  }
  void go(const Vec3& target, int steps) {
    go(target, steps, [] {});
  }
  [[nodiscard]] double unbooked() const { return work.done - pair.dissipated() - pair.stored(); }
};

TEST(JointFailure, InTensionReleasesTheJointAtOnceWithoutForceOrEnergy) {
  JointPair pair(rough());
  Mover mover{pair};
  int failed = 0, released = 0;
  mover.go(Vec3(20e-6, 0, 0), 4000, [&] {
    failed += static_cast<int>(pair.work.failed.size());
    released += static_cast<int>(pair.work.released.size());
    if (!pair.work.released.empty()) {
      EXPECT_EQ(pair.work.released[0].id, 7);
      EXPECT_EQ(pair.work.released[0].slot_a, pair.virgin.slot_a);
      EXPECT_EQ(pair.work.released[0].face_a, pair.virgin.face_a);
      EXPECT_EQ(pair.work.released[0].mode, FailureMode::mode_1);
    }
  });
  EXPECT_EQ(failed, 1);
  EXPECT_EQ(released, 1);
  EXPECT_TRUE(pair.joints.empty());
  EXPECT_EQ(pair.stored(), 0.0);
  EXPECT_NEAR(mover.unbooked(), 0.0, kLastStep * kEnergy * kArea);
}

TEST(JointFailure, UnderPressureLeavesAFrictionalInterfaceUntilItOpens) {
  JointPair pair(rough());
  Mover mover{pair};
  const double pressure = 4e6, closed = -pressure / pair.laws[0].stiffness;
  mover.go(Vec3(closed, 0, 0), 100);
  mover.go(Vec3(closed, 40e-6, 0), 4000);
  ASSERT_EQ(pair.joints.size(), 1U);
  EXPECT_EQ(pair.joints[0].state(), JointState::failed);
  EXPECT_EQ(pair.joints[0].mode(), FailureMode::mode_2);
  EXPECT_NEAR(pair.force_on_b()[0] / (pressure * kArea), 1.0, 1e-8);
  EXPECT_NEAR(pair.force_on_b()[1] / (-kFriction * pressure * kArea), 1.0, 1e-6);
  mover.go(Vec3(closed, 20e-6, 0), 2000);  // slides back
  EXPECT_NEAR(pair.force_on_b()[1] / (kFriction * pressure * kArea), 1.0, 1e-6);
  ASSERT_EQ(pair.joints.size(), 1U);
  mover.go(Vec3(-closed, 20e-6, 0), 2000, [&] { EXPECT_EQ(pair.joints.empty(), mover.at[0] > 0) << mover.at[0]; });
  EXPECT_EQ(pair.stored(), 0.0);
  EXPECT_NEAR(mover.unbooked(), 0.0, kLastStep * kEnergy * kArea);
  // Nowhere did the force change by more than the stiffest branch allows: no jump at failure nor at release.
  EXPECT_LT(mover.largest_jump, 2 * (1 + kFriction) * pair.laws[0].stiffness * kArea);
}

TEST(JointFailure, IsNotFollowedByReleaseWhileOneCornerIsClosed) {
  JointPair pair(rough());
  Mover mover{pair};
  const double closed = -1e6 / pair.laws[0].stiffness;
  mover.go(Vec3(closed, 0, 0), 10);
  mover.go(Vec3(closed, 40e-6, 0), 2000);
  ASSERT_EQ(pair.joints[0].state(), JointState::failed);
  const auto lift = [&](int corner, double height) {
    const Index node = pair.corner(false, corner);
    Vec3 x = load_node(pair.position.data(), node);
    x[0] = load_node(pair.position.data(), pair.corner(true, corner))[0] + height;
    store_node(pair.position.data(), node, x);
  };
  lift(0, 1e-6);
  lift(1, 1e-6);
  pair.evaluate();
  EXPECT_EQ(pair.joints.size(), 1U);
  // Closing again before the third has opened changes nothing.
  lift(0, -1e-8);
  lift(2, 1e-6);
  pair.evaluate();
  ASSERT_EQ(pair.joints.size(), 1U);
  lift(0, 1e-8);
  pair.evaluate();
  EXPECT_TRUE(pair.joints.empty());
  EXPECT_EQ(pair.stored(), 0.0);
}

TEST(JointFailure, OfAMidEdgeJointWaitsForTheCornersToOpen) {
  JointLawParams law = example_law();
  law.points = JointPoints::mid_edge;
  JointPair pair(prepared(law));
  ActiveJoint failed = pair.virgin;
  failed.history.failed = 1;
  for (JointPointHistory<double>& p : failed.history.points) p.damage = 1.0;
  pair.put_on_list(failed);
  pair.open(Vec3(1e-6, 0, 0));
  const Index node = pair.corner(false, 0);
  store_node(pair.position.data(), node, load_node(pair.position.data(), pair.corner(true, 0)) - Vec3(5e-7, 0, 0));
  pair.evaluate();
  EXPECT_EQ(pair.joints.size(), 1U);  // all three edges open in the middle, one corner closed
  pair.open(Vec3(1e-6, 0, 0));
  pair.evaluate();
  EXPECT_TRUE(pair.joints.empty());
}

/// Opens the pair like a hinge about the edge opposite to corner 0.
void hinge(JointPair& pair, double opening) {
  const Index node = pair.corner(false, 0);
  store_node(pair.position.data(), node, load_node(pair.local.reference.data(), node) + Vec3(opening, 0, 0));
}

TEST(JointFailure, WaitsForAsManyPointsAsAskedAndBooksWhatTheOthersHeld) {
  for (const int points_to_fail : {1, 2, 3}) {
    JointPair pair(rough(points_to_fail));
    const double open = 0.5 * pair.laws[0].onset_normal;
    NodalWork work(pair);
    bool failed = false;
    for (int step = 1; step <= 4000 && !pair.joints.empty(); ++step) {
      const double others = open * (std::min(step / 10.0, 1.0) + step / 8000.0);
      pair.open(Vec3(others, 0, 0));
      hinge(pair, others + step * 1e-8);
      const double held = pair.stored(), before = pair.dissipated();
      pair.evaluate();
      work.add();
      EXPECT_GE(pair.dissipated(), before);
      failed = failed || !pair.work.failed.empty();
      if (!pair.work.failed.empty()) {
        EXPECT_GT(held, 0.0);
        EXPECT_GT(pair.stored(), 0.9 * held);  // let go of in kFailureSteps evaluations
      }
    }
    EXPECT_EQ(failed, points_to_fail == 1) << points_to_fail;
    EXPECT_NEAR(work.done - pair.dissipated() - pair.stored(), 0.0, kLastStep * kEnergy * kArea) << points_to_fail;
    EXPECT_EQ(pair.joints.empty(), points_to_fail == 1);
  }
}

/// A joint that hinges about the edge opposite to corner 0, which stays pressed together.
TEST(JointFailure, OfAJointThatHingesHandsItOverBitByBitWhateverItsClosedPointsCarry) {
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    JointLawParams law = rough();
    law.points = points;
    JointPair pair(prepared(law));
    const double closed = -0.2 * pair.laws[0].onset_normal;
    NodalWork work(pair);
    pair.open(Vec3(closed, 0, 0));
    pair.evaluate();
    work.add();
    double largest = 0, dissipated = 0;
    bool failed = false;
    for (int step = 1; step <= 8000 && !pair.joints.empty(); ++step) {
      pair.open(Vec3(closed, 0, 0));
      hinge(pair, step * 5e-8);
      const Vec3 before = pair.force_on_b();
      pair.evaluate();
      work.add();
      if (step > 1) largest = std::max(largest, (pair.force_on_b() - before).norm());
      EXPECT_GE(pair.dissipated(), dissipated);
      dissipated = pair.dissipated();
      failed = failed || !pair.work.failed.empty();
    }
    EXPECT_TRUE(failed);
    EXPECT_TRUE(pair.joints.empty());
    // The closed points press with some 60 N: a sixty-fourth of that a step, and the softening of the open ones.
    EXPECT_LT(largest, 5.0);
    EXPECT_NEAR(work.done - pair.dissipated(), 0.0, 2e-3 * kEnergy * kArea);
  }
}

/// Turns b about an axis in the plane of the faces: corner 0 goes through the face of a, the others open.
void fold(JointPair& pair, double angle) {
  const LocalMesh& local = pair.local;
  const auto rest = [&](int i) { return load_node(local.reference.data(), pair.corner(true, i)); };
  const Vec3 pivot = (2 * rest(0) + rest(1) + rest(2)) / 4, axis = (rest(2) - rest(1)).normalized();
  const double sense = axis.cross(rest(0) - pivot)[0] > 0 ? -1 : 1;
  const Mat3 turn = Eigen::AngleAxisd(sense * angle, axis).toRotationMatrix();
  for (int c = 0; c < 4; ++c) {
    const Index node = local.corner_node(pair.virgin.slot_b, c);
    store_node(pair.position.data(), node, pivot + turn * (load_node(local.reference.data(), node) - pivot));
  }
}

TEST(JointFailure, OfAJointThatFoldsUpComesBeforeItsFacesLieBackToBackHoweverFast) {
  constexpr int kSteps = 40;  // fewer than those of a handover
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    JointLawParams law = rough();
    law.points = points;
    law.points_to_fail = 3;
    JointPair pair(prepared(law));
    int held = 0;
    for (int step = 1; step <= kSteps && !pair.joints.empty(); ++step) {
      const double angle = std::acos(-1.0) * step / kSteps;
      fold(pair, angle);
      pair.evaluate();
      held += pair.joints.empty() ? 0 : 1;
      Vec3 middle[3];
      double open = 0;
      for (int i = 0; i < 3; ++i) {
        middle[i] = 0.5 * (pair.place(true, i) + pair.place(false, i));
        open = std::max(open, (pair.place(false, i) - pair.place(true, i)).norm());
      }
      const double size = std::sqrt(0.5 * (middle[1] - middle[0]).cross(middle[2] - middle[0]).norm());
      EXPECT_TRUE(open < size || pair.joints.empty()) << step;
    }
    EXPECT_GT(held, 0);
    EXPECT_TRUE(pair.joints.empty());
  }
}

TEST(JointFailure, NeverComesToAnUnbreakableJointAndItsForcesDoNotKnowItsMidSurface) {
  JointLawParams law = example_law();
  law.tensile_strength = law.cohesion = std::numeric_limits<double>::infinity();
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    law.points = points;
    JointPair pair(prepared(law));
    hinge(pair, 0.5 * test::kEdge);
    // Corner 0 of the mid-surface comes to lie on the opposite edge: no area is left.
    const Vec3 middle = 0.5 * (pair.place(true, 1) + pair.place(true, 2));
    store_node(pair.position.data(), pair.corner(false, 0), 2 * middle - pair.place(true, 0));
    pair.evaluate();
    ASSERT_EQ(pair.joints.size(), 1U);
    EXPECT_EQ(pair.joints[0].state(), JointState::holding);
    const Vec3 expected = law.stiffness * kArea / 3 * (pair.place(false, 0) - pair.place(true, 0));
    const Vec3 got = pair.force(true, 0) + pair.force(true, 1) + pair.force(true, 2);
    EXPECT_NEAR((got - expected).norm(), 0.0, 1e-9 * expected.norm());
  }
}

TEST(JointFailure, IsRememberedWithTheTimeOfItsEvaluationUntilTheJointIsReleased) {
  JointPair pair(rough());
  const double closed = -4e6 / pair.laws[0].stiffness;
  pair.time = 0.5;
  pair.open(Vec3(closed, 0, 0));
  pair.evaluate();
  EXPECT_EQ(pair.joints[0].time_of_failure, -1.0);
  pair.time = 1.25;
  pair.open(Vec3(closed, 40e-6, 0));
  pair.evaluate();
  ASSERT_EQ(pair.work.failed.size(), 1U);
  EXPECT_EQ(pair.joints[0].time_of_failure, 1.25);
  pair.time = 2.0;
  pair.evaluate();
  EXPECT_EQ(pair.joints[0].time_of_failure, 1.25);
  pair.time = 3.0;
  pair.open(Vec3(1e-6, 40e-6, 0));
  pair.evaluate();
  ASSERT_EQ(pair.work.released.size(), 1U);
  EXPECT_EQ(pair.work.released[0].time_of_failure, 1.25);
}

TEST(JointFailure, ThatOpensAtOnceIsReleasedWithItsTime) {
  JointPair pair(rough());
  pair.time = 0.75;
  pair.open(Vec3(20e-6, 0, 0));
  pair.evaluate();
  ASSERT_EQ(pair.work.released.size(), 1U);
  EXPECT_EQ(pair.work.released[0].time_of_failure, 0.75);
}

TEST(JointFailure, ByHandBooksWhatTheJointHeld) {
  JointPair pair(rough());
  Mover mover{pair};
  mover.go(Vec3(0.7, 0.3, 0) * pair.laws[0].onset_normal, 10);
  const double held = pair.stored();
  ASSERT_GT(held, 0.0);
  ASSERT_EQ(pair.dissipated(), 0.0);
  pair.joints.break_points(std::vector{pair.virgin.id});
  mover.go(mover.at * 1.00001, 1);
  EXPECT_EQ(pair.work.failed.size(), 1U);
  mover.go(mover.at * 1.001, 64);
  EXPECT_TRUE(pair.joints.empty());
  EXPECT_NEAR(mover.unbooked(), 0.0, kRoundOff * held);
  EXPECT_NEAR(pair.dissipated(), held, 2e-3 * held);  // and half a step's work of the force that goes
}

TEST(JointFailure, ModeIsMixedWhenEachModeTookMoreThanAQuarter) {
  const auto mode_at = [](double normal, double shear) {
    JointPair pair(prepared(example_law()));
    for (int i = 1; i <= 4000; ++i) {
      pair.open(Vec3(normal, shear, 0) * (i * 1e-8));
      pair.evaluate();
      if (!pair.work.released.empty()) return pair.work.released[0].mode;
    }
    return FailureMode::none;
  };
  // One law for both modes: their energies stand as the squares of the two parts of the direction.
  EXPECT_EQ(mode_at(1, 0), FailureMode::mode_1);
  EXPECT_EQ(mode_at(std::sqrt(0.8), std::sqrt(0.2)), FailureMode::mode_1);
  EXPECT_EQ(mode_at(std::sqrt(0.7), std::sqrt(0.3)), FailureMode::mixed);
  EXPECT_EQ(mode_at(std::sqrt(0.3), std::sqrt(0.7)), FailureMode::mixed);
  EXPECT_EQ(mode_at(std::sqrt(0.2), std::sqrt(0.8)), FailureMode::mode_2);
}

TEST(JointFailure, AnIntactJointHasNoModeOpeningOrSlip) {
  const ActiveJoint joint;
  EXPECT_EQ(joint.mode(), FailureMode::none);
  EXPECT_EQ(joint.damage(), 0.0);
  EXPECT_EQ(joint.opening(), 0.0);
  EXPECT_EQ(joint.slip(), 0.0);
}

TEST(JointFailure, OpeningAndSlipAreMeansOverThePoints) {
  JointPair pair(prepared(example_law()));
  pair.open(Vec3(2e-6, 3e-6, 4e-6));
  pair.evaluate();
  EXPECT_NEAR(pair.joints[0].opening(), 2e-6, 1e-15);
  EXPECT_NEAR(pair.joints[0].slip(), 5e-6, 1e-15);
  hinge(pair, 5e-6);
  pair.evaluate();
  EXPECT_NEAR(pair.joints[0].opening(), (5e-6 + 2e-6 + 2e-6) / 3, 1e-9);  // the normal tilts by opening/edge
}

TEST(JointFailure, TakesOnlyTheReleasedJointsOffTheListAndKeepsTheOrder) {
  JointPair pair(rough());
  std::vector<ActiveJoint> list;
  for (GlobalId id = 0; id < 6; ++id) {
    list.push_back(pair.virgin);
    list.back().id = 10 * id;
    if (id % 2 == 0) {
      for (JointPointHistory<double>& p : list.back().history.points) p.damage = 1.0;
    }
  }
  pair.joints = ActiveJoints(list);
  pair.open(Vec3(0.5 * pair.laws[0].onset_normal, 0, 0));
  pair.evaluate();
  ASSERT_EQ(pair.work.failed, (std::vector<GlobalId>{0, 20, 40}));
  ASSERT_EQ(pair.work.released.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pair.work.released[i].id, static_cast<GlobalId>(20 * i));
    EXPECT_EQ(pair.joints[i].id, static_cast<GlobalId>(20 * i + 10));
  }
  EXPECT_EQ(pair.joints.size(), 3U);
  // The others hold: 3 elastic joints.
  EXPECT_NEAR(-pair.force_on_b()[0] / (3 * 0.5 * pair.laws[0].tensile_strength * kArea), 1.0, 1e-9);
  pair.evaluate();
  EXPECT_TRUE(pair.work.failed.empty());
  EXPECT_TRUE(pair.work.released.empty());
}

/// Forces of a pair against the slopes of its energy, by moving each corner a little. The pair shall not damage by it.
void expect_gradient(JointPair pair, const char* what) {
  const auto energy = [&](Index node, const Vec3& by) {
    JointPair moved = pair;
    store_node(moved.position.data(), node, load_node(moved.position.data(), node) + by);
    moved.evaluate();
    return moved.stored();
  };
  pair.evaluate();
  constexpr double kStep = 1e-9;        // m
  constexpr double kDifference = 1e-4;  // of the largest force: error of the central difference
  const double scale = pair.force(true, 0).norm() + pair.force(true, 1).norm() + pair.force(true, 2).norm();
  ASSERT_GT(scale, 1.0);
  for (const bool side_a : {true, false}) {
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 by = kStep * Vec3::Unit(axis);
        const Index node = pair.corner(side_a, i);
        const double slope = (energy(node, by) - energy(node, -by)) / (2 * kStep);
        EXPECT_NEAR(pair.force(side_a, i)[axis], -slope, kDifference * scale) << what;
      }
    }
  }
}

TEST(JointFailure, AClosedJointThatHasSlidFarPushesWithTheGradientOfItsEnergy) {
  JointPair pair(prepared(example_law()));
  pair.open({-1e-6, 4e-3, 1e-3});  // a fifth of the edge: far beyond failure in shear, closed
  pair.evaluate();
  ASSERT_EQ(pair.joints.size(), 1U);
  ASSERT_EQ(pair.joints[0].state(), JointState::failed);
  std::mt19937 random(5);
  pair.shake(random, 2e-7);
  expect_gradient(pair, "mixed_mode");
}

TEST(JointFailure, ADamagedJointPullsWithTheGradientOfItsEnergyAlsoWhereItHasSlidAndOpenedFar) {
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    for (const auto& [kind, rise] :
         {std::pair(JointLaw::mixed_mode, JointRise::linear), std::pair(JointLaw::independent_peaks, JointRise::linear),
          std::pair(JointLaw::independent_peaks, JointRise::parabolic)}) {
      JointLawParams law = example_law();
      law.points = points;
      law.law = kind;
      law.rise = rise;
      law.cohesion = 0.5 * law.tensile_strength;
      law.energy_mode_1 = law.energy_mode_2 = 2e4;  // J/m2: critical openings of millimetres
      JointPair pair(prepared(law));
      pair.open({1e-3, 2e-3, 1e-3});
      pair.evaluate();
      ASSERT_GT(pair.joints[0].damage(), 0.0);
      for (const double normal : {0.9e-3, -1e-6}) {  // open, closed
        pair.open({normal, 1.8e-3, 0.9e-3});
        std::mt19937 random(5);
        pair.shake(random, 2e-7);
        expect_gradient(pair, kind == JointLaw::mixed_mode ? "mixed_mode" : "independent_peaks");
      }
    }
  }
}

}  // namespace
}  // namespace breccia::joint_failure_test
