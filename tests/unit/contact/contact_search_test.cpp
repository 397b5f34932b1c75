#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/error.hpp"
#include "contact/contact_search.hpp"
#include "unit/physics/contact/scene.hpp"

namespace breccia {
namespace {

using test::at;

const ContactLaw kLaw{1e6, std::numeric_limits<double>::infinity(), 1, 0, 1};

struct WithContactState {
  ContactState state;
};

/// A search with the state that it keeps up to date.
class OwnedContact : WithContactState, public ContactSearch {
 public:
  OwnedContact(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
               const Topology& topology, const LocalMesh& local)
      : ContactSearch(search, params, mesh, topology, local, state) {}
};

/// Boxes of breakable or unbreakable elements with a search over them.
struct Model {
  Mesh mesh;
  Topology topology;
  LocalMesh local;
  ContactParams params;
  ContactSearchParams search;
  NodalState state;

  explicit Model(Mesh m, bool breakable = true, int points = 3) : mesh(std::move(m)), topology(build_topology(mesh)) {
    const std::size_t groups = mesh.volume_groups.size();
    local = build_local_mesh(mesh, std::vector(groups, Discretisation::own_nodes), std::vector(groups, 1000.0));
    params.points_per_face = points;
    params.num_groups = static_cast<Index>(groups);
    params.laws.assign(groups * groups, kLaw);
    search.breakable.assign(groups, breakable);
    state.position = local.reference;
    state.velocity.assign(local.reference.size(), 0.0);
  }
  [[nodiscard]] OwnedContact make() const { return OwnedContact(search, params, mesh, topology, local); }

  void shake(std::mt19937_64& random, double by) {
    std::uniform_real_distribution<double> jitter(-by, by);
    for (double& x : state.position) x += jitter(random);
  }
  void shift(Index body, const Vec3& by) {
    for (Index s = 0; s < local.num_slots; ++s) {
      for (int c = 0; c < 4 && local.slot_body[at(s)] == body; ++c) {
        const Index n = local.corner_node(s, c);
        store_node(state.position.data(), n, load_node(state.position.data(), n) + by);
      }
    }
  }
  /// A share of the inner faces, one side each.
  [[nodiscard]] std::vector<FreedFace> some_faces(std::mt19937_64& random, double share) const {
    std::vector<FreedFace> faces;
    std::bernoulli_distribution chosen(share);
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        const FaceLink& link = topology.links[at(e)][at(f)];
        if (!link.free() && e < link.neighbour && chosen(random)) faces.push_back({local.slot_of_element[at(e)], f});
      }
    }
    std::shuffle(faces.begin(), faces.end(), random);
    return faces;
  }
};

using Pair = std::pair<GlobalId, Index>;

std::vector<Pair> pairs(const ContactSearch& search) {
  std::vector<Pair> result;
  for (const ContactCouple& c : search.contact().couples)
    result.emplace_back(search.contact().id(c.point), c.contactor);
  return result;
}

