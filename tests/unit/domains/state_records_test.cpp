#include "domains/state_records.hpp"

#include <gtest/gtest.h>

#include "model/parameters.hpp"
#include "simulation/step.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::state_records_test {
namespace {

/// The cubes with a slit that comes apart and closes again, with contact and friction.
struct PartedCubes : test::CubesDomain {
  PartedCubes() : CubesDomain("[[contact]]\nbetween = [\"box\", \"box\"]\npenalty = \"10 GPa\"\nfriction = 0.3\n") {
    break_joints(domain, faces_of_surface(model, "box.slit"));
    approach(Vec3(-20, 0, 0));
    for (int i = 0; i < 100; ++i) step(domain);
    approach(Vec3(20, 5, 1));
    for (int i = 0; i < 150; ++i) step(domain);
  }
  /// The left cube flies with this velocity, m/s, the right one with the opposite one.
  void approach(const Vec3& velocity) {
    for (Index n = 0; n < model.local.num_nodes; ++n) {
      const GlobalId id = model.local.node_id[static_cast<std::size_t>(n)];
      if (id < 0) continue;
      double x = 0;
      for (const Index node : model.mesh.elements[static_cast<std::size_t>(id / 4)])
        x += 0.25 * model.mesh.nodes[static_cast<std::size_t>(node)][0];
      store_node(domain.state.nodes.velocity.data(), n, x < test::kCubeEdge ? velocity : Vec3(-velocity));
    }
  }
};

TEST(StateRecords, TakeAStateToAnotherDomainThatGoesOnWithTheSameBits) {
  PartedCubes cubes, undisturbed;
  ASSERT_GT(cubes.domain.state.contact.touching.size(), 0u);
  ASSERT_EQ(cubes.domain.state.joints.released.size(), 4u);
  ASSERT_GT(cubes.domain.state.joints.active.size(), 0u);

  const Records records = records_of(cubes.domain);
  const std::string hash = hash_of(cubes.domain).text();
  Domain other(cubes.model, search_params(cubes.input, cubes.model), records, close(cubes.domain));
  begin_stage(other, stage_loads(cubes.input.stages[0], cubes.model), test::kCubeStep);
  EXPECT_EQ(hash_of(other).text(), hash);
  for (int i = 0; i < 200; ++i) {
    step(other);
    step(undisturbed.domain);
  }
  EXPECT_EQ(hash_of(other).text(), hash_of(undisturbed.domain).text());
}

/// The look at the time step depends on it.
TEST(StateRecords, KeepWhetherJointsWereReleasedInTheStepBeforeTheLast) {
  for (const bool released : {false, true}) {
    PartedCubes cubes;
    cubes.domain.state.signals.released = released;
    cubes.domain.state.signals.released_here.assign(released ? 0 : 1, 3);
    const Records records = records_of(cubes.domain);
    const Domain other(cubes.model, search_params(cubes.input, cubes.model), records, close(cubes.domain));
    EXPECT_EQ(other.state.signals.released, released);
  }
}

TEST(StateRecords, HoldTheHashOfEveryPartOfTheState) {
  PartedCubes one, two;
  EXPECT_EQ(hash_of(one.domain).text(), hash_of(two.domain).text());
  two.domain.state.nodes.velocity[0] += 1e-12;
  EXPECT_NE(hash_of(one.domain).text(), hash_of(two.domain).text());
}

}  // namespace
}  // namespace breccia::state_records_test
