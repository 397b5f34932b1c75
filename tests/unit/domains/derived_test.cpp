#include "domains/derived.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/model.hpp"
#include "unit/case/case_files.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::derived_test {
namespace {

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

/// Of a layer of cubes of 10 mm across y.
Model layer_model(const std::string& kind) {
  return build_model(case_::read_text(case_::minimal + "[plane]\nkind = \"" + kind + "\"\naxis = \"y\"\n",
                                      {"mesh.raster.cells=[3, 1, 2]"}));
}

TEST(Derived, HoldsNodesAcrossUnderPlaneStrainAndThoseOfTheLowerSideUnderPlaneStress) {
  for (const bool strain : {true, false}) {
    const Model model = layer_model(strain ? "strain" : "stress");
    const Derived derived = derive(model);
    ASSERT_EQ(derived.free_across.size(), at(model.local.num_nodes));
    for (Index n = 0; n < model.local.num_nodes; ++n) {
      if (model.local.node_id[at(n)] < 0) continue;
      const bool lower = model.local.reference[nodal(n, 1)] < 1e-6;
      EXPECT_EQ(derived.free_across[at(n)], strain || lower ? 0.0 : 1.0) << n;
    }
  }
  EXPECT_TRUE(derive(build_model(test::two_boxes_case())).free_across.empty());
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
}  // namespace breccia::derived_test
