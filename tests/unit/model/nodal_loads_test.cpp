#include "model/nodal_loads.hpp"

#include <gtest/gtest.h>

#include "model/parameters.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::test::nodal_loads_test {
namespace {

constexpr double kRounding = 1e-12;

/// What a force of 1 N along x makes of a model: its resultant and where that acts.
struct Resultant {
  double force = 0;           ///< N
  Vec3 place = Vec3::Zero();  ///< m
};

Resultant resultant(const Model& model, const std::string& group) {
  case_::Force force;
  force.group = group;
  force.value[0].constant = 1;
  NodalLoad load = nodal_load(force, model);
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  NodalState state;
  state.position = model.local.reference;
  state.velocity.assign(model.local.reference.size(), 0.0);
  load.apply(model.local, state, 0, 0, forces);
  Resultant sum;
  for (Index node = 0; node < model.local.num_nodes; ++node) {
    if (model.local.node_id[static_cast<std::size_t>(node)] < 0) continue;
    const double share = forces.get(node).x();
    sum.force += share;
    sum.place += share * load_node(model.local.reference.data(), node);
  }
  return sum;
}

/// Centre of mass of a volume group; area and centre of area of a surface group.
struct Centre {
  double size = 0;
  Vec3 place = Vec3::Zero();
};

Centre centre_of_volume(const Model& model, Index group) {
  Centre sum;
  const LocalMesh& local = model.local;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    if (model.mesh.element_group[static_cast<std::size_t>(e)] != group) continue;
    const Index slot = local.slot_of_element[static_cast<std::size_t>(e)];
    const double volume = local.volume[static_cast<std::size_t>(slot)];
    for (int c = 0; c < 4; ++c)
      sum.place += 0.25 * volume * load_node(local.reference.data(), local.corner_node(slot, c));
    sum.size += volume;
  }
  sum.place /= sum.size;
  return sum;
}

class NodalLoads : public testing::TestWithParam<bool> {
 protected:
  /// Joints, or elements of one solid that share their nodes.
  Model model_ = GetParam() ? build_model(two_boxes_case()) : build_model(case_::read_text(case_::minimal));
};
INSTANTIATE_TEST_SUITE_P(Discretisations, NodalLoads, testing::Bool());

TEST_P(NodalLoads, OnAVolumeActAtItsCentreOfMass) {
  const std::string group = model_.mesh.volume_groups.front();
  const Resultant sum = resultant(model_, group);
  const Centre centre = centre_of_volume(model_, 0);
  EXPECT_NEAR(sum.force, 1, kRounding);
  EXPECT_LT((sum.place - centre.place).norm(), kRounding * model_.whole.longest_edge);
  EXPECT_NEAR(model_.whole.group_sizes.volume_mass.front(), model_.density.front() * centre.size,
              kRounding * model_.density.front() * centre.size);
}

TEST_P(NodalLoads, OnASurfaceActAtItsCentreOfArea) {
  const std::string group = GetParam() ? "bottom" : "raster.z0";
  const Resultant sum = resultant(model_, group);
  EXPECT_NEAR(sum.force, 1, kRounding);
  Centre centre;
  for (const LoadedFace& face : faces_of_surface(model_, group)) {
    const auto nodes = face_nodes(model_.local, face);
    const double area = 0.5 * doubled_area(model_.local.reference, nodes).norm();
    for (const Index node : nodes) centre.place += area / 3 * load_node(model_.local.reference.data(), node);
    centre.size += area;
  }
  EXPECT_LT((sum.place - centre.place / centre.size).norm(), kRounding * model_.whole.longest_edge);
}

}  // namespace
}  // namespace breccia::test::nodal_loads_test
