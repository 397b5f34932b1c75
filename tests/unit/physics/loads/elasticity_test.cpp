#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <experimental/simd>

#include "unit/physics/loads/models.hpp"

namespace breccia::elasticity_test {
namespace {

namespace el = elasticity;
using test::matrix;
using test::Model;
using test::tensor;

constexpr double kRounding = 1e-12;  // of Young's modulus
constexpr double kYoung = 3.0, kPoisson = 0.3;

ElasticParams params_of(BulkLaw law, double viscosity = 0) {
  return make_elastic_params(law, kYoung, kPoisson, viscosity);
}

Mat3 random_rotation_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

/// A gradient with the wanted volume ratio.
Mat3 gradient_of_volume(std::mt19937& random, double j) {
  Mat3 f = random_rotation_matrix(random) * (Mat3::Identity() + test::random_matrix(random, 0.3));
  f.col(1) *= j / f.determinant();
  return f;
}

class EveryLaw : public testing::TestWithParam<BulkLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::Values(BulkLaw::neo_hookean, BulkLaw::green_st_venant),
                         [](const auto& law) {
                           return law.param == BulkLaw::neo_hookean ? "neo_hookean" : "green_st_venant";
                         });

TEST_P(EveryLaw, HasNoStressUnderARigidRotation) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const auto piola = el::elastic_piola(tensor(random_rotation_matrix(random)), params_of(GetParam()));
    EXPECT_LT(matrix(piola).norm(), kYoung * kRounding);
  }
}

TEST_P(EveryLaw, HasHookesLawAsItsSmallStrainLimit) {
  std::mt19937 random(2);
  const double mu = kYoung / 2.6, lambda = kYoung * 0.3 / (1.3 * 0.4);
  for (const double size : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Mat3 h = test::random_matrix(random, size);
    const Mat3 e = 0.5 * (h + h.transpose());
    const Mat3 hooke = lambda * e.trace() * Mat3::Identity() + 2 * mu * e;
    const Mat3 piola = matrix(el::elastic_piola(tensor(Mat3::Identity() + h), params_of(GetParam())));
    EXPECT_LT((piola - hooke).norm(), 12 * size * hooke.norm()) << size;  // second order in the strain, factor a few
  }
}

TEST_P(EveryLaw, TurnsItsStressWithTheElement) {
  std::mt19937 random(3);
  for (const double j : {2.0, 1.0, 0.3, 0.05, -0.2}) {
    const Mat3 f = gradient_of_volume(random, j), q = random_rotation_matrix(random);
    const Mat3 piola = matrix(el::elastic_piola(tensor(f), params_of(GetParam())));
    const Mat3 turned = matrix(el::elastic_piola(tensor(q * f), params_of(GetParam())));
    EXPECT_LT((turned - q * piola).norm(), 100 * kRounding * (kYoung + piola.norm())) << j;
  }
}

TEST_P(EveryLaw, IsContinuousWhereTheContinuationBegins) {
  std::mt19937 random(4);
  const ElasticParams p = params_of(GetParam());
  constexpr double kGap = 1e-9;
  const Mat3 f = gradient_of_volume(random, p.j_min);
  const Mat3 above = matrix(el::elastic_piola(tensor(f * std::cbrt(1 + kGap)), p));
  const Mat3 below = matrix(el::elastic_piola(tensor(f * std::cbrt(1 - kGap)), p));
  EXPECT_LT((above - below).norm(), 100 * kGap * above.norm());
}

TEST_P(EveryLaw, StaysFiniteWhateverTheElementBecomes) {
  for (const Mat3& f : {Mat3(Mat3::Zero()), Mat3(-Mat3::Identity()), Mat3(Vec3(0, 1, 1).asDiagonal()),
                        Mat3(Vec3(1e-8, -3, 2).asDiagonal())}) {
    EXPECT_TRUE(matrix(el::elastic_piola(tensor(f), params_of(GetParam()))).allFinite()) << f;
  }
}

TEST_P(EveryLaw, PushesACollapsedElementBackOpen) {
  for (double s = 0.5; s > -2.0; s -= 0.01) {  // uniaxial compression through flat to inside out
    const auto piola = el::elastic_piola(tensor(Vec3(s, 1, 1).asDiagonal()), params_of(GetParam()));
    ASSERT_LT(piola[0], 0.0) << s;
  }
}

