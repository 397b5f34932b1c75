#include <gtest/gtest.h>

#include <random>
#include <set>

#include "contact/face_release.hpp"
#include "unit/contact/breaking_boxes.hpp"

namespace breccia::face_release_test {
namespace {
using test::BreakingBoxes;
using test::OwnedContact;
using test::Pair;
using test::pairs;

TEST(FaceRelease, CouplesAreSortedAndUniqueAfterEveryRelease) {
  std::mt19937_64 random(1);
  BreakingBoxes model(test::box({2, 2, 2}, 1.0));
  model.shake(random, 0.02);
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  EXPECT_TRUE(pairs(search).empty()) << "a whole body does not touch itself";
  const std::vector<FreedFace> faces = model.some_faces(random, 0.7);
  for (std::size_t i = 0; i < faces.size(); i += 20) {
    search.release_faces(std::span(faces).subspan(i, std::min<std::size_t>(20, faces.size() - i)));
    const std::vector<Pair> found = pairs(search);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::set<Pair>(found.begin(), found.end()).size(), found.size());
  }
  EXPECT_GT(pairs(search).size(), 1000u);
}

TEST(FaceRelease, FacesReleasedOneByOneGiveTheCouplesOfAFullSearch) {
  for (const detection::Algorithm algorithm :
       {detection::Algorithm::packed_tree, detection::Algorithm::sorted_grid, detection::Algorithm::ms}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      std::mt19937_64 random(seed);
      BreakingBoxes model(test::joined(test::box({2, 2, 1}, 1.0), test::box({1, 2, 1}, 1.0, {2.02, 0.1, 0.2})));
      model.search.algorithm = algorithm;
      model.shake(random, 0.05);
      const std::vector<FreedFace> faces = model.some_faces(random, 0.5);

      OwnedContact by_and_by = model.make();
      by_and_by.update(model.state, 0, 0);
      for (std::size_t i = 0; i < faces.size();) {
        const std::size_t count = std::min<std::size_t>(1 + i % 7, faces.size() - i);
        by_and_by.release_faces(std::span(faces).subspan(i, count));
        i += count;
      }
      EXPECT_EQ(by_and_by.num_searches(), 1);

      OwnedContact at_once = model.make();
      at_once.release_faces(faces);
      at_once.update(model.state, 0, 0);
      ASSERT_GT(pairs(at_once).size(), 100u);
      EXPECT_EQ(pairs(by_and_by), pairs(at_once)) << "seed " << seed;
      EXPECT_EQ(by_and_by.contact().points.size(), at_once.contact().points.size());
    }
  }
}

TEST(FaceRelease, CouplesOfAReleaseAreFreshAndPushNobody) {
  std::mt19937_64 random(7);
  BreakingBoxes model(test::box({2, 1, 1}, 1.0));
  model.shake(random, 0.05);  // neighbours overlap by this much
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  search.release_faces(model.some_faces(random, 1.0));
  EXPECT_EQ(search.contact().fresh, search.contact().couples);
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  ContactWork work;
  search.forces(model.state, 1e-6, forces, work);
  EXPECT_GT(search.contact().touching.size(), 50u);
  EXPECT_EQ(work.touching, 0);
  for (Index n = 0; n < model.local.num_nodes; ++n) ASSERT_EQ(forces.get(n), Vec3(0, 0, 0));
}

TEST(FaceRelease, BothSidesOfAFaceAreFreedOnceHoweverOftenItIsNamed) {
  BreakingBoxes model(test::box({1, 1, 1}, 1.0));
  OwnedContact search = model.make();
  const std::size_t before = search.contact().points.size();
  int face = 0;
  while (model.topology.links[0][at(face)].free()) ++face;
  const FaceLink link = model.topology.links[0][at(face)];
  const FreedFace one{model.local.slot_of_element[0], face},
      other{model.local.slot_of_element[at(link.neighbour)], link.face()};
  search.release_faces(std::vector{one, other, one});
  EXPECT_EQ(search.contact().points.size(), before + 6);
  search.release_faces(std::vector{other});
  EXPECT_EQ(search.contact().points.size(), before + 6);
}

TEST(FaceRelease, TheFieldSinksAroundABodyThatBreaksUp) {
  BreakingBoxes model(test::box({1, 1, 1}, 1.0));
  std::mt19937_64 random(1);
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  search.release_faces(model.some_faces(random, 1.0));
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  ContactWork work;
  for (int i = 0; i < 4; ++i) search.forces(model.state, 1e-6, forces, work);
  for (const FieldValues& values : search.contact().field) {
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_NE(has_face(values.sides, a), (values.sides >> face_set(a) & 1) != 0) << "a fragment has four faces";
    EXPECT_EQ(values.sides & kSmallSets, 0) << "what faces cover is dropped";
    EXPECT_EQ(num_planes(values.sides), 0U) << "nothing lies beside it";
  }
}

}  // namespace
}  // namespace breccia::face_release_test
