#include "observe/point_gauges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "case/history_columns.hpp"
#include "contact/search_params.hpp"
#include "model/parameters.hpp"
#include "simulation/step.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::point_gauges_test {
namespace {

constexpr double kStep = 1e-8;  // s
constexpr double kYoung = 1e9, kPoisson = 0.2;

/// A cube of 20 mm, two cells an edge, whose joints do not break unless a test breaks them.
class PointGaugesTest : public testing::Test {
 protected:
  void start(const std::string& gauges, const std::string& stage = "") {
    input_ = case_::read_text(test::raster_case({.group = "box",
                                                 .cells = {2, 2, 2},
                                                 .young = kYoung,
                                                 .poisson = kPoisson,
                                                 .tensile_strength = 1e9,
                                                 .energy_mode_1 = 1e6,
                                                 .sections = gauges}) +
                              stage);
    model_ = build_model(input_);
    domain_ = std::make_unique<Domain>(model_, search_params(input_, model_));
    begin_stage(*domain_, stage_loads(input_.stages[0], model_), kStep);
  }
  /// Columns by name, in a step with a sample.
  double operator()(const std::string& name) {
    const std::vector<case_::HistoryColumn> all = case_::history_columns({}, input_.gauges);
    const std::size_t first = case_::history_columns({}, {}).size();
    EXPECT_EQ(row_.size() + first, all.size());
    for (std::size_t i = 0; i < row_.size(); ++i)
      if (all[first + i].word() == name) return row_[i];
    ADD_FAILURE() << name;
    return 0;
  }
  void read() {
    step(*domain_, {.sample = true});
    PointGauges gauges(input_);
    gauges.find(*domain_);
    row_ = gauges.read(*domain_);
  }
  /// Positions x + gradient x at once, before the next step.
  void deform(const Mat3& gradient) {
    for (Index n = 0; n < model_.local.num_nodes; ++n) {
      const Vec3 x = load_node(model_.local.reference.data(), n);
      store_node(domain_->state.nodes.position.data(), n, Vec3(x + gradient * x));
    }
  }

  case_::Case input_;
  Model model_;
  std::unique_ptr<Domain> domain_;
  std::vector<double> row_;
};

const std::string kPoint = "[[gauge]]\nname = \"p\"\nkind = \"point\"\nat = [\"7 mm\", \"11 mm\", \"3 mm\"]\n";
const std::string kLong =
    "[[gauge]]\nname = \"l\"\nkind = \"extensometer\"\nfrom = [\"1 mm\", \"1 mm\", 0]\nto = [\"4 mm\", \"5 mm\", 0]\n";

TEST_F(PointGaugesTest, InterpolateTheMotionOfTheElement) {
  start(kPoint);
  Mat3 gradient;
  gradient << 1e-6, 2e-6, 0, 0, -1e-6, 3e-6, 1e-6, 0, 0;
  deform(gradient);
  read();
  const Vec3 moved = gradient * Vec3(7e-3, 11e-3, 3e-3);
  EXPECT_NEAR((*this)("p.displacement_x"), moved[0], 1e-17);
  EXPECT_NEAR((*this)("p.displacement_y"), moved[1], 1e-17);
  EXPECT_NEAR((*this)("p.displacement_z"), moved[2], 1e-17);
}

TEST_F(PointGaugesTest, ReadTheVelocityAfterTheStep) {
  start(kPoint);
  for (Index n = 0; n < model_.local.num_nodes; ++n)
    store_node(domain_->state.nodes.velocity.data(), n, Vec3(0, 0, load_node(model_.local.reference.data(), n)[0]));
  read();
  EXPECT_NEAR((*this)("p.velocity_z"), 7e-3, 1e-7);
  EXPECT_NEAR((*this)("p.displacement_z"), 0, 1e-20) << "that of t_n";
}

TEST_F(PointGaugesTest, ReadTheStressOfTheElementByHookesLaw) {
  start(kPoint);
  constexpr double kStrain = 1e-6;
  Mat3 gradient = Mat3::Zero();
  gradient(0, 0) = kStrain;
  deform(gradient);
  read();
  const double lambda = kYoung * kPoisson / ((1 + kPoisson) * (1 - 2 * kPoisson)), mu = kYoung / (2 * (1 + kPoisson));
  EXPECT_NEAR((*this)("p.stress_xx"), (lambda + 2 * mu) * kStrain, 1e-5 * kYoung * kStrain);
  EXPECT_NEAR((*this)("p.stress_yy"), lambda * kStrain, 1e-5 * kYoung * kStrain);
  EXPECT_NEAR((*this)("p.stress_xy"), 0, 1e-5 * kYoung * kStrain);
}

TEST_F(PointGaugesTest, AnExtensometerReadsTheChangeOfTheDistance) {
  start(kLong);
  Mat3 gradient = Mat3::Zero();
  gradient(0, 0) = 1e-3;
  deform(gradient);
  read();
  const double length = 5e-3, now = std::hypot(3e-3 * 1.001, 4e-3);
  EXPECT_NEAR((*this)("l.elongation"), now - length, 1e-16);
  EXPECT_NEAR((*this)("l.strain"), (now - length) / length, 1e-13);
}

TEST_F(PointGaugesTest, AnExtensometerDoesNotSeeARotation) {
  start(kLong);
  const double angle = 0.3;
  Mat3 turn = Mat3::Zero();
  turn << std::cos(angle) - 1, -std::sin(angle), 0, std::sin(angle), std::cos(angle) - 1, 0, 0, 0, 0;
  deform(turn);
  read();
  EXPECT_NEAR((*this)("l.elongation"), 0, 1e-17);
}

TEST_F(PointGaugesTest, ALineReadsItsPointsInOrder) {
  start(
      "[[gauge]]\nname = \"s\"\nkind = \"line\"\nfrom = [0, \"5 mm\", \"5 mm\"]\nto = [\"20 mm\", \"5 mm\", \"5 "
      "mm\"]\npoints = 5\n" +
      kPoint);
  Mat3 gradient = Mat3::Zero();
  gradient(0, 0) = 1e-6;
  deform(gradient);
  read();
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR((*this)("s_" + std::to_string(i + 1) + ".displacement_x"), i * 5e-9, 1e-17) << i;
  EXPECT_NEAR((*this)("p.displacement_x"), 7e-9, 1e-17);
}

}  // namespace
}  // namespace breccia::point_gauges_test
