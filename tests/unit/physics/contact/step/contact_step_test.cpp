#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "mesh/quality.hpp"
#include "physics/contact/geometry/field.hpp"
#include "physics/contact/geometry/overlap.hpp"
#include "physics/contact/geometry/point.hpp"
#include "physics/contact/step/contact_step.hpp"
#include "physics/contact/step/elements.hpp"
#include "physics/contact/step/upper_bounds.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::contact_step_test {
namespace {

using test::Model;

constexpr double kDensity = 2500, kPenalty = 3e9;
/// Statements that hold exactly in real numbers.
constexpr double kSlack = 1e-9;

/// Several boxes of one group, free to meet.
struct Scene {
  Model model;
  ContactParams params;
  std::vector<double> length;
  ContactFaces faces;
  std::vector<std::uint8_t> held;

  explicit Scene(Mesh mesh, Discretisation kind = Discretisation::shared_nodes)
      : model(std::move(mesh), kind, kDensity) {
    params.num_groups = 1;
    params.laws.resize(1);
    params.laws[0].penalty = kPenalty;
    length = mean_inradii(model.mesh);
    for (auto* bits : {&faces.open, &faces.torn, &faces.pointed}) bits->assign(at(model.local.num_slots), 0);
    for (const LoadedFace& face : model.free_faces())
      faces.open[at(face.slot)] |= static_cast<std::uint8_t>(1U << face.face);
    std::fill(faces.pointed.begin(), faces.pointed.end(), std::uint8_t{15});
    held.assign(at(model.local.num_nodes), 0);
  }

  [[nodiscard]] ContactStepModel step_model() const { return {params, model.local, length, faces, held}; }
  [[nodiscard]] Index body_of(Index slot) const { return model.local.slot_body[at(slot)]; }

  template <class F>
  void for_each_node_of(Index body, F&& f) {
    for (Index s = 0; s < model.local.num_slots; ++s) {
      if (body_of(s) != body) continue;
      for (int c = 0; c < 4; ++c) f(model.local.corner_node(s, c));
    }
  }
  void move(Index body, const Vec3& by) {
    for_each_node_of(body, [&](Index n) {
      store_node(model.state.position.data(), n, load_node(model.local.reference.data(), n) + by);
    });
  }
  void fly(Index body, const Vec3& velocity) {
    for_each_node_of(body, [&](Index n) { store_node(model.state.velocity.data(), n, velocity); });
  }
  void hold(Index body) {
    for_each_node_of(body, [&](Index n) { held[at(n)] = 1; });
  }

