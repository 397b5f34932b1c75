#include <gtest/gtest.h>

#include <random>

#include "unit/physics/joints/joint_pair.hpp"

namespace breccia::joint_simd_test {
namespace {

using test::example_law;
using test::JointPair;
using test::prepared;

constexpr GlobalId kJoints = 21;  // some blocks, the last one not full

/// Copies of one joint, some of which start with damage, slip and failure, so that lanes side by side do different
/// things.
std::vector<ActiveJoint> varied(const ActiveJoint& virgin) {
  std::vector<ActiveJoint> joints;
  for (GlobalId id = 0; id < kJoints; ++id) {
    ActiveJoint joint = virgin;
    joint.id = id;
    joint.history.area *= 1.0 + 0.01 * static_cast<double>(id);
    for (std::size_t i = 0; i < 3; ++i) {
      JointPointHistory<double>& p = joint.history.points[i];
      if (id % 3 == 0) continue;
      p.damage = p.level = id % 3 == 1 ? 0.1 * static_cast<double>(i) : 1.0;
      p.strength_share = 1.0 - p.damage;
      p.slip = {1e-7 * static_cast<double>(i), -2e-7};
    }
    if (id % 6 == 5) joint.history.failed = 1;
    joints.push_back(joint);
  }
  return joints;
}

/// All numbers that come of a shaken walk through tension, shear and pressure.
std::vector<double> walk(const JointLawParams& law, Simd simd) {
  JointPair pair(law);
  pair.simd = simd;
  pair.joints = ActiveJoints(varied(pair.virgin));
  std::mt19937 random(11);
  std::vector<double> numbers;
  for (int step = 0; step < 300; ++step) {
    const double turn = 0.06 * step, far = 1e-8 * step;
    pair.open(far * Vec3(std::cos(turn), std::sin(turn), 0.3));
    pair.shake(random, 2e-7);
    pair.evaluate();
    for (int i = 0; i < 3; ++i) {
      for (const bool side_a : {false, true}) {
        for (const double f : pair.force(side_a, i)) numbers.push_back(f);
      }
    }
    numbers.push_back(pair.dissipated());
    numbers.push_back(pair.stored());
    numbers.push_back(static_cast<double>(pair.joints.size()));
    for (const ActiveJoint& joint : pair.joints) {
      for (const JointPointHistory<double>& p : joint.history.points)
        numbers.insert(numbers.end(), {p.damage, p.level, p.strength_share, p.slip[0], p.slip[1]});
    }
  }
  return numbers;
}

std::vector<JointLawParams> laws() {
  std::vector<JointLawParams> all;
  for (const JointLaw kind : {JointLaw::mixed_mode, JointLaw::independent_peaks}) {
    for (const double friction : {0.0, 0.6}) {
      for (const int points_to_fail : {1, 3}) {
        for (const JointPoints points : {JointPoints::nodal, JointPoints::mid_edge}) {
          JointLawParams law = example_law();
          law.law = kind;
          law.viscosity = kJointViscosity;
          law.friction = friction;
          law.points_to_fail = points_to_fail;
          law.points = points;
          all.push_back(prepared(law));
        }
      }
    }
  }
  JointLawParams parabolic = example_law();
  parabolic.law = JointLaw::independent_peaks;
  parabolic.rise = JointRise::parabolic;
  all.push_back(prepared(parabolic));
  return all;
}

TEST(JointSimd, EveryInstructionSetGivesTheSameBits) {
  for (const JointLawParams& law : laws()) {
    const std::vector<double> narrow = walk(law, Simd::sse2);
    EXPECT_GT(narrow.size(), 300U * 20U);
    for (const Simd simd : {Simd::avx2, Simd::avx512}) {
      if (!simd_available(simd)) continue;
      EXPECT_EQ(walk(law, simd), narrow) << name_of(simd);
    }
  }
}

/// One joint on the list against the same joint evaluated alone, by numbers of one lane, at every step anew.
TEST(JointSimd, AJointOfTheListGetsTheBitsOfOneEvaluatedAlone) {
  for (const JointLawParams& law : laws()) {
    JointPair listed(law), alone(law);
    std::mt19937 random(7);
    for (int step = 1; step < 200; ++step) {
      listed.open(Vec3(2e-8, 3e-8, 1e-8) * step);
      listed.shake(random, 1e-7);
      alone.position = listed.position;
      listed.evaluate();
      if (listed.joints.empty()) break;
      const ActiveJoint joint = listed.joints[0];
      start_history(alone.laws, alone.local, alone.position.data(), std::span(&alone.virgin, 1));
      if (joint.state() == JointState::failed) alone.virgin.history.failed = 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const JointPointHistory<double>&p = joint.history.points[i], &q = alone.virgin.history.points[i];
        ASSERT_EQ(p.damage, q.damage) << step;
        ASSERT_EQ(p.strength_share, q.strength_share) << step;
        ASSERT_EQ(p.slip, q.slip) << step;
        if (joint.damage() > 0) {  // elastic ones are summed in another order
          ASSERT_EQ(p.stored, q.stored) << step;
        }
      }
    }
  }
}

}  // namespace
}  // namespace breccia::joint_simd_test
