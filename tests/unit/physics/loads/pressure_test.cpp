#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>

#include "unit/physics/loads/models.hpp"

namespace breccia::pressure_test {
namespace {

using test::Model;

constexpr double kRounding = 1e-12;  // of pressure times area

Mat3 some_rotation() { return Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix(); }

struct Applied {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

Applied apply(SurfaceLoad& load, const Model& model, double time) {
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  load.apply(model.local, model.state, time, 0.0, forces);
  Applied sum;
  for (const Index n : model.real_nodes()) {
    sum.force += forces.get(n);
    sum.moment += load_node(model.state.position.data(), n).cross(forces.get(n));
  }
  return sum;
}

std::vector<LoadedFace> group_faces(const Model& model, const std::string& name) {
  std::vector<LoadedFace> faces;
  for (std::size_t g = 0; g < model.mesh.surface_groups.size(); ++g) {
    if (model.mesh.surface_groups[g] != name) continue;
    for (const Topology::Face& f : model.topology.surface_groups[g]) {
      faces.push_back({model.local.slot_of_element[at(f.element)], f.face});
    }
  }
  return faces;
}

class Pressure : public testing::TestWithParam<Discretisation> {};
INSTANTIATE_TEST_SUITE_P(Discretisations, Pressure,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(Pressure, OnAClosedSurfaceHasNoResultantAndNoMoment) {
  Model model(test::jittered(test::box({2, 1, 3}), 0.05, 3), GetParam(), 1000);
  model.map_positions(
      [](const Vec3& x) { return Vec3(1.3 * x[0] + 0.2 * x[1] * x[2], x[1] - 0.3 * x[2], x[2] + 0.1 * x[0]); });
  SurfaceLoad load(model.free_faces(), test::in_time(2.0));
  const Applied sum = apply(load, model, 0.0);
  EXPECT_LT(sum.force.norm(), 22 * 2 * kRounding);
  EXPECT_LT(sum.moment.norm(), 22 * 2 * 5 * kRounding);
}

TEST_P(Pressure, PushesAgainstTheOutwardNormalWithPressureTimesArea) {
  const Model model(test::box({2, 3, 4}, 0.5), GetParam(), 1000);
  SurfaceLoad load(group_faces(model, "raster.z1"), test::in_time(3.0, 2.0));
  const Applied sum = apply(load, model, 0.5);  // 4 Pa on 1.0 x 1.5 m2
  EXPECT_LT((sum.force - Vec3(0, 0, -6)).norm(), 6 * kRounding);
  EXPECT_LT((load.resultant() - sum.force).norm(), 6 * kRounding);
}

TEST_P(Pressure, TurnsWithTheBody) {
  Model model(test::box({2, 3, 4}, 0.5), GetParam(), 1000);
  const Mat3 rotation = some_rotation();
  model.map_positions([&](const Vec3& x) { return Vec3(rotation * x + Vec3(4, 5, 6)); });
  SurfaceLoad load(group_faces(model, "raster.x0"), test::in_time(2.0));
  EXPECT_LT((apply(load, model, 0.0).force - rotation * Vec3(2.0 * 3.0, 0, 0)).norm(), 60 * kRounding);
}

TEST_P(Pressure, ActsOnceOnAFaceNamedTwice) {
  const Model model(test::box({1, 1, 1}), GetParam(), 1000);
  std::vector<LoadedFace> faces = group_faces(model, "raster.y1");
  faces.insert(faces.end(), faces.rbegin(), faces.rend());
  SurfaceLoad load(faces, test::in_time(2.0));
  EXPECT_LT((apply(load, model, 0.0).force - Vec3(0, -2, 0)).norm(), kRounding);
}

using Traction = Pressure;
INSTANTIATE_TEST_SUITE_P(Discretisations, Traction,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(Traction, KeepsItsDirectionAndTheAreaAtRest) {
  Model model(test::box({2, 3, 4}, 0.5), GetParam(), 1000);
  const Mat3 rotation = some_rotation();
  model.map_positions([&](const Vec3& x) { return Vec3(2.0 * rotation * x + Vec3(4, 5, 6)); });
  SurfaceLoad load(group_faces(model, "raster.x0"),
                   std::array{test::in_time(2.0), test::in_time(0.0), test::in_time(-1.0, 4.0)});
  EXPECT_LT((apply(load, model, 0.5).force - 3.0 * Vec3(2, 0, 1)).norm(), 60 * kRounding);
}

TEST(PressureWork, OnABodyThatBreathesIsMinusPressureTimesChangeOfVolume) {
  // The corner velocities of a small step are those of x -> (1 + rate dt) x, so both halves are known: p dV/dt = 3 p V
  // rate.
  Model model(test::box({1, 1, 1}), Discretisation::own_nodes, 1000);
  constexpr double kRate = 1e-3, kStep = 0.1, kPressure = 5.0;
  for (const Index n : model.real_nodes()) {
    store_node(model.state.velocity.data(), n, kRate * load_node(model.state.position.data(), n));
  }
  SurfaceLoad load(model.free_faces(), test::in_time(kPressure));
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  load.apply(model.local, model.state, 0.0, kStep, forces);
  const double half = -kPressure * 3.0 * kRate * kStep / 2.0;
  EXPECT_NEAR(load.work().value(), half, std::abs(half) * kRounding);
  load.account_after(model.local, model.state, 2.0 * kStep);
  EXPECT_NEAR(load.work().value(), 3.0 * half, std::abs(half) * kRounding);
}

TEST(PressureWork, OnElementsOfAnotherRankIsLeftToThatRank) {
  Model model(test::box({1, 1, 1}), Discretisation::own_nodes, 1000);
  for (const Index n : model.real_nodes())
    store_node(model.state.velocity.data(), n, load_node(model.state.position.data(), n));
  std::fill(model.local.original.begin(), model.local.original.end(), std::uint8_t{0});
  SurfaceLoad load(model.free_faces(), test::in_time(2.0));
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  load.apply(model.local, model.state, 0.0, 0.1, forces);
  load.account_after(model.local, model.state, 0.1);
  EXPECT_EQ(load.work().value(), 0.0);
}

}  // namespace
}  // namespace breccia::pressure_test
