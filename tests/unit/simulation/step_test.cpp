#include "simulation/step.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "base/error.hpp"
#include "unit/model/two_boxes.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::step_test {
namespace {

using test::kCubeStep;

/// Largest deviation of a nodal field's nodes from what is expected of each.
template <class Expected>
double deviation(const LocalMesh& local, const Field<double>& field, Expected&& expected) {
  double largest = 0;
  for (Index n = 0; n < local.num_nodes; ++n) {
    if (local.node_id[static_cast<std::size_t>(n)] < 0) continue;
    largest = std::max(largest, (load_node(field.data(), n) - expected(n)).norm());
  }
  return largest;
}

class StepOfCubes : public testing::Test, protected test::CubesDomain {
 protected:
  void set_velocity(const Vec3& velocity) {
    for (Index n = 0; n < model.local.num_nodes; ++n) store_node(domain.state.nodes.velocity.data(), n, velocity);
  }
  [[nodiscard]] Vec3 start(Index node) const { return load_node(model.local.reference.data(), node); }
};

TEST_F(StepOfCubes, TakesTheClockAlong) {
  step(domain);
  domain.state.clock.dt = 2 * kCubeStep;
  step(domain);
  const Clock& clock = domain.state.clock;
  EXPECT_EQ(clock.steps, 2);
  EXPECT_DOUBLE_EQ(clock.time, 3 * kCubeStep);
  EXPECT_EQ(clock.dt_before, 2 * kCubeStep);
  EXPECT_EQ(clock.dt_earlier, kCubeStep);
}

TEST_F(StepOfCubes, MovesAFreeBodyByItsVelocityAlone) {
  const Vec3 velocity(2, -1, 0.5);
  set_velocity(velocity);
  constexpr int kSteps = 50;
  for (int i = 0; i < kSteps; ++i) step(domain);
  constexpr double kRounding = 1e-16;  // m, of positions of 20 mm
  EXPECT_LE(deviation(model.local, domain.state.nodes.position,
                      [&](Index n) { return Vec3(start(n) + kSteps * kCubeStep * velocity); }),
            kSteps * kRounding);
}

TEST_F(StepOfCubes, SumsUpGravityAsCentralDifferencesDo) {
  domain.state.loads.gravity[2].constant = -9.81;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) step(domain);
  const double fall = 0.5 * 9.81 * kCubeStep * kCubeStep * kSteps * (kSteps + 1);  // from v_(-1/2) = 0
  constexpr double kRounding = 1e-17;                                              // m
  EXPECT_LE(
      deviation(model.local, domain.state.nodes.position, [&](Index n) { return Vec3(start(n) - Vec3(0, 0, fall)); }),
      kSteps * kRounding);
}

TEST_F(StepOfCubes, KicksByTheMeanOfTwoStepsWhereTheirLengthChanges) {
  domain.state.loads.gravity[2].constant = -9.81;
  step(domain);
  domain.state.clock.dt = 3 * kCubeStep;
  step(domain);
  const double speed = 9.81 * (1 + 0.5 * (1 + 3)) * kCubeStep;
  constexpr double kRounding = 1e-13;  // m/s: positions are round to 1e-18 m
  EXPECT_LE(deviation(model.local, domain.state.nodes.velocity, [&](Index) { return Vec3(0, 0, -speed); }), kRounding);
}

/// A box that vibrates along x, in steps near the stable one.
class VibratingCubes : public StepOfCubes {
 protected:
  static constexpr double kStep = 4e-7, kSpeed = 0.01;  // s; m/s, of its ends: joints stay elastic

  VibratingCubes() {
    for (Index n = 0; n < model.local.num_nodes; ++n)
      store_node(domain.state.nodes.velocity.data(), n, Vec3(kSpeed * (start(n)[0] / test::kCubeEdge - 1), 0, 0));
  }
  /// One step, of which the energies are sampled.
  const EnergyBudget& advance(double dt) {
    domain.state.clock.dt = dt;
    step(domain, {.sample = true});
    return domain.sample.budget;
  }
};

