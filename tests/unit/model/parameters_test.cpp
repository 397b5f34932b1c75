#include "model/parameters.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/stage_loads.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::parameters_test {
namespace {

using test::two_boxes_case;

TEST(ContactParams, OfAPairHoldForPointsOfEitherGroup) {
  const ContactParams params = contact_params(two_boxes_case(), {"left", "right"});
  EXPECT_EQ(params.law(0, 0).penalty, 400e9);
  EXPECT_EQ(params.law(0, 1).penalty, 400e9);
  EXPECT_EQ(params.law(1, 0).penalty, 400e9);
  EXPECT_EQ(params.law(1, 1).penalty, 300e9);
}

TEST(ContactParams, HaveAPenaltyOfTheSofterBodyWhereTheCaseGivesNoneOrAFactor) {
  std::string text = test::kTwoBoxesCase;
  const std::string given = "penalty = \"300 GPa\"";
  text.erase(text.find(given), given.size());
  const std::vector<std::string> softer{"material[1].young=10e9"};
  EXPECT_EQ(contact_params(two_boxes_case(softer, text), {"left", "right"}).law(1, 1).penalty, 10e9);
  const std::string any = "penalty = \"400 GPa\"";
  text.replace(text.find(any), any.size(), "penalty_factor = 3");
  const ContactParams params = contact_params(two_boxes_case(softer, text), {"left", "right"});
  EXPECT_EQ(params.law(0, 1).penalty, 30e9);
  EXPECT_EQ(params.law(1, 0).penalty, 30e9);
  EXPECT_EQ(params.law(0, 0).penalty, 120e9);
}

TEST(ContactParams, OfPointsOnTheFirstGroupHoldForItsPointsAlone) {
  const ContactParams params =
      contact_params(two_boxes_case({"contact[0].points_on=\"first\""}), {"left", "right"});  // left on "*"
  EXPECT_TRUE(params.law(0, 1).active());
  EXPECT_TRUE(params.law(0, 0).active());
  EXPECT_FALSE(params.law(1, 0).active());
  EXPECT_TRUE(params.law(1, 1).active());
}

TEST(ContactParams, OfAPairByNameGoBeforeOneWithAStarThatComesLater) {
  const std::vector<std::string> swapped{"contact[0].between=[\"left\", \"right\"]",
                                         "contact[1].between=[\"*\", \"*\"]"};
  const ContactParams params = contact_params(two_boxes_case(swapped), {"left", "right"});
  EXPECT_EQ(params.law(0, 1).penalty, 400e9);
  EXPECT_EQ(params.law(0, 0).penalty, 300e9);
}

TEST(ContactParams, HaveTheDampingOfALayerOfBothDensities) {
  const case_::Case input = two_boxes_case({"contact[0].damping_ratio=0.2"});
  const double left = input.materials[0].density, right = input.materials[1].density;
  const ContactParams params = contact_params(input, {input.materials[0].group, input.materials[1].group});
  const double expected = 2 * 0.2 * std::sqrt(400e9 * left * right / (left + right));
  EXPECT_NEAR(params.law(0, 1).damping / expected, 1.0, 1e-12);
  EXPECT_EQ(params.law(1, 1).damping, 0.0);
}

TEST(ContactParams, HaveADelayOfFrictionByTheSlowerOneOfBodyAndPenalty) {
  const case_::Case stiff = two_boxes_case({"contact[0].friction_delay=20"}),
                    soft = two_boxes_case({"contact[0].friction_delay=20", "contact[0].penalty=1e6"});
  const case_::Material &left = stiff.materials[0], &right = stiff.materials[1];
  const double density = left.density * right.density / (left.density + right.density);
  const double young = std::min(left.young, right.young);
  ASSERT_GT(stiff.contacts[0].penalty, young);
  const std::vector<std::string> groups{left.group, right.group};
  EXPECT_NEAR(contact_params(stiff, groups).law(0, 1).friction_delay / (20 * std::sqrt(density / young)), 1, 1e-12);
  EXPECT_NEAR(contact_params(soft, groups).law(0, 1).friction_delay / (20 * std::sqrt(density / 1e6)), 1, 1e-12);
}

TEST(ContactParams, HaveThePlateauOfTheCaseOrNone) {
  const ContactParams params = contact_params(two_boxes_case(), {"left", "right"});
  EXPECT_EQ(params.law(0, 1).plateau, 4e9);
  EXPECT_TRUE(std::isinf(params.law(1, 1).plateau));
}

TEST(ContactParams, HaveAPenaltyThatStepsResolveUpToThePlateau) {
  const std::vector<std::string> low{"contact[0].plateau=60 MPa", "contact[0].unloading_exponent=4",
                                     "contact[0].damping_ratio=0.2"};
  const case_::Case input = two_boxes_case(low);
  const ContactLaw law = contact_params(input, {"left", "right"}).law(0, 1);
  EXPECT_DOUBLE_EQ(law.penalty, 60e6 / (4 * kLeastYield));
  EXPECT_EQ(law.plateau, 60e6);
  const double left = input.materials[0].density, right = input.materials[1].density;
  EXPECT_NEAR(law.damping / (2 * 0.2 * std::sqrt(law.penalty * left * right / (left + right))), 1.0, 1e-12);
}

TEST(JointLawParams, OfAnUnbreakableGroupHaveNoStrengthToReach) {
  const case_::Joint joint = two_boxes_case().joints.front();
  constexpr double kSize = 0.25;  // m
  const JointLawParams breakable = joint_law_params(joint, kSize, false), held = joint_law_params(joint, kSize, true);
  EXPECT_EQ(breakable.tensile_strength, 5e6);
  EXPECT_EQ(breakable.cohesion, 15e6);
  EXPECT_TRUE(std::isinf(held.tensile_strength));
  EXPECT_TRUE(std::isinf(held.cohesion));
  EXPECT_EQ(held.stiffness, joint.penalty / kSize);
  EXPECT_EQ(breakable.stiffness, joint.penalty / kSize);
}

TEST(JointLawParams, KnowWhatTheEnergiesCount) {
  case_::Joint joint = two_boxes_case().joints.front();
  EXPECT_TRUE(joint_law_params(joint, 1.0, false).energy_of_whole_curve);
  joint.energy_of_whole_curve = false;
  EXPECT_FALSE(joint_law_params(joint, 1.0, false).energy_of_whole_curve);
}

TEST(StageLoads, TakeTheDampingOfTheStage) {
  const case_::Case input = two_boxes_case();
  const StageLoads loads = stage_loads(input.stages.front(), build_model(input));
  EXPECT_EQ(loads.local_damping, 0.25);
  EXPECT_EQ(loads.mass_damping, 3.0);
}

/// Corners of elements that lie in the plane z = 0.
std::set<Index> nodes_at_the_bottom(const Model& model) {
  const LocalMesh& local = model.local;
  std::set<Index> nodes;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(local.slot_of_element[at(e)], c);
      if (load_node(local.reference.data(), node).z() < 1e-9) nodes.insert(node);
    }
  }
  return nodes;
}

TEST(NodesOfGroup, OfASurfaceAreTheCornersThatLieOnIt) {
  const Model own = build_model(two_boxes_case());
  EXPECT_THAT(nodes_of_group(own, "bottom"), testing::ElementsAreArray(nodes_at_the_bottom(own)));
  const Model shared = build_model(case_::read_text(case_::minimal));
  EXPECT_THAT(nodes_of_group(shared, "raster.z0"), testing::ElementsAreArray(nodes_at_the_bottom(shared)));
}

TEST(CountedNodesOfGroup, LeaveOutThoseThatAnotherRankCounts) {
  Model model = build_model(two_boxes_case());
  const std::vector<Index> all = counted_nodes_of_group(model, "left");
  ASSERT_GT(all.size(), 2u);
  model.local.counted[at(all[1])] = 0;
  const std::vector<Index> fewer = counted_nodes_of_group(model, "left");
  EXPECT_EQ(fewer.size() + 1, all.size());
  EXPECT_EQ(std::count(fewer.begin(), fewer.end(), all[1]), 0);
}

}  // namespace
}  // namespace breccia::parameters_test
