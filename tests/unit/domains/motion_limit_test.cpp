#include "domains/motion_limit.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "simulation/step.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::motion_limit_test {
namespace {

using test::kCubeStep;

class MotionLimit : public testing::Test, protected test::CubesDomain {
 protected:
  MotionLimit() : CubesDomain("[[contact]]\nbetween = [\"box\", \"box\"]\npenalty = \"10 GPa\"\n") {}

  /// All nodes alike, so that nothing is strained; `share` of the contactors' mean size in a step.
  void move_by(double share) {
    const Vec3 velocity(0, 0, share * domain.contact->searches().contactor_size() / kCubeStep);
    for (Index n = 0; n < model.local.num_nodes; ++n) store_node(domain.state.nodes.velocity.data(), n, velocity);
  }
  void known_before_the_first_step() { domain.state.signals.max_speed = fastest_node(domain).speed; }
  /// What a number of steps throw, empty: nothing.
  std::string error_of(int steps) {
    try {
      for (int i = 0; i < steps; ++i) step(domain);
    } catch (const SimulationError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(MotionLimit, AllowsWhatNodesMoveSinceTheStart) {
  move_by(0.4);
  known_before_the_first_step();
  EXPECT_EQ(error_of(5), "");
}

TEST_F(MotionLimit, RefusesToJumpOverContactorsTwoStepsLater) {
  move_by(0.6);
  known_before_the_first_step();
  EXPECT_EQ(error_of(2), "");
  const std::string error = error_of(1);
  EXPECT_EQ(error.find("step 0: corner 0 of element 0 moves by "), 0u) << error;
  EXPECT_NE(error.find("contacts would be missed"), std::string::npos) << error;
}

TEST_F(MotionLimit, AllowsMoreInTheFirstStepOfAStage) {
  move_by(0.9 * kUnforeseenAtStart);
  EXPECT_EQ(error_of(5), "");
}

TEST_F(MotionLimit, RefusesMuchMoreThanInTheStepBefore) {
  EXPECT_EQ(error_of(2), "");
  move_by(0.9 * kUnforeseen);
  EXPECT_EQ(error_of(3), "");
  move_by((2 * 0.9 + 1.1) * kUnforeseen);
  EXPECT_EQ(error_of(2), "");
  const std::string error = error_of(1);
  EXPECT_EQ(error.find("step 5: "), 0u) << error;
  EXPECT_NE(error.find("detected with a delay"), std::string::npos) << error;
}

TEST_F(MotionLimit, NamesTheFastestNode) {
  move_by(0.3);
  known_before_the_first_step();
  EXPECT_EQ(error_of(1), "");
  const Index corner = own_corner_node(model.local.slot_of_element[7], 2);
  store_node(domain.state.nodes.velocity.data(), corner, 3 * load_node(domain.state.nodes.velocity.data(), corner));
  const std::string error = error_of(3);
  EXPECT_NE(error.find("step 1: corner 2 of element 7 moves by "), std::string::npos) << error;
}

TEST(MotionLimitWithoutContact, DoesNotExist) {
  test::CubesDomain cubes;
  for (Index n = 0; n < cubes.model.local.num_nodes; ++n)
    store_node(cubes.domain.state.nodes.velocity.data(), n, Vec3(0, 0, 0.01 / kCubeStep));
  for (int i = 0; i < 5; ++i) EXPECT_NO_THROW(step(cubes.domain));
}

}  // namespace
}  // namespace breccia::motion_limit_test