TEST(contact_search, couples_are_sorted_and_unique_after_every_release) {
  std::mt19937_64 random(1);
  Model model(test::box({2, 2, 2}, 1.0));
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

TEST(contact_search, faces_released_one_by_one_give_the_couples_of_a_full_search) {
  for (const detection::Algorithm algorithm :
       {detection::Algorithm::packed_tree, detection::Algorithm::sorted_grid, detection::Algorithm::ms}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      std::mt19937_64 random(seed);
      Model model(test::joined(test::box({2, 2, 1}, 1.0), test::box({1, 2, 1}, 1.0, {2.02, 0.1, 0.2})));
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

TEST(contact_search, couples_of_a_release_are_fresh_and_push_nobody) {
  std::mt19937_64 random(7);
  Model model(test::box({2, 1, 1}, 1.0));
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

TEST(contact_search, both_sides_of_a_face_are_freed_once_however_often_it_is_named) {
  Model model(test::box({1, 1, 1}, 1.0));
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

TEST(contact_search, the_field_sinks_around_a_body_that_breaks_up) {
  Model model(test::box({1, 1, 1}, 1.0));
  model.params.ramp_steps = 3;
  std::mt19937_64 random(1);
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  search.release_faces(model.some_faces(random, 1.0));
  NodalForces forces(model.local.num_own_blocks(), model.local.num_nodes);
  ContactWork work;
  for (int i = 0; i < 4; ++i) search.forces(model.state, 1e-6, forces, work);
  for (const FieldValues& values : search.contact().field) {
    for (int a = 0; a < 4; ++a) EXPECT_EQ(values[at(a)], 0);
    EXPECT_GT(values[4], 0) << "every element is a fragment of its own";
  }
}

TEST(contact_search, searches_only_when_the_buffer_is_used_up) {
  Model model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.5, 0, 0})));
  model.search.buffer = 0.2;
  model.search.verify = true;
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  EXPECT_EQ(search.num_searches(), 1);
  for (int i = 0; i < 1000; ++i) {  // trembling: 10 m of path, but never away by more than 0.01 m
    model.shift(1, {i % 2 == 0 ? 0.01 : -0.01, 0, 0});
    search.update(model.state, 0.01, 1);
  }
  EXPECT_EQ(search.num_searches(), 1);
  for (int i = 0; i < 60; ++i) {  // through each other: 0.6 m
    model.shift(1, {-0.01, 0, 0});
    search.update(model.state, 0.01, 1);
  }
  EXPECT_GE(search.num_searches(), 1 + 2)
      << "one for every step beyond a buffer, as each moves by half of it against the other";
  EXPECT_LE(search.num_searches(), 1 + 4) << "or three quarters of it";
  EXPECT_GT(search.contact().couples.size(), 0u);
}

TEST(contact_search, is_not_done_anew_for_bodies_that_fly_together) {
  Model model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.05, 0, 0})));
  model.search.buffer = 0.2;
  model.search.verify = true;
  OwnedContact search = model.make();
  search.update(model.state, 0, 0);
  for (int i = 0; i < 100; ++i) {  // 5 m
    for (const Index body : {0, 1}) model.shift(body, {0.03, 0.04, 0});
    search.update(model.state, 0.05, 1);
  }
  EXPECT_EQ(search.num_searches(), 1);
  EXPECT_GT(search.contact().couples.size(), 0u);
}

TEST(contact_search, never_misses_a_couple_that_touches_under_random_motion) {
  // The drift of all counts for nothing, the random motion of each for all.
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 0.004);
  Model model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {0.9, 0.3, 0.2})));
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

TEST(contact_search, that_is_told_a_speed_too_low_is_caught_by_verify) {
  Model model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {1.5, 0, 0})));
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

TEST(contact_search, contactors_of_an_unbreakable_body_are_the_elements_at_its_surface) {
  const Model breakable(test::box({4, 4, 4}, 1.0)), unbreakable(test::box({4, 4, 4}, 1.0), false);
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

TEST(contact_search, points_can_be_restricted_to_some_faces) {
  Model model(test::box({1, 1, 1}, 1.0));
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

TEST(contact_search, groups_without_a_law_make_no_couples) {
  Model model(test::joined(test::box({1, 1, 1}, 1.0), test::box({1, 1, 1}, 1.0, {0.9, 0, 0})));
  model.params.laws = {kLaw, {}, {}, kLaw};
  OwnedContact apart = model.make();
  apart.update(model.state, 0, 0);
  EXPECT_TRUE(apart.contact().couples.empty());
  model.params.laws = {{}, kLaw, kLaw, {}};
  OwnedContact together = model.make();
  together.update(model.state, 0, 0);
  EXPECT_FALSE(together.contact().couples.empty());
}

TEST(contact_search, chooses_a_larger_buffer_when_a_small_one_would_not_last) {
  Model model(test::box({1, 1, 1}, 1.0));
  OwnedContact slow = model.make(), fast = model.make();
  slow.update(model.state, 1, 1e-6);
  fast.update(model.state, 1, 1.0);
  EXPECT_GT(slow.buffer(), 0);
  EXPECT_NEAR(fast.buffer() / slow.buffer(), 4, 1e-12);
}

}  // namespace
}  // namespace breccia