TEST_P(EveryLaw, PassesThePatchTest) {
  // A uniform gradient on a distorted mesh: inner nodes are in balance and the boundary carries P N.
  Model model(test::jittered(test::box({2, 2, 2}), 0.08, 7), Discretisation::shared_nodes, 1000);
  Mat3 f;
  f << 1.02, 0.03, -0.01, 0.0, 0.97, 0.04, 0.02, -0.03, 1.01;
  model.map_positions([&](const Vec3& x) { return Vec3(f * x + Vec3(1, 2, 3)); });
  const auto force = test::internal_forces(model, params_of(GetParam()), model.state.position, model.state.velocity);
  const Mat3 piola = matrix(el::elastic_piola(tensor(f), params_of(GetParam())));
  Field<double> expected(force.size(), 0.0);
  for (const LoadedFace& face : model.free_faces()) {
    std::array<Index, 3> n{};
    for (int i = 0; i < 3; ++i) n[at(i)] = model.local.corner_node(face.slot, kFaceCorners[at(face.face)][at(i)]);
    const auto x = [&](int i) { return load_node(model.local.reference.data(), n[at(i)]); };
    const Vec3 area = 0.5 * (x(1) - x(0)).cross(x(2) - x(0));
    for (const Index node : n) store_node(expected.data(), node, load_node(expected.data(), node) - piola * area / 3.0);
  }
  double largest = 0;
  for (const Index n : model.real_nodes()) {
    largest = std::max(largest, (load_node(force.data(), n) - load_node(expected.data(), n)).norm());
  }
  EXPECT_LT(largest, kYoung * kRounding);
}

TEST_P(EveryLaw, GivesForcesWithoutResultantAndWithoutMoment) {
  std::mt19937 random(8);
  Model model(test::tetrahedron(), Discretisation::own_nodes, 1000);
  for (int i = 0; i < 50; ++i) {
    const Mat3 f = gradient_of_volume(random, 0.8), rate = test::random_matrix(random, 1.0);
    model.map_positions([&](const Vec3& x) { return Vec3(f * x); });
    for (const Index n : model.real_nodes()) {
      store_node(model.state.velocity.data(), n, rate * load_node(model.local.reference.data(), n));
    }
    const auto force =
        test::internal_forces(model, params_of(GetParam(), 0.1), model.state.position, model.state.velocity);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (const Index n : model.real_nodes()) {
      sum += load_node(force.data(), n);
      moment += load_node(model.state.position.data(), n).cross(load_node(force.data(), n));
    }
    EXPECT_LT(sum.norm(), 10 * kYoung * kRounding);
    EXPECT_LT(moment.norm(), 10 * kYoung * kRounding);
  }
}

TEST_P(EveryLaw, GivesTheSameBitsInEightLanesAsInOne) {
  using Eight = std::experimental::fixed_size_simd<double, 8>;
  std::mt19937 random(9);
  const ElasticParams p = params_of(GetParam(), 0.2);
  std::array<el::Corners<double>, 8> x{}, v{};
  std::array<el::Tensor<double>, 8> inverse{};
  el::Corners<Eight> wide_x, wide_v;
  el::Tensor<Eight> wide_inverse;
  std::uniform_real_distribution<double> any(-1, 1);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    inverse[lane] = tensor(test::random_matrix(random, 1.0));
    for (std::size_t i = 0; i < 9; ++i) wide_inverse[i][lane] = inverse[lane][i];
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i) {
        wide_x[c][i][lane] = x[lane][c][i] = any(random);
        wide_v[c][i][lane] = v[lane][c][i] = any(random);
      }
    }
  }
  const auto wide = el::element_forces(wide_x, wide_v, wide_inverse, Eight(0.7), p);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto one = el::element_forces(x[lane], v[lane], inverse[lane], 0.7, p);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(double(wide[c][i][lane]), one[c][i]);
    }
  }
}

TEST(NeoHookean, IsTheDerivativeOfItsEnergyAlsoCrushedAndInsideOut) {
  constexpr double kDifference = 1e-5, kTolerance = 1e-7;  // central differences: h^2 times third derivatives, relative
  std::mt19937 random(10);
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  for (const double j : {1.5, 1.0, 0.5, 0.11, 0.1, 0.09, 0.03, 0.0, -0.1, -0.3, -0.5}) {
    const auto f = tensor(gradient_of_volume(random, j));
    const auto piola = el::elastic_piola(f, p);
    for (std::size_t i = 0; i < 9; ++i) {
      auto more = f, less = f;
      more[i] += kDifference;
      less[i] -= kDifference;
      const double slope = (el::neo_hookean_energy(more, p) - el::neo_hookean_energy(less, p)) / (2 * kDifference);
      // across j_min the third derivative jumps: one power of the difference less
      const double tolerance = std::abs(j - p.j_min) < 1e-3 ? 1e-4 : kTolerance;
      EXPECT_NEAR(piola[i], slope, tolerance * matrix(piola).norm()) << "J " << j << " component " << i;
    }
  }
}

