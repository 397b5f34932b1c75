#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "physics/energy.hpp"
#include "support/sums.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::energy_test {
namespace {

using test::Model;

constexpr double kRounding = 1e-12;  // relative

/// Strain energy of a neo-Hookean body stretched along one axis, J/m3: integral of mu (s - 1/s) + lambda/2 (s - 1/s).
double energy_of_stretch(const ElasticParams& p, double s) {
  return (p.mu / 2 + p.lambda / 4) * (s * s - 1 - 2 * std::log(s));
}

/// Lone tetrahedra, each stretched along x by a factor of its own.
struct Stretched {
  Model model;
  ElasticParams params = make_elastic_params(BulkLaw::neo_hookean, 2e9, 0.25, 0);

  Stretched(Discretisation kind, const std::vector<double>& stretch)
      : model(test::tetrahedron(1.0, {static_cast<int>(stretch.size()), 1, 1}), kind, 1000) {
    const LocalMesh& local = model.local;
    for (Index s = 0; s < local.num_slots; ++s) {
      const GlobalId element = local.element_of_slot[at(s)];
      if (element < 0) continue;
      const double factor = stretch[static_cast<std::size_t>(element)];
      for (int c = 0; c < 4; ++c) model.state.position[nodal(local.corner_node(s, c), 0)] *= factor;
    }
  }
  [[nodiscard]] ElasticEnergy energy() const {
    return elastic_energy(model.local, std::span(&params, 1), model.state.position.data());
  }
  [[nodiscard]] GlobalId worst() const { return model.local.element_of_slot[at(energy().worst_slot)]; }
};

class ElasticEnergyOf : public testing::TestWithParam<Discretisation> {};
INSTANTIATE_TEST_SUITE_P(Discretisations, ElasticEnergyOf,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(ElasticEnergyOf, StretchedElementsIsTheClosedFormAndNamesTheDensest) {
  const std::vector<double> stretch{1.0, 1.5, 0.9, 3.0, 2.0, 1.0, 1.0, 1.0, 1.0, 0.7};  // more than a block
  const Stretched body(GetParam(), stretch);
  const ElasticEnergy energy = body.energy();
  double total = 0;
  for (const double s : stretch) total += energy_of_stretch(body.params, s) / (6 * std::sqrt(2.0));
  EXPECT_NEAR(energy.total.value() / total, 1.0, kRounding);
  EXPECT_NEAR(energy.largest_density / energy_of_stretch(body.params, 3.0), 1.0, kRounding);
  EXPECT_EQ(body.worst(), 3);
}

TEST_P(ElasticEnergyOf, StretchedElementsIsDensestWhereItIsAndNotWhereOneIsInsideOut) {
  constexpr double kInsideOut = -0.2, kFar = 10.0;
  const Stretched lone(GetParam(), {kInsideOut});
  const Stretched body(GetParam(), {1.0, kInsideOut, 1.0, kFar, kInsideOut});
  ASSERT_LT(lone.energy().largest_density, energy_of_stretch(body.params, kFar));
  EXPECT_EQ(body.worst(), 3);
}

class MomentumOf : public testing::TestWithParam<Discretisation> {};
INSTANTIATE_TEST_SUITE_P(Discretisations, MomentumOf,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(MomentumOf, ATurningBodyIsRightHandedAndMovesWithItsCentre) {
  // A tetrahedron far from the origin: p = m v, L = x_c cross p + sum of m_i r_i cross (omega cross r_i), a quarter of
  // the mass at each corner.
  Model model(test::tetrahedron(), GetParam(), 1000);
  const Vec3 omega(0, 0, 2), velocity(3, 0, 0), place(5, 7, 0);
  model.map_positions([&](const Vec3& x) { return Vec3(x + place); });
  Vec3 centre = Vec3::Zero();
  for (const Index n : model.real_nodes()) centre += load_node(model.state.position.data(), n) / 4;
  const double mass = 1000 / (6 * std::sqrt(2.0));
  double inertia = 0;  // about the axis through the centre
  for (const Index n : model.real_nodes()) {
    const Vec3 arm = load_node(model.state.position.data(), n) - centre;
    inertia += mass / 4 * (arm[0] * arm[0] + arm[1] * arm[1]);
    const Vec3 turning(-omega[2] * arm[1], omega[2] * arm[0], 0);
    store_node(model.state.velocity.data(), n, velocity + turning);
  }
  const Momentum p = momentum(model.local, model.state.position.data(), model.state.velocity.data());
  const Vec3 linear = test::value_of(p.linear), angular = test::value_of(p.angular);
  EXPECT_LT((linear - mass * velocity).norm(), kRounding * mass * velocity.norm());
  EXPECT_NEAR(angular[2], -centre[1] * mass * velocity[0] + inertia * omega[2], kRounding * mass * 100);
  EXPECT_GT(inertia * omega[2], 0.01 * mass) << "the spin alone shows";
}

TEST(KineticEnergyOf, FreeVibrationsMovesByWhatTheKickSaysWhereTheStepChangesAndByNothingElsewhere) {
  constexpr double kStiffness = 3000, kRoundOff = 1e-11;
  Model model(test::tetrahedron(1.0, {3, 1, 1}), Discretisation::own_nodes, 1000);
  const std::vector<Index> nodes = model.real_nodes();
  Field<double>&v = model.state.velocity, displacement(v.size(), 0.0), before = v;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    store_node(v.data(), nodes[i], Vec3(1.0 + static_cast<double>(i), -2.0, 0.3));
  const auto each = [&](auto&& f) {
    for (const Index n : nodes) {
      for (int axis = 0; axis < 3; ++axis) f(nodal(n, axis), model.local.node_mass[at(n)]);
    }
  };
  const std::array steps{0.05, 0.05, 0.02, 0.07, 0.07, 0.11};
  double expected = 0;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const double dt = steps[s], dt_before = s > 0 ? steps[s - 1] : dt, kick = 0.5 * (dt_before + dt);
    double potential = 0, kicked = 0;
    before = v;
    each([&](std::size_t k, double mass) {
      potential += 0.5 * kStiffness * displacement[k] * displacement[k];
      v[k] -= kick / mass * kStiffness * displacement[k];
      kicked += mass * (v[k] - before[k]) * (v[k] - before[k]);
    });
    const double change = (dt_before - dt) / (dt_before + dt);
    const double energy = potential + kinetic_energy(model.local, before.data(), v.data(), change).value();
    if (s == 0) expected = energy;
    const double moved = -(dt - dt_before) / (4 * kick) * kicked;
    expected += moved;
    EXPECT_NEAR(energy, expected, kRoundOff * energy) << "step " << s;
    EXPECT_NEAR(step_change_energy(model.local, before.data(), v.data(), change).value(), moved, kRoundOff * energy);
    each([&](std::size_t k, double) { displacement[k] += dt * v[k]; });
  }
}

TEST(IntactJointEnergyOf, JointsThatOneElementHasOpenedIsHalfTheirStiffnessTimesOpeningSquared) {
  Model model(test::box({1, 1, 1}), Discretisation::own_nodes, 1000);
  constexpr double kStiffness = 3e8;  // Pa/m
  model.join(kStiffness);
  EXPECT_EQ(intact_joint_energy(model.local, model.links, model.state.position.data()).value(), 0.0);
  const Vec3 opening(1e-3, -2e-3, 5e-4);
  const Index element = 7, slot = model.local.slot_of_element[at(element)];
  for (int c = 0; c < 4; ++c) {
    const Index node = own_corner_node(slot, c);
    store_node(model.state.position.data(), node, load_node(model.state.position.data(), node) + opening);
  }
  double expected = 0;
  for (const JointFace& joint : find_joints(model.mesh, model.topology)) {
    if (joint.a == element || joint.b == element) expected += 0.5 * kStiffness * joint.area * opening.squaredNorm();
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(intact_joint_energy(model.local, model.links, model.state.position.data()).value(), expected,
              1e-9 * expected);
}

}  // namespace
}  // namespace breccia::energy_test
