#include "model/model.hpp"
#include "base/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "mesh/geometry.hpp"
#include "model/memory_demand.hpp"
#include "model/parameters.hpp"
#include "model/surfaces_to_break.hpp"
#include "model/time_step.hpp"
#include "support/notched_beam.hpp"
#include "support/raster_case.hpp"
#include "system/child_process.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::model_test {
namespace {

using test::two_boxes_case;

const std::string kRaster = test::raster_case({.cells = {4, 4, 2},
                                               .mesh = "slit = { lower = [0, 0.02, 0], upper = [0.02, 0.02, 0.02] }\n",
                                               .young = 40e9,
                                               .density = 2400,
                                               .penalty_factor = 10,
                                               .tensile_strength = 5e6,
                                               .shear_strength = 15e6,
                                               .energy_mode_1 = 100,
                                               .sections = "[joints]\nbroken = [\"raster.slit\"]\n"});

TEST(Model, HasNoJointAndNoLinkFromEitherSideWhereItIsBrokenFromTheStart) {
  const case_::Case input = case_::read_text(kRaster);
  const Model model = build_model(input);
  const std::vector<Topology::Face>& slit = model.topology.surface_groups.back();
  EXPECT_EQ(slit.size(), 2u * 2 * 2 * 4) << "two by two squares of four triangles, from both sides";
  for (const Topology::Face& face : slit) EXPECT_TRUE(model.topology.links[at(face.element)][at(face.face)].free());
  case_::Case whole = input;
  whole.broken_surfaces.clear();
  EXPECT_EQ(model.joints.size() + slit.size() / 2, build_model(whole).joints.size());
}

std::string refusal_of(const case_::Case& input) {
  try {
    const Model model = build_model(input);
    (void)TimeStep(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Model, OfMoreElementsThanTheMemoryHoldsIsRefusedBeforeItIsMade) {
  case_::Case input = case_::read_text(kRaster);
  input.mesh.raster->cells = {280, 280, 280};  // 527 million elements
  if (static_cast<double>(available_memory()) > mesh_bytes(24.0 * 280 * 280 * 280))
    GTEST_SKIP() << "this machine holds the mesh of the example";
  EXPECT_NE(refusal_of(input).find("mesh.raster: the model needs more memory than is available"), std::string::npos);
}

TEST(Model, WhoseJointsNeedMoreMemoryThanItsMeshIsRefusedWithTheNumberOfElements) {
  const case_::Case input = case_::read_text(kRaster);
  const Model model = build_model(input);
  const double elements = model.mesh.num_elements();
  EXPECT_GT(model_bytes(model), mesh_bytes(elements));
  EXPECT_NO_THROW(demand_memory(input, elements, model_bytes(model)));
  EXPECT_THROW(demand_memory(input, elements, 1e18), InputError);
}

TEST(Model, WithoutAStableStepThatANumberHoldsIsRefusedAtOnce) {
  std::string text = kRaster;
  text.replace(text.find("penalty_factor = 10"), 19, "penalty_factor = 1e290");
  EXPECT_THAT(refusal_of(case_::read_text(text)), testing::HasSubstr("there is no stable time step"));
  case_::Case input = case_::read_text(kRaster);
  EXPECT_EQ(refusal_of(input), "accepted");
  input.materials[0].young = 1e300;
  EXPECT_THAT(refusal_of(input), testing::HasSubstr("there is no stable time step"));
}

TEST(SurfacesToBreak, HaveBreakableJointsOrAreRefused) {
  const auto stage = [](const std::string& surface, const std::string& joints) {
    std::string text = kRaster;
    text.replace(text.find("broken = [\"raster.slit\"]\n"), 25, "");
    text.replace(text.find("breakable"), 9, joints);
    return case_::read_text(text + "broken = [\"" + surface + "\"]\n");
  };
  const auto message = [&](const std::string& surface, const std::string& joints) -> std::string {
    const case_::Case input = stage(surface, joints);
    const std::vector<SurfaceJoints> counts = joints_on(build_bare_model(input), surfaces_to_break(input));
    try {
      refuse_what_cannot_break(input, counts);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("raster.slit", "breakable"), "");
  EXPECT_NE(message("raster.slit", "unbreakable").find("\"raster.slit\" has joints that cannot break"),
            std::string::npos);
  EXPECT_NE(message("raster.x0", "breakable").find("stage[0].broken: the surface \"raster.x0\" has no joints"),
            std::string::npos)
      << "the outside";
}

TEST(Model, HasForEachLawTheMeanEdgeOfItsJoints) {
  const Model model = build_model(two_boxes_case());
  ASSERT_EQ(model.joint_laws.size(), 3u);
  for (std::size_t l = 0; l < 3; ++l) {
    double sum = 0, count = 0;
    for (const ModelJoint& joint : model.joints) {
      if (at(joint.law) != l) continue;
      sum += joint.face.size;
      count += 1;
    }
    EXPECT_DOUBLE_EQ(model.joint_sizes[l], sum / count);
  }
}

/// The two boxes with nothing but the groups in the law of their interface. @param right  joints of that group
std::string glued(const std::string& right) {
  std::string text = test::kTwoBoxesCase;
  const std::size_t at = text.find("between = [\"left\", \"right\"]\n") + 28;
  text.erase(at, text.find("[[contact]]") - at);
  text.replace(text.find("group = \"right\"\n"), 16, "group = \"right\"\njoints = \"" + right + "\"\n");
  if (right != "none") return text;
  const std::size_t joint = text.find("[[joint]]\ngroup = \"right\"");
  return text.erase(joint, text.find("[[joint]]", joint + 1) - joint);
}

TEST(Model, GluesABreakableGroupForGoodToOneThatIsNotWhereTheInterfaceHasNoStrength) {
  for (const char* right : {"none", "unbreakable"}) {
    const Model model = build_model(two_boxes_case({}, glued(right)));
    ASSERT_EQ(model.joint_law_names.front(), "left") << right;
    std::vector<std::string> breakable;
    for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
      if (model.joint_laws[l].breakable()) breakable.push_back(model.joint_law_names[l]);
    }
    EXPECT_EQ(breakable, std::vector<std::string>{"left"}) << right;
    EXPECT_TRUE(std::any_of(model.joints.begin(), model.joints.end(), [&](const ModelJoint& joint) {
      return model.joint_law_names[at(joint.law)] == "left-right";
    })) << right;
  }
}

/// The two boxes with the same laws for all of their joints. @param groups  of the law inside, @param pairs  in between
std::string alike(const std::string& groups, const std::vector<std::string>& pairs) {
  const auto joint = [](const std::string& key) {
    return "[[joint]]\n" + key + "\npenalty_factor = 50\ntensile_strength = \"1 MPa\"\nenergy_mode_1 = \"100 J/m2\"\n";
  };
  std::string laws = joint("group = " + groups);
  for (const std::string& pair : pairs) laws += joint("between = " + pair);
  std::string text = test::kTwoBoxesCase;
  const std::size_t at = text.find("[[joint]]");
  return text.replace(at, text.find("[[contact]]") - at, laws);
}

TEST(Model, TakesTheLawOfAnyGroupsForTheInterfaceOfEachTwo) {
  const std::vector<std::string> overrides{"material[1].young=90e9"};
  const auto model_of = [&](const std::string& groups, const std::vector<std::string>& pairs) {
    return build_model(two_boxes_case(overrides, alike(groups, pairs)));
  };
  const Model named = model_of("[\"left\", \"right\"]", {"[\"left\", \"right\"]"});
  EXPECT_EQ(std::set<std::string>(named.joint_law_keys.begin(), named.joint_law_keys.end()),
            (std::set<std::string>{"joint[0]", "joint[1]"}));
  for (const char* pair : {"[\"*\", \"*\"]", "[\"*\", \"left\"]", "[\"right\", \"*\"]"}) {
    const Model any = model_of("\"*\"", {pair});
    EXPECT_EQ(any.joint_law_names, named.joint_law_names) << pair;
    EXPECT_EQ(any.joint_law_keys, named.joint_law_keys) << pair;
    EXPECT_EQ(any.breakable, named.breakable) << pair;
    ASSERT_EQ(any.joint_laws.size(), named.joint_laws.size()) << pair;
    for (std::size_t l = 0; l < named.joint_laws.size(); ++l) {
      EXPECT_EQ(any.joint_laws[l].stiffness, named.joint_laws[l].stiffness) << pair;
      EXPECT_EQ(any.joint_laws[l].tensile_strength, named.joint_laws[l].tensile_strength) << pair;
    }
  }
}

TEST(Model, AsksWhichOfTwoLawsThatFitAnInterfaceAlikeIsMeant) {
  try {
    (void)build_model(two_boxes_case({}, alike("\"*\"", {"[\"left\", \"*\"]", "[\"*\", \"right\"]"})));
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    const Problem& problem = error.problems().front();
    EXPECT_EQ(problem.key, "joint[2].between");
    EXPECT_NE(problem.what.find("and joint[1] (line "), std::string::npos) << problem.what;
    EXPECT_NE(problem.allowed.find("between = [\"left\", \"right\"]"), std::string::npos) << problem.allowed;
  }
}

TEST(Model, WantsStrengthsAtTheInterfaceOfTwoBreakableGroups) {
  try {
    two_boxes_case({}, glued("breakable"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("joints of \"left\" and \"right\" can fail"), std::string::npos)
        << error.what();
  }
}

TEST(Model, KnowsItsLongestEdge) {
  const Model model = build_model(two_boxes_case());
  double longest = 0;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(model.mesh, e);
    for (const auto& [i, j] : geometry::kEdges) longest = std::max(longest, (x[at(i)] - x[at(j)]).norm());
  }
  EXPECT_DOUBLE_EQ(model.whole.longest_edge, longest);
}

TEST(Model, RestrictsContactPointsToTheSurfacesOfTheCase) {
  EXPECT_TRUE(build_model(two_boxes_case()).contact_everywhere);
  const Model model = build_model(two_boxes_case({"contact_points.surfaces=[\"bottom\"]"}));
  EXPECT_FALSE(model.contact_everywhere);
  EXPECT_EQ(model.contact_faces.size(), model.topology.surface_groups.back().size());
}

TEST(Links, OfAnElementAreScreenedByItsWeakestJoint) {
  const Model model = build_model(two_boxes_case());
  const JointLinks links = build_links(model);
  std::vector<double> limit(links.limit.size(), std::numeric_limits<double>::infinity());
  for (const ModelJoint& joint : model.joints) {
    for (const Index element : {joint.face.a, joint.face.b}) {
      double& least = limit[at(model.local.slot_of_element[at(element)])];
      least = std::min(least, model.joint_laws[at(joint.law)].screen_limit());
    }
  }
  EXPECT_TRUE(std::equal(limit.begin(), limit.end(), links.limit.begin()));
}

const std::string kNotchedCase = R"([mesh]
file = "beam.geo"
glue = true
[[material]]
group = "beam"
young = "40 GPa"
poisson = 0.2
density = 2400
[[joint]]
group = "beam"
penalty_factor = 100
tensile_strength = "5 MPa"
shear_strength = "15 MPa"
energy_mode_1 = "100 J/m2"
)";

/// Nodes of the foot that belong to elements left of the notch.
std::ptrdiff_t foot_on_the_left(const std::string& rest) {
  const case_::CaseFolder folder;
  folder.write("beam.geo", test::kNotchedBeam);
  const Model model = build_model(case_::read_case(folder.write("case.toml", kNotchedCase + rest)));
  const std::vector<Index> foot = nodes_of_group(model, "foot");
  std::ptrdiff_t left = 0, lower = 0;
  for (Index s = 0; s < model.local.num_slots; ++s) {
    for (int c = 0; c < 4 && model.local.is_original(s); ++c) {
      const Index node = model.local.corner_node(s, c);
      if (!std::binary_search(foot.begin(), foot.end(), node)) continue;
      (model.mesh.volume_of(model.local.mesh_element[at(s)]) == 0 ? left : lower) += 1;
      EXPECT_EQ(model.local.reference[nodal(node, 1)], 0.0);
    }
  }
  EXPECT_GT(lower, 10);
  return left;
}

TEST(Surface, BesideAnOpenNotchHasNoNodesOfTheOtherFlank) {
  EXPECT_EQ(foot_on_the_left("[joints]\nbroken = [\"notch\"]\n[[stage]]\nend = \"1 ms\"\n"), 0);
}

TEST(Surface, BesideANotchThatAStageOpensHasNoNodesOfTheOtherFlank) {
  EXPECT_EQ(foot_on_the_left("[[stage]]\nend = \"1 ms\"\n[[stage]]\nend = \"2 ms\"\nbroken = [\"notch\"]\n"), 0);
}

TEST(Surface, BesideWholeMaterialHasTheNodesOfAllElementsThatTouchItsBorder) {
  EXPECT_GT(foot_on_the_left("[[stage]]\nend = \"1 ms\"\n"), 0);
}

TEST(MeshOfACase, HasTheScaleAndTheSeedOfTheCase) {
  const Mesh metres = build_mesh(two_boxes_case()).mesh,
             millimetres = build_mesh(two_boxes_case({"mesh.scale=0.001"})).mesh;
  ASSERT_EQ(metres.num_nodes(), millimetres.num_nodes());
  for (Index n = 0; n < metres.num_nodes(); ++n)
    EXPECT_LT((1e-3 * metres.nodes[at(n)] - millimetres.nodes[at(n)]).norm(), 1e-15);
  const auto nodes = [](const char* seed) {
    return build_mesh(case_::read_text(case_::minimal, {"mesh.raster.random_orientation=true", seed})).mesh.nodes;
  };
  EXPECT_NE(nodes("mesh.raster.seed=1"), nodes("mesh.raster.seed=2"));
}

/// Two boxes of one group in a row, each a volume, meshed with the interface that they share; one solid where glued.
std::string solid_of_volumes(const std::string& more) {
  return "[mesh]\nfile = \"two.geo\"\nglue = true\n[[material]]\ngroup = \"bar\"\nyoung = 1e10\npoisson = 0.2\n"
         "density = 2000\njoints = \"unbreakable\"\n[[joint]]\ngroup = \"bar\"\n" +
         more + "[[stage]]\nend = 1\n";
}
constexpr const char* kTwoVolumes = R"(SetFactory("OpenCASCADE");
Box(1) = {-3, 0, 0, 3, 1, 1};
Box(2) = {0, 0, 0, 1, 1, 1};
Coherence;
MeshSize{:} = 1;
Physical Volume("bar") = {1, 2};
Physical Surface("between") = Surface In BoundingBox {-0.1, -0.1, -0.1, 0.1, 1.1, 1.1};
)";

TEST(Model, HasOneBodyOfVolumesThatAreGluedAndTwoWhereTheCaseCutsThem) {
  const case_::CaseFolder folder;
  folder.write("two.geo", kTwoVolumes);
  const auto model_of = [&](const std::string& more) {
    return build_bare_model(case_::read_case(folder.write("case.toml", solid_of_volumes(more))));
  };
  const std::string spin = "[[initial_velocity]]\ngroup = \"bar\"\nangular = [0, 0, 1]\n";
  const Model whole = model_of(spin);
  EXPECT_EQ(whole.mesh.num_bodies, 1);
  EXPECT_EQ(whole.mesh_report.bodies, 1);
  EXPECT_EQ(whole.whole.body_length.size(), 1u);
  ASSERT_EQ(whole.whole.motion_centres[0].size(), 1u);
  constexpr double kRounding = 1e-12;  // m
  EXPECT_LT((whole.whole.motion_centres[0][0] - Vec3(-1, 0.5, 0.5)).norm(), kRounding);
  const Model cut = model_of("[joints]\nbroken = [\"between\"]\n" + spin);
  EXPECT_EQ(cut.mesh.num_bodies, 2);
  EXPECT_EQ(cut.mesh_report.bodies, 2);
  EXPECT_LT((cut.whole.motion_centres[0][1] - Vec3(0.5, 0.5, 0.5)).norm(), kRounding);
}

TEST(Model, TurnsABodyOfTwoGroupsAboutTheCentreOfMassOfBoth) {
  const Model model = build_bare_model(
      test::two_boxes_case({}, test::kTwoBoxesCase + "[[initial_velocity]]\ngroup = \"right\"\nangular = [0, 0, 1]\n"));
  ASSERT_EQ(model.mesh.num_bodies, 1);
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(model.mesh, e);
    const double m =
        model.density[at(model.mesh.element_group[at(e)])] * geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    mass += m;
    moment += m * 0.25 * (x[0] + x[1] + x[2] + x[3]);
  }
  constexpr double kRounding = 1e-12;  // m
  EXPECT_LT((model.whole.motion_centres[0][0] - moment / mass).norm(), kRounding);
}

