#include "simulation/stage_steps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "base/error.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::stage_steps_test {
namespace {

using testing::HasSubstr;

class StageStepsOfCubes : public testing::Test {
 protected:
  StageStepsOfCubes()
      : input_(test::two_cubes()),
        partition_(input_, {}, std::make_unique<Model>(build_model(input_))),
        steps_(input_, input_.stages[0], partition_) {
    partition_.domain().state.clock.steps = 1;  // what a run begins with is told by `check`
  }

  /// An own-node element drawn out along x: its step falls about as much.
  void draw_out(GlobalId element, double stretch) {
    Domain& domain = partition_.domain();
    const Index slot = domain.model.local.slot_of_element[static_cast<std::size_t>(element)];
    for (int corner = 0; corner < 4; ++corner) {
      const Index node = domain.model.local.corner_node(slot, corner);
      Vec3 x = load_node(domain.model.local.reference.data(), node);
      x[0] *= stretch;
      store_node(domain.state.nodes.position.data(), node, x);
    }
  }
  /// Until the stable step is looked at.
  void look() {
    steps_.look();
    while (steps_.schedule().since > 0) steps_.look();
  }

  /// Looks, at most so many, until the step has grown. @return  how many
  int steps_until_grown(int most) {
    const double dt = partition_.state().clock.dt;
    for (int step = 1; step <= most; ++step) {
      steps_.look();
      if (partition_.state().clock.dt > dt) return step;
    }
    return most + 1;
  }

  const case_::Case input_;
  Partition partition_;
  StageSteps steps_;
};

TEST_F(StageStepsOfCubes, SayNothingOfAStepThatIsThatOfTheModelAtRest) {
  look();
  EXPECT_EQ(steps_.take_warning(), "");
  draw_out(7, 3);
  look();
  EXPECT_EQ(steps_.take_warning(), "");
}

TEST_F(StageStepsOfCubes, EndTheRunBelowAThousandthPart) {
  draw_out(7, 20 / kSmallestStep);
  try {
    look();
    FAIL() << "goes on";
  } catch (const SimulationError& error) {
    EXPECT_THAT(std::string(error.what()), HasSubstr("step 1, time 0 s: the stable step has fallen to "));
    EXPECT_THAT(std::string(error.what()), HasSubstr(" by element 7; "));
  }
}

TEST_F(StageStepsOfCubes, AreNotHalvedAtTheEndOfTheirStageByALimitThatHardlyMoves) {
  Clock& clock = partition_.domain().state.clock;
  const double step = 1.005 * input_.time.safety * steps_.limit().step;
  for (const int left : {1, 2, 3}) {
    clock.dt = step;
    clock.time = input_.stages[0].end - left * step;
    look();
    EXPECT_EQ(clock.dt, step) << left;
  }
}

TEST_F(StageStepsOfCubes, GrowAfterThreeHundredStepsInWhichEveryLookWouldHaveLetThem) {
  look();
  partition_.domain().state.clock.dt *= 0.25;
  constexpr int kLooks = 100;  // steps between them
  EXPECT_EQ(steps_until_grown(290), 291);
  draw_out(7, 100);
  look();
  draw_out(7, 1);
  const int steps = steps_until_grown(1000);
  EXPECT_GE(steps, 300);
  EXPECT_LE(steps, 300 + 2 * kLooks);
  EXPECT_LE(steps_until_grown(kLooks), 10) << "growing, it is looked at again soon";
}

TEST(StageStepsOfAGivenLength, AreNotLookedAt) {
  case_::Case input = test::two_cubes("[time]\nstep = 1e-8\n");
  Partition partition(input, {}, std::make_unique<Model>(build_model(input)));
  StageSteps steps(input, input.stages[0], partition);
  for (double& x : partition.domain().state.nodes.position) x *= 1e6;
  for (int look = 0; look < 200; ++look) steps.look();
  EXPECT_EQ(steps.take_warning(), "");
}

}  // namespace
}  // namespace breccia::stage_steps_test
