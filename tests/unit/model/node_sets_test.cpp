#include "model/node_sets.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/error.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::node_sets_test {
namespace {

/// Boxes of shared nodes: two as kTwoBoxes has them, and one on top of both.
const std::string kThreeBoxes = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.5, 1, 1};
Box(3) = {0, 1, 0, 1.5, 0.5, 1};
BooleanFragments{ Volume{1, 2, 3}; Delete; }{}
MeshSize{:} = 0.4;
Physical Volume("left", 1) = {1};
Physical Volume("right", 2) = {2};
Physical Volume("top", 3) = {3};
)";

std::string material(const std::string& group) {
  return "[[material]]\ngroup = \"" + group +
         "\"\nyoung = \"40 GPa\"\npoisson = 0.2\ndensity = 2400\njoints = \"none\"\n";
}

std::string interface(const std::string& groups) {
  return "[[joint]]\nbetween = [" + groups + "]\ntensile_strength = \"1 MPa\"\nenergy_mode_1 = \"100 J/m2\"\n";
}

/// Of a geometry that the folder holds when the model is built.
case_::Case case_of(const std::string& tables, const std::string& geometry = test::kTwoBoxes) {
  static const case_::CaseFolder folder;
  folder.write("geometry.geo", geometry);
  const std::string text = "[mesh]\nfile = \"geometry.geo\"\nglue = true\n" + tables + "[[stage]]\nend = \"1 ms\"\n";
  return case_::read_case(folder.write("case.toml", text), {});
}

Model model_of(const std::string& geometry, const std::string& tables) {
  return build_model(case_of(tables, geometry));
}

/// @param call  throws InputError. Its one problem.
template <class Call>
Problem only_problem(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1u);
    return error.problems().front();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

std::set<GlobalId> node_ids(const LocalMesh& local) {
  std::set<GlobalId> ids(local.node_id.begin(), local.node_id.end());
  ids.erase(-1);
  return ids;
}

const std::string kTwoMaterials = material("left") + material("right");

TEST(NodeSets, AreOneWhereNoJointsPartGroups) {
  const Model model = model_of(test::kTwoBoxes, kTwoMaterials);
  EXPECT_TRUE(model.whole.node_sets.empty());
  EXPECT_TRUE(model.joints.empty());
  EXPECT_EQ(node_ids(model.local).size(), model.mesh.nodes.size());
}

TEST(NodeSets, GiveBothSidesOfAnInterfaceTheirOwnNodesWithJointsBetween) {
  const Model model = model_of(test::kTwoBoxes, kTwoMaterials + interface("\"left\", \"right\""));
  const auto& faces = model.topology.surface_groups[0];  // "interface", from both sides
  ASSERT_EQ(model.joints.size(), faces.size() / 2);
  std::set<Index> on_interface;
  for (const ModelJoint& joint : model.joints) {
    const Index a = model.local.slot_of_element[at(joint.face.a)], b = model.local.slot_of_element[at(joint.face.b)];
    EXPECT_NE(model.mesh.element_group[at(joint.face.a)], model.mesh.element_group[at(joint.face.b)]);
    for (const int corner : kFaceCorners[at(joint.face.face_a)]) {
      on_interface.insert(model.local.vertex[at(a)][at(corner)]);
      for (int c = 0; c < 4; ++c) EXPECT_NE(model.local.corner_node(a, corner), model.local.corner_node(b, c));
    }
  }
  const std::set<GlobalId> ids = node_ids(model.local);
  EXPECT_EQ(ids.size(), model.mesh.nodes.size() + on_interface.size());
  for (const Index node : on_interface) {
    for (const Index set : {0, 1}) EXPECT_EQ(ids.count(shared_node_id(set, node)), 1u);
    EXPECT_EQ(mesh_node_of(shared_node_id(1, node)), node);
  }
}

TEST(NodeSets, AreOwnForEveryGroupWhereAnyTwoHaveALaw) {
  const std::string three = kTwoMaterials + material("top");
  EXPECT_EQ(model_of(kThreeBoxes, three + interface("\"*\", \"*\"")).whole.node_sets, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(model_of(kThreeBoxes, three + interface("\"top\", \"*\"")).whole.node_sets, (std::vector<Index>{0, 0, 2}));
}

TEST(NodeSets, AreSharedAcrossInterfacesThatHaveNoLaw) {
  const std::string three = kTwoMaterials + material("top");
  const Model model = model_of(kThreeBoxes, three + interface("\"left\", \"right\"") + interface("\"right\", \"top\""));
  EXPECT_EQ(model.whole.node_sets, (std::vector<Index>{0, 1, 0}));
  EXPECT_TRUE(share_nodes(model.discretisation, model.whole.node_sets, 0, 2));
  EXPECT_FALSE(share_nodes(model.discretisation, model.whole.node_sets, 1, 2));
}

TEST(NodeSets, AreRefusedWhereAThirdGroupHoldsBothSidesTogether) {
  const std::string tables = kTwoMaterials + material("top") + interface("\"left\", \"right\"");
  const Problem problem = only_problem([&] { return model_of(kThreeBoxes, tables); });
  EXPECT_EQ(problem.key, "joint[0].between");
  EXPECT_THAT(problem.what, testing::HasSubstr("share their nodes with another group that lies beside both"));
}

TEST(NodeSets, OfAStateCannotBePartedByTheCaseThatStartsFromIt) {
  const WholeModel shared = model_of(test::kTwoBoxes, kTwoMaterials).whole;
  const std::string bonded = kTwoMaterials + interface("\"left\", \"right\"");
  const WholeModel parted = model_of(test::kTwoBoxes, bonded).whole;
  const case_::Case input = case_of(bonded);
  EXPECT_NO_THROW(check_laws(input, parted));
  const Problem problem = only_problem([&] { check_laws(input, shared); });
  EXPECT_EQ(problem.key, "joint[0].between");
  EXPECT_THAT(problem.what, testing::HasSubstr("in the state that this case starts from"));
}

}  // namespace
}  // namespace breccia::node_sets_test
