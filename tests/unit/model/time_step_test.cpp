#include "model/time_step.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "unit/model/two_boxes.hpp"

namespace breccia::time_step_test {
namespace {

int faces_in(const std::vector<std::uint8_t>& bits) {
  int faces = 0;
  for (const std::uint8_t of_slot : bits) faces += std::popcount(of_slot);
  return faces;
}

TEST(TimeStep, IsLongerThanTheBoundByElementByARatioThatThePiecesOfAModelTakeOver) {
  Model model = build_model(test::two_boxes_case());
  const TimeStep whole(model);
  EXPECT_GT(whole.ratio(), 1.0);
  EXPECT_DOUBLE_EQ(whole.limit(model.local.reference), whole.ratio() * whole.bound(model.local.reference).step);
  model.whole.step_ratio = 1.5;
  EXPECT_EQ(TimeStep(model).ratio(), 1.5);
}

TEST(TimeStep, KnowsTheFacesThatContactMayPressOn) {
  const Model model = build_model(test::two_boxes_case());
  int free = 0;
  for (const auto& links : model.topology.links) {
    for (const FaceLink& link : links) free += link.free();
  }
  const TimeStep time_step(model);
  EXPECT_EQ(faces_in(time_step.open_faces(nullptr).open), free);
  EXPECT_EQ(faces_in(time_step.open_faces(nullptr).torn), 0) << "no face of a body looks at another of it";

  CornerClusters clusters(model.mesh, model.topology);
  const JointFace& joint = model.joints.front().face;
  std::vector<Index> changed;
  clusters.break_faces(std::vector<Topology::Face>{{joint.a, joint.face_a}, {joint.b, joint.code / 3}}, changed);
  EXPECT_EQ(faces_in(time_step.open_faces(&clusters).open), free + 2);
  EXPECT_EQ(faces_in(time_step.open_faces(&clusters).torn), 2);
}

TEST(TimeStep, CountsNodesAsHeldThatNoConstraintLeavesFreeAlongAnyAxis) {
  const Model model = build_model(test::two_boxes_case());
  NodalConstraint along_x, along_yz;
  along_x.nodes = {1, 2};
  along_x.axes = {true, false, false};
  along_yz.nodes = {2, 3};
  along_yz.axes = {false, true, true};
  const std::vector<std::uint8_t> held = TimeStep(model).held_nodes({along_x, along_yz});
  ASSERT_EQ(held.size(), at(model.local.num_nodes));
  for (Index n = 0; n < model.local.num_nodes; ++n) EXPECT_EQ(held[at(n)], n == 2) << "node " << n;
}

TEST(StepLimitText, NamesWhatSetsTheStep) {
  StableStep step;
  step.element = 17;
  step.limit = StepLimit::element;
  EXPECT_EQ(limit_text(step), "element 17");
  step.limit = StepLimit::joint;
  step.neighbour = 43;
  EXPECT_EQ(limit_text(step), "the joint between elements 17 and 43");
  step.neighbour = -1;
  EXPECT_EQ(limit_text(step), "the joints of element 17");
  step.limit = StepLimit::contact;
  EXPECT_EQ(limit_text(step), "the contact penalty on element 17");
}

}  // namespace
}  // namespace breccia::time_step_test
