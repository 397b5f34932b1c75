#include "physics/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "unit/physics/loads/models.hpp"

namespace breccia::sweep_test {
namespace {
using test::Model;

constexpr double kYoung = 1e6, kPoisson = 0.25, kDensity = 1000, kStep = 1e-3;  // Pa, -, kg/m3, s

/// A model with room for everything that a sweep writes.
struct Swept {
  Model model;
  std::vector<ElasticParams> params;
  NodalForces forces;
  std::vector<std::int32_t> corners;
  std::vector<Index> shared_blocks;
  Field<double> viscous, stress, damping_before, damping_after, kept;

  Swept(Mesh mesh, Discretisation kind, const ElasticParams& p)
      : model(std::move(mesh), kind, kDensity),
        params{p},
        forces(model.local.num_own_blocks(), model.local.num_nodes),
        viscous(at(model.local.num_slots), 0.0),
        stress(viscous),
        damping_before(at(model.local.num_nodes), 0.0),
        damping_after(damping_before),
        kept(at(model.local.num_blocks()) * 144, 0.0) {
    const LocalMesh& local = model.local;
    for (Index b = local.num_own_blocks(); b < local.num_blocks(); ++b) {
      shared_blocks.push_back(b);
      for (int c = 0; c < 4; ++c) {
        for (Index lane = 0; lane < kLanes; ++lane) corners.push_back(local.corner_node(b * kLanes + lane, c));
      }
    }
  }

  [[nodiscard]] SweepArgs args() {
    const LocalMesh& local = model.local;
    SweepArgs a;
    a.end_own_block = a.num_own_blocks = local.num_own_blocks();
    a.shared_blocks = shared_blocks.data();
    a.num_shared_blocks = static_cast<Index>(shared_blocks.size());
    a.num_moved_nodes = local.num_moved_nodes;
    a.position = model.state.position.data();
    a.next_position = model.state.next_position.data();
    a.velocity = model.state.velocity.data();
    a.gradient = local.gradient.data();
    a.volume = local.volume.data();
    a.node_mass = local.node_mass.data();
    a.shared_corners = corners.data();
    a.link = model.links.link.data();
    a.place = model.links.place.data();
    a.stiffness = model.links.stiffness.data();
    a.limit = model.links.limit.data();
    a.force_slot = forces.slots();
    a.own_force = forces.own();
    a.shared_force = forces.shared();
    a.block_group = local.block_group.data();
    a.original = local.original.data();
    a.params = params.data();
    a.dt = a.kick = kStep;
    a.gravity = {0.5, -2, 3};
    a.viscous_before = a.viscous_after = viscous.data();
    a.stress_before = a.stress_after = stress.data();
    a.kept_stress = kept.data();
    a.damping_before = damping_before.data();
    a.damping_after = damping_after.data();
    return a;
  }
};

std::vector<Simd> available() {
  std::vector<Simd> sets;
  for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512}) {
    if (simd_available(simd)) sets.push_back(simd);
  }
  return sets;
}

ElasticParams law(BulkLaw which, double viscosity) { return make_elastic_params(which, kYoung, kPoisson, viscosity); }

/// Deformed and moving at random, elastic joints between elements that own their nodes.
Swept deformed(Discretisation kind, const ElasticParams& params) {
  Swept swept(test::jittered(test::box({2, 1, 1}), 0.03, 5), kind, params);
  if (kind == Discretisation::own_nodes) swept.model.join(2e6);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> move(-0.01, 0.01), speed(-3, 3), force(-50, 50);
  for (const Index n : swept.model.real_nodes()) {
    const Vec3 x = load_node(swept.model.state.position.data(), n);
    store_node(swept.model.state.position.data(), n, x + Vec3(move(random), move(random), move(random)));
    store_node(swept.model.state.velocity.data(), n, Vec3(speed(random), speed(random), speed(random)));
    swept.forces.add(n, Vec3(force(random), force(random), force(random)));
  }
  return swept;
}

/// Force on every node before gravity and damping, element by element, face by face.
Field<double> forces_of(Swept& swept) {
  const Model& model = swept.model;
  Field<double> force = test::internal_forces(model, swept.params[0], model.state.position, model.state.velocity);
  for (Index s = 0; s < model.local.num_own_slots; ++s) {
    for (int f = 0; f < 4; ++f) {
      const std::int32_t link = model.links.link[JointLinks::at(s, f)];
      if (JointLinks::code_of(link) >= 12) continue;
      for (int i = 0; i < 3; ++i) {
        const Index own = own_corner_node(s, kFaceCorners[at(f)][at(i)]);
        const Index other = own_corner_node(JointLinks::slot_of(link), matching_corner(JointLinks::code_of(link), i));
        const Vec3 pull = load_node(model.state.position.data(), other) - load_node(model.state.position.data(), own);
        store_node(force.data(), own,
                   load_node(force.data(), own) + model.links.stiffness[JointLinks::at(s, f)] * pull);
      }
    }
  }
  for (const Index n : model.real_nodes())
    store_node(force.data(), n, load_node(force.data(), n) + swept.forces.get(n));
  return force;
}

