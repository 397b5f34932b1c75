#include "contact/initial_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/contact_search.hpp"
#include "contact/search_params.hpp"
#include "physics/contact/forces.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::initial_overlap_test {
namespace {

constexpr double kCube = 0.010, kGap = 0.001, kPenalty = 4e9, kRoundOff = 1e-12;  // m, m, Pa, m
constexpr double kShallow = 1e-4;  // m, less than contact points are away from the sides

/// Two cubes of 10 mm, 1 mm apart along x.
case_::Case cubes(const std::string& more = "") {
  return case_::read_text(test::raster_case({.title = "cubes",
                                             .group = "cubes",
                                             .boxes = {2, 1, 1},
                                             .gap = kGap,
                                             .young = 40e9,
                                             .density = 2400,
                                             .contact_penalty = kPenalty,
                                             .sections = more + "\n[contact_points]\nper_face = 3\n",
                                             .end = 1e-6}));
}

/// The model with its second cube moved along x, m.
Model moved(const case_::Case& input, double by) {
  Model model = build_model(input);
  std::vector<bool> done(model.mesh.nodes.size(), false);
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    if (model.mesh.element_body[static_cast<std::size_t>(e)] != 1) continue;
    const Index slot = model.local.slot_of_element[static_cast<std::size_t>(e)];
    for (int c = 0; c < 4; ++c) {
      const auto node =
          static_cast<std::size_t>(model.mesh.elements[static_cast<std::size_t>(e)][static_cast<std::size_t>(c)]);
      if (!done[node]) model.mesh.nodes[node][0] += by;
      done[node] = true;
      store_node(model.local.reference.data(), model.local.corner_node(slot, c), model.mesh.nodes[node]);
    }
  }
  return model;
}

TEST(InitialOverlap, OfTwoCubesHasTheirDepthAndBodies) {
  const std::vector<BodyOverlap> overlaps = initial_overlaps(moved(cubes(), -2 * kGap));
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].body, 0);
  EXPECT_EQ(overlaps[0].other, 1);
  EXPECT_NEAR(overlaps[0].depth, kGap, kRoundOff);
  EXPECT_EQ(overlaps[0].points, 2 * 4 * 3) << "both sides of the overlap, four faces of three points each";
  EXPECT_EQ(overlaps[0].corners, 2) << "the middles; the others lie on the other cube's sides";
}

TEST(InitialOverlap, IsNotSeenWhereFacesTouchOrOverlapByRoundOff) {
  const double length = build_model(cubes()).whole.body_length[0];
  for (const double overlap : {-1e-3 * length, 0.0, 1e-15, 0.5 * kOverlapTolerance * length})
    EXPECT_TRUE(initial_overlaps(moved(cubes(), -kGap - overlap)).empty()) << overlap;
  EXPECT_EQ(initial_overlaps(moved(cubes(), -kGap - 2 * kOverlapTolerance * length)).size(), 1u);
}

TEST(InitialOverlap, IsFoundWhereBodiesCoincideThoughTheirSurfacesLieOnEachOther) {
  const std::vector<BodyOverlap> overlaps = initial_overlaps(moved(cubes(), -kCube - kGap));
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].points, 0);
  EXPECT_NEAR(overlaps[0].depth, kCube / 8, kRoundOff) << "of the middles of elements whose apex is the cube's centre";
}

TEST(InitialOverlap, IsNotOfABodyWithItselfWhereACrackIsOpenFromTheStart) {
  const case_::Case input =
      case_::read_text(test::raster_case({.title = "slit",
                                          .group = "cubes",
                                          .cells = {2, 2, 2},
                                          .boxes = {2, 1, 1},
                                          .gap = kGap,
                                          .mesh = "slit = { lower = [0, 0, 0.01], upper = [0.01, 0.02, 0.01] }\n",
                                          .young = 40e9,
                                          .density = 2400,
                                          .penalty_factor = 10,
                                          .tensile_strength = 5e6,
                                          .energy_mode_1 = 100,
                                          .contact_penalty = kPenalty,
                                          .sections = "[joints]\nbroken = [\"cubes.slit\"]\n",
                                          .end = 1e-6}));
  EXPECT_TRUE(initial_overlaps(build_model(input)).empty());
}

/// Two cubes in contact; the second moves along x.
struct Pressed {
  Model model;
  ContactState contact;
  ContactSearch search;
  NodalState nodes;
  NodalForces forces;
  ContactWork work;

  explicit Pressed(const std::string& more, double by)
      : model(moved(cubes(more), by)),
        search(search_params(cubes(more), model), ContactModel{model.contact, model.mesh, model.topology, model.local},
               contact),
        forces(model.local.num_own_blocks(), model.local.num_nodes) {
    nodes.position = model.local.reference;
    nodes.velocity.assign(nodes.position.size(), 0.0);
    model.contact.rules.shares = false;  // what a point presses on in depth is a little sharper than the point
    relax_initial_overlaps(model.contact, model.local, nodes.position, contact);
  }

  [[nodiscard]] std::vector<Index> nodes_of_second() const {
    std::vector<Index> list;
    for (Index s = 0; s < model.local.num_slots; ++s) {
      for (int c = 0; c < 4 && model.local.slot_body[static_cast<std::size_t>(s)] == 1; ++c)
        list.push_back(model.local.corner_node(s, c));
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  /// Contact force on the second cube along x, N, when it has moved along x from where it began.
  double force_after(double by) {
    for (const Index n : nodes_of_second()) {
      const Vec3 before = load_node(nodes.position.data(), n);
      const Vec3 now = load_node(model.local.reference.data(), n) + Vec3(by, 0, 0);
      store_node(nodes.position.data(), n, now);
      store_node(nodes.velocity.data(), n, now - before);  // in a step of 1 s
    }
    search.search(nodes, std::abs(by));
    forces.clear();
    contact_forces(model.contact, model.local, nodes, 1.0, contact, forces, work);
    double sum = 0;
    for (const Index n : nodes_of_second()) sum += forces.get(n)[0];
    return sum;
  }
};

TEST(InitialOverlap, ThatIsRelaxedMakesNoForceUntilItBecomesDeeper) {
  Pressed pressed("initial_overlap = \"relax\"", -kGap - kShallow);
  EXPECT_EQ(pressed.force_after(0), 0.0);
  constexpr double deeper = 1e-5;
  const double length = pressed.model.whole.body_length[0];
  const double both_sides = 2 * kCube * kCube * kPenalty * deeper / length;
  EXPECT_NEAR(pressed.force_after(-deeper) / both_sides, 1.0, 1e-9);
  (void)pressed.force_after(deeper);  // apart again: in one step a pull takes back what the contact has gained
  EXPECT_EQ(pressed.force_after(deeper), 0.0);
  EXPECT_EQ(pressed.work.stored.value(), 0.0);
}

TEST(InitialOverlap, ThatIsAcceptedMakesItsForceAtOnce) {
  Pressed pressed("initial_overlap = \"accept\"", -kGap - kShallow);
  const double length = pressed.model.whole.body_length[0];
  EXPECT_NEAR(pressed.force_after(0) / (2 * kCube * kCube * kPenalty * kShallow / length), 1.0, 1e-9);
}

}  // namespace
}  // namespace breccia::initial_overlap_test
