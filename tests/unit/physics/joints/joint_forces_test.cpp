#include "physics/joint_forces.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <set>

#include "unit/physics/joints/joint_pair.hpp"

namespace breccia::joint_forces_test {
namespace {

using test::example_law;
using test::JointPair;
using test::kEnergy;
using test::NodalWork;
using test::prepared;

constexpr double kArea = 173.2050808e-6;  // m2
constexpr double kPeak = 5e-4;            // asked of the law
constexpr double kRoundOff = 1e-12;
constexpr double kLastStep = 1e-6;  // the last step ends beyond the critical opening

/// Opens the pair along a direction until nothing is left; the largest force along it, N, and what it took, J.
struct Pulled {
  double peak_x = 0, peak_y = 0, work = 0, dissipated = 0;
};
Pulled pull(JointPair& pair, const Vec3& direction, double step) {
  Pulled p;
  NodalWork work(pair);
  for (int i = 1; i < 200000 && !pair.joints.empty(); ++i) {
    pair.open(direction * (i * step));
    pair.evaluate();
    p.work = work.add();
    p.peak_x = std::max(p.peak_x, -pair.force_on_b()[0]);
    p.peak_y = std::max(p.peak_y, -pair.force_on_b()[1]);
    if (pair.joints.size() == 1 && pair.joints[0].state() == JointState::failed) break;
  }
  p.dissipated = pair.dissipated();
  return p;
}

TEST(JointForces, Reach866NInEachModeAndTheFractureEnergyOfTheFace) {
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    JointLawParams law = example_law();
    law.points = points;
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0).normalized().eval()}) {
      JointPair pair(prepared(law));
      const Pulled p = pull(pair, direction, 2e-9);
      const double expected = direction[0] * direction[1] > 0 ? 612.37 : 866.025;
      EXPECT_NEAR(p.peak_x / expected, direction[0] > 0 ? 1.0 : 0.0, kPeak);
      EXPECT_NEAR(p.peak_y / expected, direction[1] > 0 ? 1.0 : 0.0, kPeak);
      EXPECT_NEAR(p.work / (kEnergy * kArea), 1.0, 1e-3);
      EXPECT_NEAR(p.dissipated / p.work, 1.0, kLastStep);
    }
  }
}

TEST(JointForces, OfThePublishedLawReach866NInBothModesAtOnce) {
  JointPair pair(test::reference_law(JointRise::parabolic));
  const Pulled p = pull(pair, Vec3(1, 1, 0).normalized(), 2e-9);
  EXPECT_NEAR(p.peak_x / 866.025, 1.0, kPeak);
  EXPECT_NEAR(p.peak_y / 866.025, 1.0, kPeak);
}

TEST(JointForces, InTheElasticRangeAreStiffnessTimesOpeningToTheLastBit) {
  const JointLawParams law = prepared(example_law());
  for (int turn = 0; turn < 81; ++turn) {
    JointPair pair(law, Discretisation::own_nodes, turn / 9, turn % 9);
    std::mt19937 random(static_cast<unsigned>(turn));
    pair.shake(random, 0.1 * law.onset_normal);
    pair.evaluate();
    const double stiffness = law.stiffness * pair.virgin.history.area / 3.0;
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double expected = stiffness * (pair.place(false, i)[axis] - pair.place(true, i)[axis]);
        EXPECT_EQ(pair.force(true, i)[axis], expected);
        EXPECT_EQ(pair.force(false, i)[axis], -expected);
      }
    }
    EXPECT_EQ(pair.joints[0].damage(), 0.0);
    EXPECT_EQ(pair.dissipated(), 0.0);
  }
}

TEST(JointForces, LeaveAJointCalmOnlyWithoutDamageAndWithinHalfItsElasticRange) {
  const JointLawParams law = prepared(example_law());
  JointPair pair(law);
  const auto calm_at = [&](double opening) {
    pair.open(Vec3(opening, 0, 0));
    pair.evaluate();
    return pair.joints[0].elastic;
  };
  EXPECT_TRUE(calm_at(0.49 * law.onset_normal));
  EXPECT_FALSE(calm_at(0.51 * law.onset_normal));
  EXPECT_FALSE(calm_at(-1.5 * law.onset_normal));  // undamaged, but beyond what the sweep can tell
  EXPECT_TRUE(calm_at(-0.49 * law.onset_normal));
  EXPECT_FALSE(calm_at(1.5 * law.onset_normal));
  ASSERT_GT(pair.joints[0].damage(), 0.0);
  EXPECT_FALSE(calm_at(0.1 * law.onset_normal));
}