struct Kind {
  Discretisation discretisation;
  BulkLaw law;
  double viscosity, mass_damping, local_damping;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << (kind.discretisation == Discretisation::own_nodes ? "own nodes" : "shared nodes")
       << (kind.law == BulkLaw::neo_hookean ? ", neo-Hooke" : ", Green-St-Venant") << ", viscosity " << kind.viscosity
       << ", mass damping " << kind.mass_damping << ", local damping " << kind.local_damping;
}

class Sweep : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Sweep,
                         testing::Values(Kind{Discretisation::own_nodes, BulkLaw::neo_hookean, 0, 0, 0},
                                         Kind{Discretisation::own_nodes, BulkLaw::neo_hookean, 40, 200, 0},
                                         Kind{Discretisation::own_nodes, BulkLaw::green_st_venant, 40, 0, 0.3},
                                         Kind{Discretisation::shared_nodes, BulkLaw::neo_hookean, 0, 0, 0},
                                         Kind{Discretisation::shared_nodes, BulkLaw::neo_hookean, 40, 200, 0.3},
                                         Kind{Discretisation::shared_nodes, BulkLaw::green_st_venant, 0, 0, 0}));

/// v(n+1/2) of a component by the formulas of the header, and the damping force, N.
struct Moved {
  double velocity, damping;
};
Moved moved(const SweepArgs& a, double v, double force, double mass, double gravity) {
  const double unbalanced = force + mass * gravity;
  const double local = -a.local_damping * std::abs(unbalanced) * (v > 0 ? 1 : v < 0 ? -1 : 0);
  // m (v' - v) / dt = unbalanced + local - alpha m (v + v') / 2
  const double half = 0.5 * a.mass_damping * a.dt;
  const double next = ((1 - half) * v + a.dt / mass * (unbalanced + local)) / (1 + half);
  return {next, local - 0.5 * a.mass_damping * mass * (v + next)};
}

TEST_P(Sweep, MovesEveryNodeByItsForcesAndAccountsWhatDampingTakes) {
  constexpr double kRounding = 1e-11;
  for (const Simd simd : available()) {
    Swept swept = deformed(GetParam().discretisation, law(GetParam().law, GetParam().viscosity));
    const Field<double> force = forces_of(swept);
    const NodalState before = swept.model.state;
    SweepArgs args = swept.args();
    args.mass_damping = GetParam().mass_damping;
    args.local_damping = GetParam().local_damping;
    const SweepStatus status = sweep_for(simd)(args);
    EXPECT_EQ(status.first_not_finite, -1);
    EXPECT_EQ(status.crushed, 0);
    double fastest = 0;
    for (const Index n : swept.model.real_nodes()) {
      const double mass = swept.model.local.node_mass[at(n)];
      double work_before = 0, work_after = 0;
      for (int i = 0; i < 3; ++i) {
        const std::size_t k = nodal(n, i);
        const Moved expected = moved(args, before.velocity[k], force[k], mass, args.gravity[at(i)]);
        EXPECT_NEAR(swept.model.state.velocity[k], expected.velocity, kRounding * (1 + std::abs(expected.velocity)));
        EXPECT_NEAR(swept.model.state.next_position[k], before.position[k] + kStep * expected.velocity, kRounding);
        work_before -= 0.5 * kStep * expected.damping * before.velocity[k];
        work_after -= 0.5 * kStep * expected.damping * expected.velocity;
      }
      EXPECT_NEAR(swept.damping_before[at(n)], work_before, kRounding * (1 + std::abs(work_before)));
      EXPECT_NEAR(swept.damping_after[at(n)], work_after, kRounding * (1 + std::abs(work_after)));
      if (args.mass_damping == 0) {
        EXPECT_GE(work_before, 0.0) << "local damping never drives";
      }
      fastest = std::max(fastest, load_node(swept.model.state.velocity.data(), n).squaredNorm());
    }
    EXPECT_NEAR(status.max_speed_squared, fastest, kRounding * fastest);
  }
}

TEST_P(Sweep, AccountsTheWorkOfViscousStressAndOfElasticStressWithoutAnEnergy) {
  constexpr double kRounding = 1e-11;
  Swept swept = deformed(GetParam().discretisation, law(GetParam().law, GetParam().viscosity));
  const NodalState before = swept.model.state;
  const SweepArgs args = swept.args();
  (void)sweep_for(best_simd())(args);
  rate_work_for(best_simd())(args);
  const ElasticParams elastic = law(GetParam().law, 0);
  ElasticParams viscous = swept.params[0];
  viscous.mu = viscous.lambda = 0;
  double all_viscous = 0, all_stress = 0;
  const std::array<const Field<double>*, 2> velocities{&before.velocity, &swept.model.state.velocity};
  for (const Field<double>* velocity : velocities) {
    const auto power = [&](const ElasticParams& p) {
      const Field<double> force = test::internal_forces(swept.model, p, before.position, before.velocity);
      ExactSum sum;
      for (std::size_t k = 0; k < force.size(); ++k) sum.add(-force[k] * (*velocity)[k]);
      return sum.value();
    };
    if (GetParam().viscosity > 0) all_viscous += 0.5 * kStep * power(viscous);
    if (GetParam().law == BulkLaw::green_st_venant) all_stress += 0.5 * kStep * power(elastic);
  }
  double sum_viscous = 0, sum_stress = 0;
  for (const double w : swept.viscous) sum_viscous += w;
  for (const double w : swept.stress) sum_stress += w;
  EXPECT_NEAR(sum_viscous, all_viscous, kRounding * (1 + std::abs(all_viscous)));
  EXPECT_NEAR(sum_stress, all_stress, kRounding * (1 + std::abs(all_stress)));
}