TEST_F(VibratingCubes, AccountWhatChangesOfTheStepMove) {
  double largest = 0;
  for (int i = 0; i < 600; ++i) {
    const EnergyBudget& budget = advance(i % 7 < 3 ? kStep : 0.25 * kStep);
    EXPECT_LT(budget.residual_relative, 1e-6) << i;
    largest = std::max(largest, std::abs(budget.step_change));
  }
  EXPECT_GT(largest, 1e-4 * domain.sample.budget.kinetic);
}

TEST_F(VibratingCubes, ShowTheEnergyThatStepsInTheirRhythmGive) {
  double gain = 0, stored = 0;
  bool returns =
      false;  // towards the middle: steps shrink where accelerations are largest, and grow where they are not
  for (int i = 0; i < 4000; ++i) {
    const EnergyBudget& budget = advance(returns ? 0.25 * kStep : kStep);
    EXPECT_LT(budget.residual_relative, 1e-5) << i;
    const double before = std::exchange(stored, budget.elastic + budget.joint_elastic);
    returns = stored < before;
    gain = budget.gain_relative;
  }
  EXPECT_GT(gain, 0.01);
}

TEST_F(StepOfCubes, SamplesTheEnergiesWhenAskedTo) {
  set_velocity(Vec3(1, 0, 0));
  step(domain);
  EXPECT_EQ(domain.sample.budget.kinetic, 0);
  step(domain, {.sample = true});
  EXPECT_GT(domain.sample.budget.kinetic, 0);
}

TEST_F(StepOfCubes, SaysWhenAVelocityIsNotFinite) {
  domain.state.nodes.velocity[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(step(domain), SimulationError);
}

/// Every element draws away from its neighbours, by less than the strong joints hold and more than the weak ones do.
void part_elements(Domain& domain, double strain) {
  const LocalMesh& local = domain.model.local;
  for (const Index slot : local.slot_of_element) {
    Vec3 centre = Vec3::Zero();
    for (int c = 0; c < 4; ++c) centre += 0.25 * load_node(local.reference.data(), local.corner_node(slot, c));
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      store_node(domain.state.nodes.position.data(), node, load_node(local.reference.data(), node) + strain * centre);
    }
  }
}

TEST(Step, KeepsMomentumWhereElementsHaveJointsOfDifferentStrength) {
  const case_::Case input = test::two_boxes_case();
  const Model model = build_model(input);
  Domain domain(model, search_params(input, model));
  begin_stage(domain, {}, 1e-9);
  part_elements(domain, 1.5e-6);
  step(domain);
  Vec3 sum = Vec3::Zero();
  double size = 0;
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    const Vec3 p =
        model.local.node_mass[static_cast<std::size_t>(n)] * load_node(domain.state.nodes.velocity.data(), n);
    sum += p;
    size += p.norm();
  }
  EXPECT_GT(size, 0);
  EXPECT_FALSE(domain.state.joints.active.empty());
  EXPECT_LT(domain.state.joints.active.size(), model.joints.size());
  EXPECT_LE(sum.norm(), 1e-12 * size);
}

TEST(Step, GivesTheFacesOfReleasedJointsToContactAStepLater) {
  test::CubesDomain cubes("[[contact]]\nbetween = [\"box\", \"box\"]\npenalty = \"10 GPa\"\n");
  step(cubes.domain);
  const std::size_t points = cubes.domain.state.contact.points.size();
  break_joints(cubes.domain, faces_of_surface(cubes.model, "box.slit"));
  for (Index n = 0; n < cubes.model.local.num_nodes; ++n) {  // it opens
    double& speed = cubes.domain.state.nodes.velocity[nodal(n, 0)];
    speed = 1e3 * (load_node(cubes.model.local.reference.data(), n)[0] - test::kCubeEdge);
  }
  int steps = 0;
  while (cubes.domain.state.joints.released.empty() && steps < 1000) {
    step(cubes.domain);
    ++steps;
  }
  ASSERT_EQ(cubes.domain.state.joints.released.size(), 4u) << "after " << steps << " steps";
  EXPECT_EQ(cubes.domain.state.contact.points.size(), points);
  step(cubes.domain);
  EXPECT_EQ(cubes.domain.state.contact.points.size(), points + 2 * 4 * 4) << "four points a face, both sides";
}

}  // namespace
}  // namespace breccia::step_test