TEST(JointForces, OfACrossingJointAreTheSameBitsFromBothSidesAndFromTheActiveList) {
  JointLawParams law = example_law();
  law.friction = 0.6;
  std::set<int> codes;
  for (const int points_to_fail : {1, 3}) {
    law.points_to_fail = points_to_fail;
    for (int turn = 0; turn < 81; ++turn) {
      JointPair pair(prepared(law), Discretisation::own_nodes, turn / 9, turn % 9);
      codes.insert(pair.virgin.code);
      std::mt19937 random(static_cast<unsigned>(turn));
      pair.shake(random, (turn % 5 + 1) * 0.5 * pair.laws[0].onset_normal);
      double on_a[9], on_b[9];
      virgin_forces(pair.laws[0], pair.local, pair.position.data(), pair.virgin, true, on_a);
      virgin_forces(pair.laws[0], pair.local, pair.position.data(), pair.virgin, false, on_b);
      pair.evaluate();
      const int face_b = pair.virgin.code / 3;
      for (int i = 0; i < 3; ++i) {
        const Index node_b = pair.local.corner_node(
            pair.virgin.slot_b, kFaceCorners[static_cast<std::size_t>(face_b)][static_cast<std::size_t>(i)]);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(on_a[3 * i + axis], pair.force(true, i)[axis]);
          EXPECT_EQ(on_b[3 * i + axis], pair.forces.get(node_b)[axis]);
        }
      }
      EXPECT_EQ(pair.virgin.damage(), 0.0);
    }
  }
  EXPECT_GE(codes.size(), 6U);
}

TEST(JointForces, ConserveLinearMomentumAndWhereOpenAngularMomentum) {
  JointLawParams law = example_law();
  law.friction = 0.6;
  law.cohesion *= 2;
  law.energy_mode_2 *= 5;
  for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
    law.points = points;
    JointPair pair(prepared(law));
    std::mt19937 random(2);
    for (int step = 1; step <= 200; ++step) {
      pair.position = pair.local.reference;
      pair.open(Vec3(1.5 + 0.004 * step, 0.003 * step, 0) * pair.laws[0].onset_normal);
      pair.shake(random, 0.1 * pair.laws[0].onset_normal);
      pair.evaluate();
      ASSERT_FALSE(pair.joints.empty());
      Vec3 force(0, 0, 0), moment(0, 0, 0);
      double size = 0;
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(pair.force(true, i), Vec3(-pair.force(false, i)));
        for (const bool side_a : {true, false}) {
          force += pair.force(side_a, i);
          moment += pair.place(side_a, i).cross(pair.force(side_a, i));
          size += pair.force(side_a, i).norm();
        }
      }
      ASSERT_GT(pair.joints[0].damage(), 0.0);
      EXPECT_LE(force.norm(), kRoundOff * size);
      // Forces of mid-edge points act at corners: parallel to the edge's mean opening, not each corner's own.
      if (points == JointPoints::nodal) {
        EXPECT_LE(moment.norm(), kRoundOff * size * test::kEdge);
      }
    }
  }
}

TEST(JointForces, OfMidEdgePointsGoToTheTwoCornersOfEachEdge) {
  JointLawParams law = example_law();
  law.points = JointPoints::mid_edge;
  JointPair pair(prepared(law));
  const double opening = 0.1 * pair.laws[0].onset_normal;
  const Index node = pair.corner(false, 0);
  store_node(pair.position.data(), node, load_node(pair.position.data(), node) + Vec3(opening, 0, 0));
  pair.evaluate();
  // Half the opening on the two edges at corner 0: of their tractions k opening/2 on A/3 half stays there, a quarter
  // goes to each other.
  const double whole = pair.laws[0].stiffness * opening * kArea / 3;
  EXPECT_NEAR(pair.force(true, 0)[0] / (whole / 2), 1.0, 1e-6);
  EXPECT_NEAR(pair.force(true, 1)[0] / (whole / 4), 1.0, 1e-6);
  EXPECT_NEAR(pair.force(true, 2)[0] / (whole / 4), 1.0, 1e-6);
}

TEST(JointForces, TurnWithTheBodyAndTakeTheSameEnergy) {
  JointLawParams law = example_law();
  law.friction = 0.6;
  law = prepared(law);
  JointPair still(law), moving(law);
  const double closed = -2e6 / law.stiffness;
  for (int step = 1; step <= 400; ++step) {
    // Closes, is sheared until it breaks, opens.
    const double shear = step * 0.1e-6, normal = step < 250 ? closed : closed + (step - 250) * 5e-8;
    still.open(Vec3(normal, shear, 0.5 * shear));
    still.evaluate();
    moving.position = moving.local.reference;
    moving.open(Vec3(normal, shear, 0.5 * shear));
    const Mat3 turn = Eigen::AngleAxisd(0.01 * step, Vec3(0.6, 0, 0.8)).toRotationMatrix() *
                      Eigen::AngleAxisd(0.02 * step, Vec3(1, 0, 0)).toRotationMatrix();
    for (Index n = 0; n < moving.local.num_nodes; ++n) {
      store_node(moving.position.data(), n, turn * load_node(moving.position.data(), n) + Vec3(0.1, 0.2, 0.3));
    }
    moving.evaluate();
    ASSERT_EQ(still.joints.size(), moving.joints.size());
    // Positions are rounded to 1e-17 m on openings whose k times that is some 1e-4 N/m2 a metre: relative to the peak
    // force.
    for (int i = 0; i < 3; ++i)
      ASSERT_LT((moving.force(false, i) - turn * still.force(false, i)).norm(), 1e-7 * 866) << step;
    if (still.joints.empty()) break;
    ASSERT_NEAR(moving.stored(), still.stored(), 1e-7 * kEnergy * kArea);
  }
  EXPECT_TRUE(still.joints.empty());
}