  [[nodiscard]] ContactElements elements() const {
    ContactElements all;
    all.update(step_model());
    return all;
  }
  [[nodiscard]] ContactPatches patches() const {
    return contact_patches(step_model(), elements(), model.state.position, model.state.velocity, 1.0);
  }
  [[nodiscard]] std::vector<ContactShare> shares(double time = 0) const {
    ContactPatches sorted = patches();
    sorted.sort();
    return contact_shares(step_model(), elements(), sorted, time);
  }
  [[nodiscard]] double largest(double time = 0) const {
    double most = 0;
    for (const ContactShare& share : shares(time)) most = std::max(most, share.largest());
    return most;
  }
  /// Largest eigenvalue of M^-1 K of all couples that touch, normals along z: sum w sigma_p/H (N, -lambda)(N,
  /// -lambda)^T.
  [[nodiscard]] double true_largest() const {
    const LocalMesh& mesh = model.local;
    const FaceRule& rule = face_rule(params.points_per_face);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(mesh.num_nodes, mesh.num_nodes);
    for (const LoadedFace& face : model.free_faces()) {
      std::vector<ContactPoint> points;
      append_points(rule, mesh, face.slot, face.face, points);
      for (const ContactPoint& point : points) {
        const Vec3 x = at_point(rule, point, model.state.position.data());
        for (Index s = 0; s < mesh.num_slots; ++s) {
          if (body_of(s) < 0 || body_of(s) == body_of(face.slot)) continue;
          const PreparedTetra tetra = prepare(load_corners(mesh, model.state.position.data(), s), mesh.volume[at(s)]);
          const std::array<double, 4> lambda = barycentric(tetra, x);
          if (!inside(lambda)) continue;
          Eigen::VectorXd r = Eigen::VectorXd::Zero(mesh.num_nodes);
          for (std::size_t i = 0; i < 3; ++i) r[point.nodes[i]] += rule.shape[static_cast<std::size_t>(point.k)][i];
          for (int a = 0; a < 4; ++a) r[mesh.corner_node(s, a)] -= lambda[static_cast<std::size_t>(a)];
          k += point.weight * kPenalty / length[at(body_of(s))] * r * r.transpose();
          break;
        }
      }
    }
    Eigen::VectorXd root(mesh.num_nodes);
    for (Index n = 0; n < mesh.num_nodes; ++n)
      root[n] = held[at(n)] != 0 ? 0.0 : 1.0 / std::sqrt(mesh.node_mass[at(n)]);
    k = root.asDiagonal() * k * root.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  }
};

Mesh two_boxes(double gap) { return test::box({2, 2, 1}, 1.0, {1, 1, 2}, gap); }

TEST(ContactStep, OfBoxesThatLieOnEachOtherIsNeverAboveTheTrueLimitAndNotFarBelow) {
  constexpr double kMostCautious = 3.0;  // of omega^2: node by node instead of together, points as bad as they can lie
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shift(-0.7, 0.7);
  for (const Discretisation kind : {Discretisation::shared_nodes, Discretisation::own_nodes}) {
    for (const int points : {1, 3, 4, 6}) {
      Scene scene(two_boxes(0.01), kind);
      scene.params.points_per_face = points;
      double worst = 0;
      for (int i = 0; i < 6; ++i) {
        scene.move(1, i == 0 ? Vec3(0, 0, -0.02) : Vec3(shift(random), shift(random), -0.02));
        const double limit = scene.true_largest(), found = scene.largest();
        EXPECT_GE(found, limit * (1 - kSlack)) << points << " points, place " << i;
        worst = std::max(worst, limit / found);
      }
      EXPECT_GE(worst, 1 / kMostCautious) << points;
    }
  }
}

TEST(ContactStep, WithDampingIsStableWithTheSpeedOfHalfAStepBefore) {
  Scene scene(two_boxes(0.01));
  scene.move(1, Vec3(0.13, 0.27, -0.02));
  const double elastic = scene.largest();
  for (const double ratio : {0.1, 0.5, 1.0}) {
    scene.params.laws[0].damping = 2 * ratio * std::sqrt(kPenalty * kDensity / 2);
    const double step = 2 / std::sqrt(scene.largest());
    const double omega_squared = scene.true_largest();
    const double decay = omega_squared * scene.params.laws[0].damping * scene.length[0] / kPenalty;
    EXPECT_LT(step, 2 / std::sqrt(elastic));
    EXPECT_LE(0.25 * omega_squared * step * step + 0.5 * decay * step, 1 + kSlack) << ratio;
  }
}

TEST(ContactStep, CountsWhoeverCarriesThePoints) {
  Scene both(two_boxes(0.01));
  both.move(1, Vec3(0, 0, -0.02));
  EXPECT_GT(both.largest(), 0.0);
  std::fill(both.faces.pointed.begin(), both.faces.pointed.end(), std::uint8_t{0});
  EXPECT_EQ(both.largest(), 0.0);
}

TEST(ContactStep, OfABoxOnAHeldOneCountsItsOwnNodesAlone) {
  Scene scene(two_boxes(0.01));
  scene.move(1, {0.1, 0.2, -0.02});
  const double both = scene.largest();
  scene.hold(0);
  const double one = scene.largest();
  EXPECT_LT(one, 0.65 * both) << "half but for the weights of points";
  EXPECT_GE(one, scene.true_largest() * (1 - kSlack));
}

TEST(ContactStep, NothingCountsThatCannotBeReached) {
  Scene scene(two_boxes(5.0));
  EXPECT_EQ(scene.largest(), 0.0);
  scene.fly(1, {0, 0, -2.0});
  // 5 m at 2 m/s with the margin of kSpeedMargin, less a share of the faces' size.
  EXPECT_EQ(scene.largest(0.8), 0.0);
  EXPECT_GT(scene.largest(5.0 / (2.0 * kSpeedMargin)), 0.0);
  scene.fly(0, {0, 0, -2.0});  // together: no nearer
  EXPECT_EQ(scene.largest(100.0), 0.0);
}

TEST(ContactStep, IsThatOfThePairAndNotOfALightBodyFarAway) {
  const Mesh mesh = test::box({1, 1, 1}, 1.0, {1, 1, 3}, 0.001);
  Scene scene(mesh);
  scene.move(2, {0, 0, 30});
  const double far = scene.largest();
  ASSERT_GT(far, 0.0);
  Scene light(mesh);
  for (Index s = 0; s < light.model.local.num_slots; ++s) {
    if (light.body_of(s) != 2) continue;
    for (int c = 0; c < 4; ++c) light.model.local.node_mass[at(light.model.local.corner_node(s, c))] *= 1e-6;
  }
  light.move(2, {0, 0, 30});
  EXPECT_EQ(light.largest(), far);
  light.move(2, {0, 0, 0});
  EXPECT_GT(light.largest(), 1e4 * far);
}

TEST(ContactStep, ABodyMeetsItselfOnlyWhereItIsTornOrFolded) {
  Scene scene(test::box({4, 1, 1}), Discretisation::own_nodes);
  EXPECT_EQ(scene.largest(1.0), 0.0);
  const Index slot = scene.model.local.slot_of_element[0];
  for (int f = 0; f < 4; ++f) {
    if ((scene.faces.open[at(slot)] >> f & 1) == 0) {
      scene.faces.open[at(slot)] |= static_cast<std::uint8_t>(1U << f);
      scene.faces.torn[at(slot)] |= static_cast<std::uint8_t>(1U << f);
    }
  }
  EXPECT_GT(scene.largest(), 0.0);

  Scene folded(test::box({40, 1, 1}, 1.0));
  const double pi = std::acos(-1.0), radius = 40 / (2 * pi);
  folded.model.map_positions([&](const Vec3& x) {  // a ring whose ends meet
    const double angle = 2 * pi * x[0] / 40.2, r = radius + x[2];
    return Vec3(r * std::cos(angle), x[1], r * std::sin(angle));
  });
  EXPECT_GT(folded.largest(), 0.0);
}

TEST(ContactStep, IsTheSameBitsFromAnyPartsOfTheModel) {
  Scene whole(test::box({2, 2, 2}, 1.0, {2, 2, 2}, 0.05));
  for (Index b = 0; b < 8; ++b) whole.fly(b, {0.1 * b, -0.2 * b, 0.05 * b * b});
  const auto expected = whole.shares(0.3);
  std::vector<std::vector<ContactPatch>> of_all;
  std::vector<Scene> parts;
  std::vector<ContactPatches> patches;
  for (const GlobalId part : {0, 1, 2}) {
    Scene& mine = parts.emplace_back(whole);
    for (Index s = 0; s < mine.model.local.num_slots; ++s) {
      if (mine.model.local.element_of_slot[at(s)] % 3 != part) mine.model.local.original[at(s)] = 0;
    }
    patches.push_back(mine.patches());
    of_all.insert(of_all.begin(), patches.back().list);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const Scene& mine = parts[part];
    patches[part].merge(of_all);
    patches[part].sort();
    const auto shares = contact_shares(mine.step_model(), mine.elements(), patches[part], 0.3);
    for (Index s = 0; s < mine.model.local.num_slots; ++s) {
      if (!mine.model.local.is_original(s)) continue;
      EXPECT_EQ(shares[at(s)].omega_squared, expected[at(s)].omega_squared);
      EXPECT_EQ(shares[at(s)].face, expected[at(s)].face);
    }
  }
}

/// 27 boxes of uneven elements, which fly.
Scene uneven_boxes() {
  Scene scene(test::jittered(test::box({2, 2, 2}, 1.0, {3, 3, 3}, 0.2), 0.08, 4));
  for (Index b = 0; b < 27; ++b) scene.fly(b, {0.1 * (b % 5), -0.2 * (b % 7), 0.05 * (b % 11)});
  return scene;
}

TEST(ContactStep, IsTheLargestOfAllPairsOfBodies) {
  const Scene scene = uneven_boxes();
  const ContactPatches patches = scene.patches();
  const ContactElements elements = scene.elements();
  const auto all = scene.shares(0.3);
  std::vector<std::array<double, 4>> largest(all.size());
  int met = 0;
  for (Index a = 0; a < 27; ++a) {
    for (Index b = 0; b < 27; ++b) {
      if (a == b) continue;
      ContactPatches two = patches;
      for (ContactPatch& p : two.list) {
        if (p.body == a || p.body == b) continue;
        p.largest[ContactPatch::box] -= 1e9;  // out of the way
        p.largest[ContactPatch::box + 3] += 1e9;
      }
      ContactShares shares(scene.step_model(), elements, two, 0.3);
      for (Index s = 0; s < scene.model.local.num_slots; ++s) {
        if (!scene.model.local.is_original(s) || scene.body_of(s) != a) continue;
        const ContactShare share = shares.of(s);
        met += share.largest() > 0 ? 1 : 0;
        for (std::size_t c = 0; c < 4; ++c) largest[at(s)][c] = std::max(largest[at(s)][c], share.omega_squared[c]);
      }
    }
  }
  EXPECT_GT(met, 1000);
  for (std::size_t s = 0; s < all.size(); ++s) EXPECT_EQ(all[s].omega_squared, largest[s]);
}

TEST(ContactStep, IsNeverMoreThanWhatIsFoundWithoutLookingWhoIsNear) {
  const Scene scene = uneven_boxes();
  const ContactPatches patches = scene.patches();
  const ContactElements elements = scene.elements();
  ContactShares shares(scene.step_model(), elements, patches, 0.3);
  for (Index s = 0; s < scene.model.local.num_slots; ++s) {
    if (!scene.model.local.is_original(s)) continue;
    EXPECT_LE(shares.of(s).largest(), shares.at_most(s));
  }
}

TEST(ContactStep, GrowsWithTheSlopeOfUnloading) {
  ContactLaw law;
  EXPECT_EQ(stiffest_slope(law), 0.0);
  law.penalty = kPenalty;
  EXPECT_EQ(stiffest_slope(law), kPenalty);
  law.exponent = 4;
  EXPECT_EQ(stiffest_slope(law), 4 * kPenalty);
}

void expect_kept_elements_to_follow(Discretisation kind) {
  Scene scene(two_boxes(0.01), kind);
  scene.move(1, {0, 0, -0.02});
  ContactState field;
  for (Index s = 0; s < scene.model.local.num_slots; ++s) field.contactor_of_slot.push_back(s);
  field.field.assign(field.contactor_of_slot.size(), {.depth = {2, 3, 4, 5}, .sides = 0});
  ContactElements known;
  const auto shares = [&](ContactElements* kept) {
    ContactStepModel model = scene.step_model();
    model.state = &field;
    ContactElements fresh, &elements = kept != nullptr ? *kept : fresh;
    elements.update(model);
    const NodalState& state = scene.model.state;
    const auto patches = contact_patches(model, elements, state.position, state.velocity, 1.0);
    std::vector<std::array<double, 4>> omega_squared;
    for (const ContactShare& share : contact_shares(model, elements, patches, 0))
      omega_squared.push_back(share.omega_squared);
    return omega_squared;
  };
  const auto expect_the_same_but_other_than = [&](const auto& before, const char* what) {
    auto now = shares(nullptr);
    EXPECT_EQ(shares(&known), now) << what;
    EXPECT_EQ(shares(&known), now) << what << ", evaluated again";
    EXPECT_NE(now, before) << what << " changes nothing";
    return now;
  };
  auto last = expect_the_same_but_other_than(std::vector<std::array<double, 4>>{}, "at first");
  for (FieldValues& values : field.field) values.sides = 1 << 3;
  last = expect_the_same_but_other_than(last, "a new side");
  std::fill(scene.faces.open.begin(), scene.faces.open.end(), std::uint8_t{15});
  last = expect_the_same_but_other_than(last, "open faces");
  scene.hold(0);
  expect_the_same_but_other_than(last, "a held body");
}

TEST(ContactStep, IsTheSameFromWhatIsKeptOfEarlierEvaluationsWhateverHasOpenedIsConstrainedOrHasNewSides) {
  expect_kept_elements_to_follow(Discretisation::own_nodes);
  expect_kept_elements_to_follow(Discretisation::shared_nodes);
}

/// The scene with damping, a sphere that some boxes pass, and a lighter body.
Scene with_all_contributions(Scene scene) {
  scene.params.laws[0].damping = 1e4;
  scene.params.sphere = SphericalBoundary{.centre = {4, 4, 4}, .radius = 3, .penalty = kPenalty};
  std::set<Index> nodes;
  scene.for_each_node_of(3, [&](Index n) { nodes.insert(n); });
  for (const Index n : nodes) scene.model.local.node_mass[at(n)] *= 0.5;
  return scene;
}

TEST(ContactStep, IsNoMoreThanTheUpperBoundsWhereverTheBodiesAre) {
  for (const Discretisation kind : {Discretisation::own_nodes, Discretisation::shared_nodes}) {
    const Scene scene =
        with_all_contributions(Scene(test::jittered(test::box({2, 2, 2}, 1.0, {2, 2, 2}, 0.2), 0.08, 4), kind));
    const ContactElements elements = scene.elements();
    const ContactStepModel model = scene.step_model();
    ContactUpperBounds bounds(model, elements);
    bounds.update();
    const std::vector<ContactShare> shares = scene.shares(0.3);
    double largest = 0, bound = 0;
    for (Index s = 0; s < scene.model.local.num_slots; ++s) {
      if (scene.faces.open[at(s)] == 0) continue;
      const ContactShare of_element = bounds.of(s);
      for (std::size_t c = 0; c < 4; ++c) EXPECT_LE(shares[at(s)].omega_squared[c], of_element.omega_squared[c]);
      EXPECT_LE(of_element.largest(), bounds.of_group(0));
      largest = std::max(largest, shares[at(s)].largest());
      bound = std::max(bound, of_element.largest());
    }
    EXPECT_GT(largest, 0.5 * bound);
  }
}

TEST(ContactStep, OfPatchesAroundAnElementIsNoMoreThanThatOfAll) {
  const Scene scene = with_all_contributions(uneven_boxes());
  const ContactElements elements = scene.elements();
  const std::vector<ContactShare> shares = scene.shares(0.3);
  const NodalState& state = scene.model.state;
  int equal = 0, met = 0;
  for (Index s = 0; s < scene.model.local.num_slots; s += 7) {
    if (scene.faces.open[at(s)] == 0) continue;
    const auto around = patches_around(scene.step_model(), elements, state.position, state.velocity, 1.0, s);
    ContactShares of_few(scene.step_model(), elements, around, 0.3);
    const ContactShare few = of_few.of(s);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_LE(few.omega_squared[c], shares[at(s)].omega_squared[c]);
    equal += few.largest() == shares[at(s)].largest() ? 1 : 0;
    met += shares[at(s)].largest() > 0 ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(equal, met / 10);  // the edge of the region cuts patches apart
}

}  // namespace
}  // namespace breccia::contact_step_test