TEST_P(Sweep, AccountsTheHalfBeforeWithTheLengthOfTheStepBeforeWhereTheStepChanges) {
  const auto swept_after = [&](double step_before) {
    Swept swept = deformed(GetParam().discretisation, law(GetParam().law, GetParam().viscosity));
    SweepArgs args = swept.args();
    args.viscous_after = args.stress_after = nullptr;
    args.kick = 0.5 * (step_before + args.dt);
    args.local_damping = 0.3;  // does not depend on the kick
    (void)sweep_for(best_simd())(args);
    return swept;
  };
  constexpr double kLonger = 3, kRounding = 1e-12;
  const Swept even = swept_after(kStep), uneven = swept_after(kLonger * kStep);
  double sum = 0;
  for (const auto sums : {&Swept::viscous, &Swept::stress, &Swept::damping_before}) {
    for (std::size_t i = 0; i < (even.*sums).size(); ++i) {
      const double expected = kLonger * (even.*sums)[i];
      EXPECT_NEAR((uneven.*sums)[i], expected, kRounding * std::abs(expected));
      sum += std::abs(expected);
    }
  }
  EXPECT_GT(sum, 0.0);
}

TEST_P(Sweep, GivesTheSameBitsForEveryInstructionSet) {
  Field<double> first;
  for (const Simd simd : available()) {
    Swept swept = deformed(GetParam().discretisation, law(GetParam().law, GetParam().viscosity));
    SweepArgs args = swept.args();
    args.mass_damping = GetParam().mass_damping;
    args.local_damping = GetParam().local_damping;
    (void)sweep_for(simd)(args);
    if (first.empty()) first = swept.model.state.velocity;
    EXPECT_EQ(swept.model.state.velocity, first) << name_of(simd);
  }
}

TEST(SweepOfJoints, CallsForTheForcesOfThoseThatHaveOpenedBeyondTheirLimitAlongAnyAxis) {
  struct Crossings {
    int calls = 0;
    static void call(void* context, Index, int, double* force) {
      ++static_cast<Crossings*>(context)->calls;
      std::fill(force, force + 9, 0.0);
    }
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const double opening : {0.9e-3, 1.1e-3}) {
      Swept swept(test::box({1, 1, 1}), Discretisation::own_nodes, law(BulkLaw::neo_hookean, 0));
      swept.model.join(2e6);
      std::fill(swept.model.links.limit.begin(), swept.model.links.limit.end(), 1e-6);  // m2
      for (int c = 0; c < 4; ++c) {  // one element moves away from its three neighbours, which move too
        Vec3 x = load_node(swept.model.state.position.data(), own_corner_node(0, c));
        x[axis] += opening;
        store_node(swept.model.state.position.data(), own_corner_node(0, c), x);
      }
      int joints = 0;
      for (int f = 0; f < 4; ++f) joints += JointLinks::code_of(swept.model.links.link[JointLinks::at(0, f)]) < 12;
      Crossings crossings;
      SweepArgs args = swept.args();
      args.crossing = &Crossings::call;
      args.crossing_context = &crossings;
      (void)sweep_for(best_simd())(args);
      EXPECT_EQ(crossings.calls, opening > 1e-3 ? 2 * joints : 0) << axis;
    }
  }
}

TEST(SweepStatus, NamesTheBlocksOfANumberThatIsNotFiniteAlsoTheLastOnes) {
  for (const Index element : {0, 700, 767}) {
    Swept swept(test::box({4, 4, 2}), Discretisation::own_nodes, law(BulkLaw::neo_hookean, 0));
    ASSERT_EQ(swept.model.local.num_own_slots, 768) << "a block of 512 elements and a rest";
    swept.model.state.velocity[nodal(own_corner_node(element, 2), 1)] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(sweep_for(best_simd())(swept.args()).first_not_finite, element < 512 ? 0 : 64) << element;
  }
}

TEST(SweepStatus, CountsElementsBelowTheSmallestVolumeRatio) {
  for (const double share : {0.11, 0.09}) {
    Swept swept(test::tetrahedron(), Discretisation::own_nodes, law(BulkLaw::neo_hookean, 0));
    swept.model.map_positions([&](const Vec3& x) { return Vec3(x[0], x[1], share * x[2]); });
    EXPECT_EQ(sweep_for(best_simd())(swept.args()).crushed, share < 0.1 ? 1 : 0);
  }
}

}  // namespace
}  // namespace breccia::sweep_test