TEST(NeoHookean, ForcesAreMinusTheGradientOfTheElementsEnergy) {
  std::mt19937 random(11);
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  const Mat3 edges = Mat3::Identity() + test::random_matrix(random, 0.2);  // columns x_c - x_0
  const auto inverse = tensor(edges.inverse());
  const double volume = edges.determinant() / 6.0;
  for (const double j : {1.2, 0.05, -0.4}) {
    const Mat3 current = gradient_of_volume(random, j) * edges;
    el::Corners<double> x{}, at_rest{};
    for (std::size_t c = 1; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i)
        x[c][i] = current(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c - 1));
    }
    const auto force = el::element_forces(x, at_rest, inverse, volume, p);
    double size = 0;
    for (const auto& f : force) size = std::max(size, std::hypot(f[0], f[1], f[2]));
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i) {
        auto more = x, less = x;
        more[c][i] += 1e-5;
        less[c][i] -= 1e-5;
        const double slope =
            (el::element_energy(more, inverse, volume, p) - el::element_energy(less, inverse, volume, p)) / 2e-5;
        EXPECT_NEAR(force[c][i], -slope, 1e-7 * size) << "J " << j;
      }
    }
  }
}

TEST(NeoHookean, StressIsTheClosedFormOfItsCauchyStress) {
  std::mt19937 random(12);
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  for (const double target : {0.2, 0.7, 1.0, 1.9}) {
    const Mat3 f = gradient_of_volume(random, target);
    const double j = f.determinant();
    const Mat3 expected =
        p.mu / j * (f * f.transpose() - Mat3::Identity()) + p.lambda / 2 * (j - 1 / j) * Mat3::Identity();
    const Mat3 cauchy = matrix(el::elastic_piola(tensor(f), p)) * f.transpose() / j;
    EXPECT_LT((cauchy - expected).norm(), kRounding * (expected.norm() + kYoung));
  }
}

TEST(NeoHookean, KeepsTheDigitsOfSmallStrainEnergies) {
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  for (const double e : {1e-4, 1e-6, 1e-8}) {
    const double hooke = 0.5 * (p.lambda + 2 * p.mu) * e * e;
    // F itself carries 1e-16 / e of the strain; the next term of the energy is of the order e
    EXPECT_NEAR(el::neo_hookean_energy(tensor(Vec3(1 + e, 1, 1).asDiagonal()), p) / hooke, 1.0, 2 * e + 4e-16 / e);
  }
}

/// Work of a law along a straight path of gradients, J/m3: Gauss-Legendre, exact to round-off for the smooth part.
double path_work(const Mat3& from, const Mat3& to, const ElasticParams& p, int pieces) {
  constexpr std::array<double, 3> kPoint{-0.7745966692414834, 0.0, 0.7745966692414834},
      kWeight{5. / 18, 8. / 18, 5. / 18};
  double work = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double s = (piece + 0.5 + 0.5 * kPoint[q]) / pieces;
      const Mat3 piola = matrix(el::elastic_piola(tensor(from + s * (to - from)), p));
      work += kWeight[q] / pieces * piola.cwiseProduct(to - from).sum();
    }
  }
  return work;
}

TEST(NeoHookean, CreatesNoEnergyInTwoHundredRandomClosedStrainLoops) {
  constexpr double kQuadrature = 1e-9;  // of the peak energy: what 64 pieces of three points leave at strains of 0.3
  std::mt19937 random(13);
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  for (int loop = 0; loop < 200; ++loop) {
    std::array<Mat3, 4> corner;
    double peak = 0;
    for (Mat3& f : corner) {
      f = Mat3::Identity() + test::random_matrix(random, 0.2);
      peak = std::max(peak, el::neo_hookean_energy(tensor(f), p));
    }
    double work = 0;
    for (std::size_t k = 0; k < 4; ++k) work += path_work(corner[k], corner[(k + 1) % 4], p, 64);
    EXPECT_LT(std::abs(work), kQuadrature * peak) << "loop " << loop;
  }
}

