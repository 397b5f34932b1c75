#include "observe/gauges.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <memory>

#include "contact/search_params.hpp"
#include "model/parameters.hpp"
#include "simulation/step.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::gauges_test {
namespace {

constexpr double kStep = 1e-8;  // s
constexpr double kRounding = 1e-12;

/// Two boxes of one group, 5 mm apart, of finite elements: their nodes have masses that differ by a factor of six.
case_::Case two_boxes(const std::string& stage, const std::string& turned) {
  return case_::read_text(test::raster_case({.group = "box",
                                             .cells = {2, 1, 1},
                                             .boxes = {2, 1, 1},
                                             .gap = 5e-3,
                                             .mesh = "random_orientation = " + turned + "\n",
                                             .density = 2000}) +
                          stage);
}

constexpr double kBoxMass = 2000 * 2e-6;  // kg

class Gauges : public testing::Test {
 protected:
  void start(const std::string& stage, const std::string& turned = "false") {
    input_ = two_boxes(stage, turned);
    model_ = build_model(input_);
    domain_ = std::make_unique<Domain>(model_, search_params(input_, model_));
    begin_stage(*domain_, stage_loads(input_.stages[0], model_), kStep);
  }
  /// Of the given names, in a step with a sample.
  std::vector<GaugeReading> read(const std::vector<std::string>& names) {
    step(*domain_, {.sample = true});
    return read_gauges(*domain_, make_gauges(model_, names, input_.stages[0]));
  }
  /// Velocity of a node by its place.
  void move(const std::function<Vec3(const Vec3&)>& velocity) {
    const LocalMesh& local = model_.local;
    for (Index n = 0; n < local.num_nodes; ++n) {
      if (local.counted[static_cast<std::size_t>(n)] == 0) continue;
      store_node(domain_->state.nodes.velocity.data(), n, velocity(load_node(local.reference.data(), n)));
    }
  }

