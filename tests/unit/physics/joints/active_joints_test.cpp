#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "physics/active_joints.hpp"

namespace breccia::active_joints_test {
namespace {

TEST(ActiveJoints, KeepTheirOrderAndContentsWhileOthersComeAndGo) {
  std::mt19937 random(3);
  ActiveJoints list;
  std::map<GlobalId, double> expected;  // id -> area, by which a joint is known again
  for (int round = 0; round < 300; ++round) {
    std::map<GlobalId, double> batch;
    for (unsigned k = random() % 8; k > 0; --k) {
      const auto id = static_cast<GlobalId>(random() % 500);
      if (!expected.contains(id)) batch[id] = round + 0.125 * k;
    }
    std::vector<ActiveJoint> joints(batch.size());
    std::transform(batch.begin(), batch.end(), joints.begin(), [](const auto& entry) {
      ActiveJoint joint;
      joint.id = entry.first;
      joint.history.area = entry.second;
      joint.law = static_cast<Index>(joint.id % 3);
      return joint;
    });
    list.insert(joints);
    expected.insert(batch.begin(), batch.end());
    const auto leaves = [&](GlobalId id) { return (id + round) % 31 == 0; };
    std::vector<GlobalId> leaving;
    for (const ActiveJoint& joint : list) {
      if (leaves(joint.id)) leaving.push_back(joint.id);
    }
    list.erase(leaving);
    std::erase_if(expected, [&](const auto& entry) { return leaves(entry.first); });

    ASSERT_EQ(list.size(), expected.size());
    auto next = expected.begin();
    std::size_t i = 0;
    for (const ActiveJoint& joint : list) {
      ASSERT_EQ(joint.id, next->first);
      ASSERT_EQ(joint.history.area, next->second);
      ASSERT_EQ(joint.law, joint.id % 3);
      ASSERT_EQ(list[i++].id, joint.id);
      ++next;
    }
  }
  EXPECT_GT(list.size(), 20U);
}

}  // namespace
}  // namespace breccia::active_joints_test
