#include "domains/derived.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/model.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

TEST(Derived, KnowsTheJointOfBothItsFaces) {
  const Model model = build_model(test::two_boxes_case());
  const Derived derived = derive(model);
  std::size_t faces = 0;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const JointFace& face = model.joints[j].face;
    EXPECT_EQ(derived.joint_at(model.local.slot_of_element[at(face.a)], face.face_a), static_cast<Index>(j));
    EXPECT_EQ(derived.joint_at(model.local.slot_of_element[at(face.b)], face.code / 3), static_cast<Index>(j));
    EXPECT_TRUE(is_swept(model, derived, model.local.slot_of_element[at(face.a)], face.face_a));
  }
  for (const Index joint : derived.joint_of_face) faces += joint >= 0;
  EXPECT_EQ(faces, 2 * model.joints.size()) << "no other face has one";
}

TEST(Derived, LeavesJointsAtSharedNodesToTheActiveList) {
  std::string text = test::kTwoBoxesCase;
  const std::string right = "group = \"right\"\nyoung", law = "[[joint]]\ngroup = \"right\"";
  text.replace(text.find(right), right.size(), "group = \"right\"\njoints = \"none\"\nyoung");
  const std::size_t first = text.find(law);
  text.erase(first, text.find("[[joint]]", first + 1) - first);
  const Model model = build_model(test::two_boxes_case({}, text));
  const Derived derived = derive(model);
  std::size_t between = 0;
  for (const ModelJoint& joint : model.joints) {
    const Index a = model.local.slot_of_element[at(joint.face.a)], b = model.local.slot_of_element[at(joint.face.b)];
    const bool shared = std::max(a, b) >= model.local.num_own_slots;
    between += shared;
    EXPECT_EQ(is_swept(model, derived, std::min(a, b), a < b ? joint.face.face_a : joint.face.code / 3), !shared);
  }
  EXPECT_GT(between, 0u);
}

TEST(SweepOrder, HasEveryBlockOnceAndFirstThoseThatAreSentOrHeld) {
  const Model model = build_model(test::two_boxes_case());
  Derived derived = derive(model);
  std::vector<std::uint8_t> sent(at(model.local.num_own_blocks()), 0);
  sent[1] = 1;
  NodalConstraint held;
  held.nodes = {own_corner_node(3 * kLanes + 2, 1)};
  StageLoads loads;
  loads.constraints = {held};
  plan_sweep_order(model, loads, sent, derived);
  std::vector<int> times(sent.size(), 0);
  for (const auto* runs : {&derived.ahead, &derived.rest}) {
    for (const BlockRun& run : *runs) {
      EXPECT_LE(run.end - run.first, kLongestRun);
      for (Index block = run.first; block < run.end; ++block) {
        ++times[at(block)];
        EXPECT_EQ(runs == &derived.ahead, block == 1 || block == 3) << "block " << block;
      }
    }
  }
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

}  // namespace
}  // namespace breccia
