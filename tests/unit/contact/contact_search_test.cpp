#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error.hpp"
#include "contact/contact_search.hpp"
#include "unit/contact/breaking_boxes.hpp"

namespace breccia::contact_search_test {
namespace {

using test::BreakingBoxes;
using test::OwnedContact;

TEST(ContactSearch, NeverMissesACoupleThatTouchesUnderRandomMotion) {
  // The drift of all counts for nothing, the random motion of each for all.
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 0.004);
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {0.9, 0.3, 0.2})));
  model.search.buffer = 0.08;
  model.search.verify = true;
  OwnedContact search = model.make();
  const std::vector<FreedFace> faces = model.some_faces(random, 0.6);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    double largest = 0;
    for (Index n = 0; n < model.local.num_nodes; ++n) {
      const Vec3 by = Vec3(0.02, 0, -0.01) + Vec3(normal(random), normal(random), normal(random));
      largest = std::max(largest, by.norm());
      store_node(model.state.position.data(), n, load_node(model.state.position.data(), n) + by);
    }
    search.update(model.state, largest, 1);
    search.release_faces(std::span(faces).subspan(i, 1));
    EXPECT_NO_THROW(search.update(model.state, 0, 1)) << "step " << i;
  }
  EXPECT_GT(search.num_searches(), 3);
}

TEST(ContactSearch, LetsForcesPassOverCouplesThatAreApartAndChangesNoBit) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, 3e-4);
  const Mesh boxes = test::joined(test::box({2, 2, 2}, 0.5), test::box({2, 2, 2}, 0.5, {1.1, 0.3, 0.2}));
  BreakingBoxes model(boxes);
  model.search.buffer = 0.3;
  model.search.verify = true;
  OwnedContact passing = model.make(), looking = model.make();
  NodalForces forces_of_passing(model.local.num_own_blocks(), model.local.num_nodes),
      forces_of_looking = forces_of_passing;
  ContactWork work_of_passing, work_of_looking;
  const std::vector<FreedFace> faces = model.some_faces(random, 0.3);
  std::size_t apart = 0, all = 0, touching = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    double largest = 0;
    for (Index n = 0; n < model.local.num_nodes; ++n) {
      const Vec3 x = load_node(model.local.reference.data(), n);
      const Vec3 by(normal(random) + (x[0] < 1.05 ? 4e-3 : -4e-3), normal(random), normal(random));
      largest = std::max(largest, by.norm());
      store_node(model.state.position.data(), n, load_node(model.state.position.data(), n) + by);
      store_node(model.state.velocity.data(), n, by);
    }
    for (OwnedContact* search : {&passing, &looking}) {
      search->update(model.state, largest, 1);
      // Not in every step: new couples reset until when points are passed over.
      if (i % 4 == 0 && i / 4 < faces.size()) search->release_faces(std::span(faces).subspan(i / 4, 1));
    }
    looking.look_at_all();
    forces_of_passing.clear();
    forces_of_looking.clear();
    passing.forces(model.state, 1, forces_of_passing, work_of_passing);
    looking.forces(model.state, 1, forces_of_looking, work_of_looking);
    for (Index n = 0; n < model.local.num_nodes; ++n) ASSERT_EQ(forces_of_passing.get(n), forces_of_looking.get(n));
    const ContactState& contact = passing.contact();
    const auto evaluated = std::count_if(contact.awake.begin(), contact.awake.end(), [&](const AwakeCouple& couple) {
      return !(contact.travel < couple.apart_until);
    });
    apart += contact.couples.size() - at(evaluated);
    all += contact.couples.size();
    touching += passing.contact().touching.size();
  }
  EXPECT_GT(touching, 100U);
  EXPECT_GT(apart, all / 2);
}

TEST(ContactSearch, ThatIsToldASpeedTooLowIsCaughtByVerify) {
  BreakingBoxes model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.5, 0, 0})));
  model.search.verify = true;
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  model.shift(1, {-0.8, 0, 0});
  try {
    search.update(model.state, 0, 1);
    FAIL() << "no error";
  } catch (const InternalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("contact point"));
    EXPECT_THAT(error.what(), testing::HasSubstr("of element"));
    EXPECT_THAT(error.what(), testing::HasSubstr("touches element"));
  }
}

}  // namespace
}  // namespace breccia::contact_search_test
