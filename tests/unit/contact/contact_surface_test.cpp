#include <gtest/gtest.h>

#include <random>

#include "contact/contact_surface.hpp"
#include "unit/contact/breaking_boxes.hpp"

namespace breccia {
namespace {

using test::at;
using test::BreakingBoxes;
using test::kLaw;
using test::OwnedContact;

TEST(contact_surface, contactors_of_an_unbreakable_body_are_the_elements_at_its_surface) {
  const BreakingBoxes breakable(test::box({4, 4, 4}, 1.0)), unbreakable(test::box({4, 4, 4}, 1.0), false);
  EXPECT_EQ(breakable.make().contact().contactors.size(), 24u * 64u);
  const OwnedContact search = unbreakable.make();
  std::size_t at_surface = 0;
  for (Index e = 0; e < unbreakable.mesh.num_elements(); ++e) {
    bool touches = false;
    for (const Index n : unbreakable.mesh.elements[at(e)]) {
      const Vec3& x = unbreakable.mesh.nodes[at(n)];
      touches = touches || x.minCoeff() < 1e-9 || x.maxCoeff() > 4 - 1e-9;
    }
    at_surface += touches;
  }
  EXPECT_EQ(search.contact().contactors.size(), at_surface);
  EXPECT_LT(at_surface, 24u * 64u);
}

TEST(contact_surface, points_can_be_restricted_to_some_faces) {
  BreakingBoxes model(test::box({1, 1, 1}, 1.0));
  model.search.everywhere = false;
  int inner = 0;
  while (model.topology.links[0][at(inner)].free()) ++inner;
  model.search.faces = {{0, inner}};
  OwnedContact search = model.make();
  EXPECT_TRUE(search.contact().points.empty()) << "still closed";
  std::mt19937_64 random(1);
  search.release_faces(model.some_faces(random, 1.0));
  EXPECT_EQ(search.contact().points.size(), 6u) << "both sides of the one face";
}

TEST(contact_surface, groups_without_a_law_make_no_couples) {
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {0.9, 0, 0})));
  model.params.laws = {kLaw, {}, {}, kLaw};
  OwnedContact apart = model.make();
  apart.update(model.state, 0, 0);
  EXPECT_TRUE(apart.contact().couples.empty());
  model.params.laws = {{}, kLaw, kLaw, {}};
  OwnedContact together = model.make();
  together.update(model.state, 0, 0);
  EXPECT_FALSE(together.contact().couples.empty());
}

}  // namespace
}  // namespace breccia
