#include "contact/kept_couples.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "unit/contact/breaking_boxes.hpp"

namespace breccia::kept_couples_test {
namespace {
using test::BreakingBoxes;
using test::OwnedContact;
using test::Pair;
using test::pairs;

BreakingBoxes two_boxes(std::mt19937_64& random) {
  BreakingBoxes model(test::joined(test::box({2, 2, 1}, 1.0), test::box({1, 2, 1}, 1.0, {1.95, 0.1, 0.2})));
  model.shake(random, 0.05);
  return model;
}

/// Slots on which a rank evaluates forces.
std::vector<std::uint8_t> some_slots(const BreakingBoxes& model, std::mt19937_64& random, double share) {
  std::bernoulli_distribution chosen(share);
  std::vector<std::uint8_t> marks(at(model.local.num_slots), 0);
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    if (chosen(random)) marks[at(model.local.slot_of_element[at(e)])] = 1;
  }
  return marks;
}

/// Of all couples, those of points with forces on an evaluated element.
std::vector<Pair> expected(const ContactSearch& all, const std::vector<std::uint8_t>& evaluated) {
  const ContactState& contact = all.contact();
  std::vector<bool> kept(contact.points.size(), false);
  for (const ContactCouple& c : contact.couples) {
    if (evaluated[at(contact.points[at(c.point)].slot)] != 0 || evaluated[at(contact.contactors[at(c.contactor)])] != 0)
      kept[at(c.point)] = true;
  }
  std::vector<Pair> result;
  for (const ContactCouple& c : contact.couples) {
    if (kept[at(c.point)]) result.emplace_back(contact.id(c.point), c.contactor);
  }
  return result;
}

TEST(KeptCouples, AreThoseOfPointsThatActOnEvaluatedElementsAfterEveryRelease) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::mt19937_64 random(seed);
    const BreakingBoxes model = two_boxes(random);
    const std::vector<std::uint8_t> evaluated = some_slots(model, random, seed % 2 == 0 ? 0.3 : 0.05);
    const std::vector<FreedFace> faces = model.some_faces(random, 0.6);
    OwnedContact all = model.make(), some = model.make();
    some.restrict_to(evaluated);
    for (OwnedContact* search : {&all, &some}) search->search(model.state, 0);
    ASSERT_GT(pairs(all).size(), 10u);
    EXPECT_EQ(pairs(some), expected(all, evaluated)) << "seed " << seed;
    for (std::size_t i = 0; i < faces.size(); i += 5) {
      const auto next = std::span(faces).subspan(i, std::min<std::size_t>(5, faces.size() - i));
      all.release_faces(next);
      some.release_faces(next);
      ASSERT_EQ(pairs(some), expected(all, evaluated)) << "seed " << seed << ", face " << i;
    }
    EXPECT_LT(pairs(some).size(), pairs(all).size());
  }
}

TEST(KeptCouples, TellWhenOneWithAnElementOfAnotherRankHasComeAbout) {
  std::mt19937_64 random(1);
  const BreakingBoxes model = two_boxes(random);
  const std::vector<std::uint8_t> evaluated = some_slots(model, random, 0.5);
  const std::vector<FreedFace> faces = model.some_faces(random, 1.0);
  OwnedContact search = model.make();
  search.restrict_to(evaluated);
  search.search(model.state, 0);
  EXPECT_TRUE(search.release_faces(faces));
  EXPECT_FALSE(search.release_faces(faces)) << "they are free already";

  OwnedContact alone = model.make();
  alone.search(model.state, 0);
  EXPECT_FALSE(alone.release_faces(faces)) << "there is no other rank";
  EXPECT_FALSE(pairs(alone).empty());
}

}  // namespace
}  // namespace breccia::kept_couples_test
