#include <gtest/gtest.h>

#include <cmath>

#include "contact/search_params.hpp"
#include "model/parameters.hpp"
#include "observe/gauges.hpp"
#include "simulation/step.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::element_sets_test {
namespace {

constexpr double kStep = 1e-9;  // s, far below the stable one
constexpr double kRounding = 1e-9;
constexpr double kDensity = 2000;

/// A bar of two boxes of one material, 1 and 0.5 m long, which physical volumes of their own name as well.
case_::Case bar(const std::string& joints, const std::string& more) {
  static const case_::CaseFolder folder;
  folder.write("bar.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.5, 1, 1};
Coherence;
MeshSize{:} = 0.5;
Physical Volume("left") = {1};
Physical Volume("bar") = {1, 2};
Physical Volume("right") = {2};
)");
  return case_::read_case(folder.write(
      "case.toml",
      "[mesh]\nfile = \"bar.geo\"\nglue = true\n[[material]]\ngroup = \"bar\"\nyoung = 1e9\npoisson = 0.2\n"
      "density = 2000\njoints = \"" +
          joints + "\"\n" + (joints == "none" ? "" : "[[joint]]\ngroup = \"bar\"\n") + more));
}

class ElementSets : public testing::TestWithParam<const char*> {
 protected:
  void start(const std::string& more, const std::string& stage = "") {
    input_ = bar(GetParam(), more + "[[stage]]\nend = 1\n" + stage);
    model_ = build_model(input_);
    domain_ = std::make_unique<Domain>(model_, search_params(input_, model_));
    for (const InitialVelocity& initial : initial_velocities(input_, model_)) add_velocity(*domain_, initial);
    begin_stage(*domain_, stage_loads(input_.stages[0], model_), kStep);
  }
  std::vector<GaugeReading> read(const std::vector<std::string>& names) {
    step(*domain_, {.sample = true});
    return read_gauges(*domain_, make_gauges(model_, names, input_.stages[0]));
  }

  case_::Case input_;
  Model model_;
  std::unique_ptr<Domain> domain_;
};
INSTANTIATE_TEST_SUITE_P(Discretisations, ElementSets, testing::Values("none", "unbreakable"));

TEST_P(ElementSets, HaveNoMaterialOfTheirOwnAndChangeNoBody) {
  start("");
  EXPECT_EQ(model_.mesh.volume_groups, std::vector<std::string>{"bar"});
  EXPECT_EQ(model_.mesh.element_sets, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(model_.mesh.num_bodies, 1);
}

TEST_P(ElementSets, AreGaugedAsTheElementsThatTheyConsistOf) {
  start("[[initial_velocity]]\ngroup = \"bar\"\nvelocity = [3, 0, 0]\n");
  const auto readings = read({"left", "right", "bar"});
  EXPECT_NEAR(readings[0].momentum[0], kDensity * 1.0 * 3, kRounding * kDensity * 3);
  EXPECT_NEAR(readings[1].momentum[0], kDensity * 0.5 * 3, kRounding * kDensity * 3);
  EXPECT_NEAR(readings[2].momentum[0], kDensity * 1.5 * 3, kRounding * kDensity * 3);
  EXPECT_LT((readings[1].centre - Vec3(1.25 + 3 * kStep, 0.5, 0.5)).norm(), 1e-6);
}

TEST_P(ElementSets, StartWithAVelocityOfTheirOwn) {
  start("[[initial_velocity]]\ngroup = \"right\"\nvelocity = [0, 2, 0]\n");
  const GaugeReading whole = read({"bar"})[0];
  EXPECT_NEAR(whole.momentum[1], kDensity * 0.5 * 2, 1e-6 * kDensity) << "shared nodes have the mean by mass";
}

TEST_P(ElementSets, ArePulledByForces) {
  start("", "[[stage.force]]\ngroup = \"left\"\nvalue = [0, 0, 12]\n");
  EXPECT_NEAR(read({"bar"})[0].force[2], 12, 12 * kRounding);
}

TEST_P(ElementSets, AreHeldByConstraints) {
  start("[[initial_velocity]]\ngroup = \"bar\"\nvelocity = [1, 0, 0]\n",
        "[[stage.constraint]]\ngroup = \"right\"\nfixed = \"x\"\n");
  const auto readings = read({"right", "left"});
  EXPECT_EQ(readings[0].velocity[0], 0);
  EXPECT_GT(readings[1].velocity[0], 0.5);
}

TEST(ElementSetsOfACase, NeedAGroupWithAMaterialForEveryElement) {
  try {
    (void)build_model(bar("none",
                          "[[material]]\ngroup = \"left\"\nyoung = 1e9\npoisson = 0.2\ndensity = 1000\n"
                          "joints = \"none\"\n[[stage]]\nend = 1\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("lies in two physical volumes with a material"), std::string::npos)
        << error.what();
  }
  try {
    (void)build_model(
        bar("none", "[[initial_velocity]]\ngroup = \"rihgt\"\nvelocity = [1, 0, 0]\n[[stage]]\nend = 1\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the mesh has no volume group \"rihgt\""), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace breccia::element_sets_test