TEST(JointForces, ActOnSharedNodesAsWell) {
  const JointLawParams law = prepared(example_law());
  // One node for both sides: no opening, no force.
  JointPair shared(law, Discretisation::shared_nodes);
  shared.evaluate();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(shared.force(true, i), Vec3(0, 0, 0));
  EXPECT_EQ(shared.stored(), 0.0);
}

TEST(JointForces, ComeThroughAFlattenedJointAsNumbers) {
  JointLawParams law = example_law();
  law.friction = 0.5;
  JointPair pair(prepared(law));
  for (int i = 0; i < 3; ++i) store_node(pair.position.data(), pair.corner(true, i), Vec3(1e-5, 0, 0));
  for (int i = 0; i < 3; ++i) store_node(pair.position.data(), pair.corner(false, i), Vec3(2e-5, 0, 0));
  pair.evaluate();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(pair.force(true, i).allFinite());
}

/// Error of the budget when a joint passes from the elastic range, kept by nobody, to the active list in one step.
double crossing_error(const JointLawParams& law, double before, double after) {
  JointPair pair(law);
  NodalWork work(pair);
  const double stiffness = law.stiffness * pair.virgin.history.area;
  // The sweep's part: elastic up to `before`.
  pair.open(Vec3(before, 0, 0));
  pair.joints = {};
  pair.evaluate();
  const double elastic = 0.5 * stiffness * before * before;
  // The crossing step: virgin forces from the sweep, history from start_history.
  pair.open(Vec3(after, 0, 0));
  double on_a[9];
  virgin_forces(law, pair.local, pair.position.data(), pair.virgin, true, on_a);
  const double crossing = 0.5 * (stiffness * before + on_a[0] + on_a[3] + on_a[6]) * (after - before);
  start_history(pair.laws, pair.local, pair.position.data(), std::span(&pair.virgin, 1));
  pair.put_on_list(pair.virgin);
  return elastic + crossing - pair.dissipated() - pair.stored();
}

TEST(JointForces, CrossingIntoDamageKeepsTheBudgetToSecondOrderInTheStep) {
  JointLawParams law = example_law();
  law.softening.shape = SofteningShape::linear;  // leaves the peak with a kink: the hard case
  law = prepared(law);
  const double onset = law.onset_normal;
  const auto worst = [&](double step) {
    double error = 0;
    for (double at = 0.05; at < 1; at += 0.1)
      error = std::max(error, std::abs(crossing_error(law, onset - at * step, onset + (1 - at) * step)));
    return error;
  };
  const double coarse = worst(0.1 * onset), fine = worst(0.05 * onset);
  EXPECT_GT(coarse, 0.0);
  EXPECT_LT(fine, 0.27 * coarse);  // a quarter, and terms of third order
  EXPECT_LT(coarse, 0.005 * kEnergy * kArea);
}

TEST(JointForces, CrossingJointStartsWithTheHistoryThatTheActiveListWouldHaveGivenIt) {
  const JointLawParams law = prepared(example_law());
  JointPair listed(law), crossing(law);
  for (JointPair* pair : {&listed, &crossing}) pair->open(Vec3(1.5, 0.4, 0) * law.onset_normal);
  listed.evaluate();
  start_history(crossing.laws, crossing.local, crossing.position.data(), std::span(&crossing.virgin, 1));
  crossing.put_on_list(crossing.virgin);
  EXPECT_EQ(crossing.stored(), listed.stored());
  EXPECT_EQ(crossing.dissipated(), listed.dissipated());
  EXPECT_GT(listed.dissipated(), 0.0);
  for (JointPair* pair : {&listed, &crossing}) {
    pair->open(Vec3(1.6, 0.5, 0) * law.onset_normal);
    pair->evaluate();
  }
  for (int i = 0; i < 3; ++i) EXPECT_EQ(crossing.force(true, i), listed.force(true, i));
}

}  // namespace
}  // namespace breccia::joint_forces_test