  case_::Case input_;
  Model model_;
  std::unique_ptr<Domain> domain_;
};

void expect_near(const Vec3& value, const Vec3& expected, double scale) {
  EXPECT_LT((value - expected).norm(), scale) << value.transpose() << " instead of " << expected.transpose();
}

TEST_F(Gauges, WeighNodesByTheirMass) {
  start("");
  // Not linear in the height: nodes on the faces and in the centres weigh differently.
  const auto velocity = [](const Vec3& x) { return Vec3(std::pow(x[2], 4) * 1e8, 0, 0); };
  move(velocity);
  double mass = 0, momentum = 0, count = 0, sum = 0;
  const LocalMesh& local = model_.local;
  for (std::size_t n = 0; n < local.counted.size(); ++n) {
    if (local.counted[n] == 0) continue;
    const double v = velocity(load_node(local.reference.data(), static_cast<Index>(n)))[0];
    mass += local.node_mass[n];
    momentum += local.node_mass[n] * v;
    count += 1;
    sum += v;
  }
  const GaugeReading box = read({"box"})[0];
  EXPECT_NEAR(mass, 2 * kBoxMass, kRounding);
  EXPECT_NEAR(box.momentum[0], momentum, 1e-6 * momentum) << "the step changes it by round-off only";
  EXPECT_NEAR(box.velocity[0], momentum / mass, 1e-6 * momentum / mass);
  EXPECT_GT(std::abs(sum / count - momentum / mass), 0.05 * momentum / mass) << "the mean of the nodes is another";
}

TEST_F(Gauges, TellCentreAndSpinOfABodyByItsNumber) {
  start("");
  const Vec3 spin(3, -4, 50), centre(35e-3, 5e-3, 5e-3);
  move([&](const Vec3& x) { return x[0] > 22e-3 ? Vec3(Vec3(1, 2, 3) + spin.cross(x - centre)) : Vec3(7, 0, 0); });
  const auto readings = read({"body 1", "body 0", "box"});
  expect_near(readings[0].centre, centre, kRounding);
  expect_near(readings[0].spin, spin, 1e-6 * spin.norm());
  expect_near(readings[0].velocity, Vec3(1, 2, 3), 1e-9);
  expect_near(readings[0].momentum, kBoxMass * Vec3(1, 2, 3), 1e-9 * kBoxMass);
  expect_near(readings[1].centre, Vec3(10e-3, 5e-3, 5e-3), kRounding);
  expect_near(readings[1].spin, Vec3::Zero(), 1e-6);
  expect_near(readings[1].velocity, Vec3(7, 0, 0), 1e-9);
  expect_near(readings[2].velocity, Vec3(4, 1, 1.5), 1e-9);
  expect_near(readings[2].centre, Vec3(22.5e-3, 5e-3, 5e-3), kRounding);
}

TEST_F(Gauges, TellTheSpinOfABodyThatIsNotAlignedWithTheAxes) {
  start("", "true");
  const Vec3 spin(30, -40, 5), centre(35e-3, 5e-3, 5e-3);
  move([&](const Vec3& x) { return Vec3(spin.cross(x - centre)); });
  expect_near(read({"body 1"})[0].spin, spin, 1e-6 * spin.norm());
}

TEST_F(Gauges, TellTheDisplacementAtTheTimeOfTheStep) {
  start("");
  move([](const Vec3&) { return Vec3(0, 0, 5); });
  expect_near(read({"box"})[0].displacement, Vec3::Zero(), 1e-18);
  const GaugeReading later = read({"box"})[0];
  expect_near(later.displacement, Vec3(0, 0, 5 * kStep), 1e-6 * 5 * kStep);
  EXPECT_NEAR(later.max_displacement[2], 5 * kStep, 1e-6 * 5 * kStep);
}

TEST_F(Gauges, TellTheResultantOfAllForces) {
  start("gravity = [0, 0, \"-10 m/s2\"]\n");
  const GaugeReading free = read({"body 0"})[0];
  expect_near(free.force, Vec3(0, 0, -10 * kBoxMass), 1e-9 * kBoxMass);
  expect_near(free.torque, Vec3::Zero(), 1e-9 * kBoxMass);
}

TEST_F(Gauges, TellTheTorqueAboutTheCentre) {
  start("[[stage.constraint]]\ngroup = \"box.x0\"\nvelocity = { z = 1 }\n");
  // The sides x0 are at rest and start to move at once: forces at the ends of the arms of 10 mm.
  const GaugeReading box = read({"body 0"})[0];
  ASSERT_GT(box.reaction[2], 0);
  expect_near(box.force, Vec3(0, 0, box.reaction[2]), 1e-9 * box.reaction[2]);
  expect_near(box.torque, Vec3(-10e-3, 0, 0).cross(box.reaction), 1e-9 * 10e-3 * box.reaction[2]);
}

TEST_F(Gauges, OfAGroupReadTheReactionsOnItsSurfacesToo) {
  start(R"(gravity = [0, 0, "-10 m/s2"]
[[stage.constraint]]
group = "box"
fixed = "z"
)");
  const auto readings = read({"box", "body 1", "box.z0"});
  expect_near(readings[0].reaction, Vec3(0, 0, 10 * 2 * kBoxMass), 1e-9 * kBoxMass);
  expect_near(readings[1].reaction, Vec3(0, 0, 10 * kBoxMass), 1e-9 * kBoxMass);
  expect_near(readings[2].reaction, Vec3::Zero(), 1e-18);  // no constraint names it
  expect_near(readings[0].force, Vec3::Zero(), 1e-9 * kBoxMass);
}

/// A body that is dragged at constant speed through a damping medium: all of the damping force is reaction.
TEST_F(Gauges, ReadTheWholeReactionWhereMassIsDamped) {
  static constexpr double kDamping = 4e7, kSpeed = 3;  // 1/s: alpha dt/2 = 0.2
  start(R"(mass_damping = 4e7
[[stage.constraint]]
group = "box"
velocity = { x = 3 }
)");
  move([](const Vec3&) { return Vec3(kSpeed, 0, 0); });
  const GaugeReading box = read({"box"})[0];
  const double force = kDamping * 2 * kBoxMass * kSpeed;
  expect_near(box.reaction, Vec3(force, 0, 0), 1e-9 * force);
  const EnergyBudget first = domain_->sample.budget;
  (void)read({"box"});
  const EnergyBudget& second = domain_->sample.budget;
  const double work = force * kSpeed * kStep;
  EXPECT_NEAR(second.external_work - first.external_work, work, 1e-9 * work);
  EXPECT_NEAR(second.damping - first.damping, work, 1e-9 * work);
}

}  // namespace
}  // namespace breccia::gauges_test
