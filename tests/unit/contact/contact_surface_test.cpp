#include <gtest/gtest.h>

#include <random>

#include "contact/contact_surface.hpp"
#include "unit/contact/breaking_boxes.hpp"

namespace breccia::contact_surface_test {
namespace {
using test::BreakingBoxes;
using test::kLaw;
using test::OwnedContact;

TEST(ContactSurface, ContactorsOfAnUnbreakableBodyAreTheElementsAtItsSurface) {
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

TEST(ContactSurface, PointsCanBeRestrictedToSomeFaces) {
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

TEST(ContactSurface, GroupsWithoutALawMakeNoCouples) {
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

TEST(ContactSurface, GroupsWithoutAnyLawAreLeftOutOfTheSearchWhateverItIs) {
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {0.9, 0, 0})));
  model.params.laws = {{}, kLaw, {}, {}};  // points of the first against elements of the second
  std::vector<ContactCouple> first;
  for (const auto algorithm :
       {detection::Algorithm::ms, detection::Algorithm::ms_slices, detection::Algorithm::sorted_grid,
        detection::Algorithm::packed_tree, detection::Algorithm::brute_force}) {
    model.search.algorithm = algorithm;
    OwnedContact one_way = model.make();
    one_way.update(model.state, 0, 0);
    EXPECT_FALSE(one_way.contact().couples.empty());
    if (first.empty()) first = one_way.contact().couples;
    EXPECT_EQ(one_way.contact().couples, first);
  }
  ContactState contact;
  const ContactSurface surface(model.search, {model.params, model.mesh, model.topology, model.local}, contact);
  const auto slot_in = [&](Index group) {
    Index e = 0;
    while (model.mesh.element_group[at(e)] != group) ++e;
    return model.local.slot_of_element[at(e)];
  };
  EXPECT_TRUE(surface.may_press(slot_in(0)) && surface.may_be_pressed(slot_in(1)));
  EXPECT_FALSE(surface.may_press(slot_in(1)) || surface.may_be_pressed(slot_in(0)));
}

}  // namespace
}  // namespace breccia::contact_surface_test
