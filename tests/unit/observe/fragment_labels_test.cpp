#include "observe/fragment_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/step.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::fragment_labels_test {
namespace {

class FragmentLabels : public testing::Test, protected test::CubesDomain {};

TEST_F(FragmentLabels, ChangeWhenJointsHaveFailed) {
  FragmentWatch watch;
  EXPECT_EQ(watch.look(domain, 1).count, 1);
  break_joints(domain, faces_of_surface(model, "box.slit"));
  EXPECT_EQ(watch.look(domain, 1).count, 1) << "they fail when they are evaluated next";
  step(domain);
  const Fragments& now = watch.look(domain, 1);
  EXPECT_EQ(now.count, 2);
  EXPECT_EQ(now.of_slot, find_fragments(domain).of_slot);
}

TEST_F(FragmentLabels, ComeWithTheFreeFacesOfTheSameInstant) {
  const auto cracks = [](const std::vector<SurfaceFace>& faces) {
    return std::count_if(faces.begin(), faces.end(), [](const SurfaceFace& face) { return face.crack; });
  };
  FragmentWatch watch;
  static_cast<void>(watch.look(domain, 1));
  const std::size_t outside = watch.free_faces(domain).size();
  EXPECT_EQ(cracks(watch.free_faces(domain)), 0);
  break_joints(domain, faces_of_surface(model, "box.slit"));
  step(domain);
  static_cast<void>(watch.look(domain, 1));
  EXPECT_EQ(cracks(watch.free_faces(domain)), 8) << "four faces, both sides";
  EXPECT_EQ(watch.free_faces(domain).size(), outside + 8);
}

TEST_F(FragmentLabels, AreAlikeInACubeAndDifferInTheOther) {
  break_joints(domain, faces_of_surface(model, "box.slit"));
  step(domain);
  const std::vector<GlobalId> label = find_fragments(domain).of_slot;
  const auto label_of = [&](Index element) {
    return label[static_cast<std::size_t>(model.local.slot_of_element[static_cast<std::size_t>(element)])];
  };
  const auto cube_of = [&](Index element) {
    double x = 0;
    for (const Index node : model.mesh.elements[static_cast<std::size_t>(element)])
      x += 0.25 * model.mesh.nodes[static_cast<std::size_t>(node)][0];
    return x < test::kCubeEdge ? 0 : 1;
  };
  for (Index e = 1; e < model.mesh.num_elements(); ++e)
    EXPECT_EQ(label_of(e) == label_of(0), cube_of(e) == cube_of(0)) << "element " << e;
}

}  // namespace
}  // namespace breccia::fragment_labels_test
