#include <gtest/gtest.h>
#include <cmath>

#include "physics/constraints.hpp"
#include "physics/energy.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::work_test {
namespace {

using test::Model;

/// A body of 24 soft elements, driven at one end, held at the other, under pressure and a gravity that swings: every
/// force is accounted, so the kinetic energy of central differences must change by the sum of the works, whatever the
/// forces are.
class DrivenBody {
 public:
  static constexpr double kStep = 2e-3;

  explicit DrivenBody(Discretisation kind)
      : model_(test::box({1, 1, 1}), kind, 1000),
        pressure_(model_.free_faces(), test::in_time(0, 4e3, 1e3, 2)),
        constraints_(make_constraints(), model_.local, model_.state) {}

  /// One step; returns what kinetic energy and accounted works disagree by, J.
  double step() {
    NodalState& state = model_.state;
    const double time = number_ * kStep, before = number_ == 0 ? 0.0 : kStep;
    const Vec3 g(0, 3 * std::sin(9 * time), number_ < 300 ? -9.81 : -2.0);
    Field<double> force = test::internal_forces(model_, params_, state.position, state.velocity);
    internal_.add_before(power(force, state.velocity), before);
    NodalForces loads(model_.local.num_own_blocks(), model_.local.num_nodes);
    pressure_.apply(model_.local, state, time, before, loads);
    gravity_.advance(model_.local, state, g, before);
    const Field<double> v_before = state.velocity;
    for (const Index n : model_.real_nodes()) {
      const double mass = model_.local.node_mass[at(n)];
      const Vec3 all = load_node(force.data(), n) + loads.get(n) + mass * g;
      const Vec3 v = load_node(state.velocity.data(), n) + kStep / mass * all;
      store_node(state.velocity.data(), n, v);
      store_node(state.next_position.data(), n, load_node(state.position.data(), n) + kStep * v);
    }
    constraints_.apply(state, time, before, kStep);

    const double kinetic = kinetic_energy(model_.local, v_before.data(), state.velocity.data()).value();
    const double works = internal_.sum().value() + pressure_.work().value() +
                         gravity_.work(model_.local, state.position).value() + constraints_.work().value();
    if (number_ == 0) start_ = kinetic - works;
    largest_ = std::max({largest_, std::abs(constraints_.work().value()), std::abs(internal_.sum().value())});
    smallest_work_ =
        std::min({std::abs(pressure_.work().value()), std::abs(gravity_.work(model_.local, state.position).value()),
                  std::abs(constraints_.work().value())});

    internal_.add_after(power(force, state.velocity), kStep);
    pressure_.account_after(model_.local, state, kStep);
    constraints_.account_after(kStep);
    std::swap(state.position, state.next_position);
    ++number_;
    return kinetic - works - start_;
  }

  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double smallest_work() const { return smallest_work_; }

 private:
  [[nodiscard]] std::vector<NodalConstraint> make_constraints() const {
    NodalConstraint held{{}, {true, true, true}, PrescribedMotion::velocity, {}};
    NodalConstraint driven{{}, {true, false, true}, PrescribedMotion::displacement, {}};
    driven.value[0] = test::in_time(0, 0, 0.05, 1.3);
    for (const Index n : model_.real_nodes()) {
      const double z = model_.local.reference[nodal(n, 2)];
      if (z < 1e-9) held.nodes.push_back(n);
      if (z > 1 - 1e-9) driven.nodes.push_back(n);
    }
    return {held, driven};
  }

  [[nodiscard]] double power(const Field<double>& force, const Field<double>& velocity) const {
    ExactSum sum;
    for (const Index n : model_.real_nodes()) sum.add(load_node(force.data(), n).dot(load_node(velocity.data(), n)));
    return sum.value();
  }

  Model model_;
  ElasticParams params_ = make_elastic_params(BulkLaw::neo_hookean, 1e6, 0.25, 50.0);
  SurfaceLoad pressure_;
  GravityWork gravity_;
  Constraints constraints_;
  WorkSum internal_;
  int number_ = 0;
  double start_ = 0, largest_ = 0, smallest_work_ = 0;
};

class Work : public testing::TestWithParam<Discretisation> {};
INSTANTIATE_TEST_SUITE_P(Discretisations, Work,
                         testing::Values(Discretisation::own_nodes, Discretisation::shared_nodes));

TEST_P(Work, OfAllForcesIsTheChangeOfKineticEnergyToRoundOff) {
  constexpr double kRounding = 1e-12;  // of the largest work
  DrivenBody body(GetParam());
  for (int step = 0; step < 1000; ++step) {
    const double error = body.step();
    ASSERT_LT(std::abs(error), kRounding * (body.largest() + 1.0)) << "step " << step;
  }
  EXPECT_GT(body.smallest_work(), 1e-3 * body.largest());  // each work is large enough for an error in it to show
}

}  // namespace
}  // namespace breccia::work_test