TEST(WholeModel, HasTheCentresOfMassOfWhatSpinsOrIsStretched) {
  const Model model = build_model(test::two_boxes_case(
      {"mesh.glue=false"}, test::kTwoBoxesCase.substr(0, test::kTwoBoxesCase.find("[[joint]]\nbetween")) +
                               "[[initial_velocity]]\ngroup = \"right\"\nangular = [0, 0, \"3 rad/s\"]\n"
                               "[[initial_velocity]]\ngroup = \"left\"\nvelocity = [1, 0, 0]\n"
                               "[[initial_velocity]]\ngroup = \"right\"\nstrain_rate = [\"1 1/s\", 0, 0]\n"
                               "[[stage]]\nend = 1\n"));
  ASSERT_EQ(model.whole.motion_centres.size(), 3u);
  EXPECT_TRUE(model.whole.motion_centres[1].empty()) << "it neither spins nor is it stretched";
  EXPECT_EQ(model.whole.motion_centres[2], model.whole.motion_centres[0]);
  Vec3 centre = Vec3::Zero();
  double volume = 0;
  Index body = -1;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const auto i = static_cast<std::size_t>(e);
    if (model.mesh.volume_groups[static_cast<std::size_t>(model.mesh.element_group[i])] != "right") continue;
    body = model.mesh.element_body[i];
    const auto x = geometry::corners_of(model.mesh, e);
    const double v = geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    volume += v;
    centre += v * 0.25 * (x[0] + x[1] + x[2] + x[3]);
  }
  ASSERT_GE(body, 0);
  constexpr double kRounding = 1e-12;  // m
  EXPECT_LT((model.whole.motion_centres[0][static_cast<std::size_t>(body)] - centre / volume).norm(), kRounding);
}

}  // namespace
}  // namespace breccia::model_test