TEST(NeoHookean, CreatesNoEnergyInLoopsThatTurnTheElementInsideOut) {
  constexpr double kQuadrature = 1e-7;  // the second derivative of P jumps at j_min, somewhere inside one of 512 pieces
  std::mt19937 random(14);
  const ElasticParams p = params_of(BulkLaw::neo_hookean);
  for (int loop = 0; loop < 50; ++loop) {
    std::array<Mat3, 3> corner{Mat3::Identity() + test::random_matrix(random, 0.2), gradient_of_volume(random, 0.05),
                               gradient_of_volume(random, -0.3)};
    double peak = 0, work = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      peak = std::max(peak, el::neo_hookean_energy(tensor(corner[k]), p));
      work += path_work(corner[k], corner[(k + 1) % 3], p, 512);
    }
    EXPECT_LT(std::abs(work), kQuadrature * peak) << "loop " << loop;
  }
}

TEST(GreenStVenant, StressIsThePublishedFormula) {
  std::mt19937 random(15);
  const ElasticParams p = params_of(BulkLaw::green_st_venant);
  for (const double target : {0.15, 0.6, 1.0, 1.7}) {
    const Mat3 f = gradient_of_volume(random, target);
    const double j = f.determinant(), root = std::pow(j, 2.0 / 3.0);
    const Mat3 shape = (f * f.transpose() / root - Mat3::Identity()) / 2, size = (root - 1) / 2 * Mat3::Identity();
    const Mat3 expected = (kYoung / (1 + kPoisson) * shape + kYoung / (1 - 2 * kPoisson) * size) / root;
    EXPECT_LT((matrix(el::green_st_venant_stress(tensor(f), j, p)) - expected).norm(),
              kRounding * (expected.norm() + kYoung));
  }
}

TEST(GreenStVenant, PressureHasNoKinkWhereTheContinuationBegins) {
  // Without shape, F = 0, only the isotropic part is left.
  const ElasticParams p = params_of(BulkLaw::green_st_venant);
  const auto isotropic = [&](double j) { return el::green_st_venant_stress(el::Tensor<double>{}, j, p)[0]; };
  constexpr double kStep = 1e-6, kCurvature = 1e-4;  // of J; what the slope itself changes by over a step
  const double here = isotropic(p.j_min);
  const double above = (isotropic(p.j_min + kStep) - here) / kStep, below = (here - isotropic(p.j_min - kStep)) / kStep;
  EXPECT_NEAR(below / above, 1.0, kCurvature);
  EXPECT_LT(isotropic(-1.0), here) << "the pressure goes on growing";
}

TEST(Viscosity, IsThePublishedStressAndFeelsNoSpin) {
  std::mt19937 random(16);
  const ElasticParams p = params_of(BulkLaw::neo_hookean, 0.7);
  const Mat3 f = gradient_of_volume(random, 0.8), rate = test::random_matrix(random, 2.0);
  const auto cof = el::cofactor(tensor(f));
  const double j = f.determinant();
  const Mat3 l = rate * f.inverse(), d = 0.5 * (l + l.transpose());
  const Mat3 cauchy = matrix(el::viscous_piola(tensor(rate), cof, j, p)) * f.transpose() / j;
  EXPECT_LT((cauchy - 2 * 0.7 / j * d).norm(), 100 * kRounding);
  const Mat3 spin = 0.5 * (l - l.transpose());
  EXPECT_LT(matrix(el::viscous_piola(tensor(spin * f), cof, j, p)).norm(), 100 * kRounding);
}

TEST(Viscosity, NeverGivesEnergyNotEvenToAnElementInsideOut) {
  std::mt19937 random(17);
  const ElasticParams p = params_of(BulkLaw::neo_hookean, 0.7);
  for (const double j : {1.5, 0.5, 0.05, 0.0, -0.2, -1.0}) {
    for (int i = 0; i < 50; ++i) {
      const Mat3 f = gradient_of_volume(random, j), rate = test::random_matrix(random, 2.0);
      const Mat3 piola = matrix(el::viscous_piola(tensor(rate), el::cofactor(tensor(f)), f.determinant(), p));
      EXPECT_GE(piola.cwiseProduct(rate).sum(), -kRounding * piola.norm() * rate.norm()) << j;
    }
  }
}

}  // namespace
}  // namespace breccia::elasticity_test
