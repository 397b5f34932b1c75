#include <gtest/gtest.h>

#include <random>

#include "unit/physics/contact/scene.hpp"

namespace breccia::contact_lanes_test {
namespace {

using test::box;
using test::joined;
using test::Scene;

/// How couples are evaluated.
struct Way {
  Simd simd;
  bool side_by_side;
};

ContactLaw law_of(double exponent, double friction, double damping) {
  ContactLaw law;
  law.penalty = 1e9;
  law.plateau = 2e6;
  law.exponent = exponent;
  law.friction = friction;
  law.tangential_ratio = 0.8;
  law.damping = damping;
  law.friction_delay = 1e-4;
  return law;
}

/// All numbers that come of a block which is shaken while it lies on another one: it lifts off, slides, passes from
/// element to element and comes back.
std::vector<double> shake(const ContactLaw& law, Way way) {
  constexpr double kStep = 1e-5;
  Scene scene(joined(box({3, 2, 1}, 0.5), box({2, 2, 1}, 0.4, Vec3(0.2, 0.1, 0.4995))), law, 3);
  for (FieldValues& values : scene.contact.field) values.sides = kFaceSets;  // as debris: no sides are distinguished
  scene.couple_bodies();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  std::vector<double> numbers;
  for (int step = 0; step < 400; ++step) {
    const double turn = 0.05 * step;
    const Vec3 wave(2.0 * std::cos(turn), 3.0 * std::sin(1.3 * turn), 12.0 * std::cos(1.7 * turn));
    for (const Index node : scene.nodes_of(1)) {
      const Vec3 v = wave + 0.5 * Vec3(some(random), some(random), some(random));
      store_node(scene.state.velocity.data(), node, v);
      store_node(scene.state.position.data(), node, load_node(scene.state.position.data(), node) + kStep * v);
    }
    scene.forces = NodalForces(scene.local.num_own_blocks(), scene.local.num_nodes);
    contact_forces(scene.params, scene.local, scene.state, kStep, scene.contact, scene.forces, scene.work, way.simd,
                   way.side_by_side);
    for (Index n = 0; n < scene.local.num_nodes; ++n) {
      for (const double f : scene.forces.get(n)) numbers.push_back(f);
    }
    for (const TouchingCouple& h : scene.contact.touching) {
      numbers.insert(numbers.end(), {static_cast<double>(h.contactor), h.history.d, h.history.d_max, h.history.offset,
                                     h.history.balance, h.history.gained, h.history.gained_before,
                                     h.history.delayed.force, h.history.delayed.age});
      for (const Vec3& v : {h.history.spring, h.history.friction, h.history.force})
        numbers.insert(numbers.end(), v.begin(), v.end());
    }
    for (const ExactSum* sum :
         {&scene.work.stored, &scene.work.friction_stored, &scene.work.dissipated, &scene.work.friction_dissipated})
      numbers.push_back(sum->value());
    numbers.push_back(static_cast<double>(scene.work.touching));
  }
  return numbers;
}

std::vector<ContactLaw> laws() { return {law_of(1, 0.6, 0), law_of(4, 0.6, 0), law_of(2, 0, 0), law_of(2, 0.3, 1e3)}; }

TEST(ContactLanes, CouplesSideBySideGetTheBitsOfCouplesOneByOne) {
  for (const ContactLaw& law : laws()) {
    const std::vector<double> alone = shake(law, {Simd::sse2, false});
    EXPECT_GT(alone.size(), 10'000U);
    for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512}) {
      if (!simd_available(simd)) continue;
      EXPECT_EQ(shake(law, {simd, true}), alone) << name_of(simd);
    }
  }
}

}  // namespace
}  // namespace breccia::contact_lanes_test
