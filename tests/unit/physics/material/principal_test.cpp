#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/material/principal.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::material::principal_test {
namespace {

constexpr double kRounding = 2e-15;  // of the largest entry

Mat3 full(const Symmetric& t) {
  Mat3 m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}

/// Axes are orthonormal and sum value axis axis^T is the tensor.
void expect_decomposition(const Symmetric& t) {
  const Principal p = principal_of(t);
  Mat3 sum = Mat3::Zero(), axes;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 n(p.axis[i][0], p.axis[i][1], p.axis[i][2]);
    axes.row(static_cast<Eigen::Index>(i)) = n;
    sum += p.value[i] * n * n.transpose();
  }
  const double largest = full(t).cwiseAbs().maxCoeff();
  EXPECT_LE((sum - full(t)).cwiseAbs().maxCoeff(), kRounding * largest) << full(t);
  EXPECT_LT((axes * axes.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff(), kRounding) << full(t);
}

TEST(Principal, ValuesAndAxesMakeTheTensorAgain) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10.0, i % 20 - 10);
    const Mat3 m = test::random_matrix(random, size);
    expect_decomposition({m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)});
  }
}

TEST(Principal, ValuesThatNearlyOrQuiteCoincideAreToldToRoundOff) {
  for (const double gap : {0.0, 1e-16, 1e-12, 1e-8, 1e-4}) {
    expect_decomposition({1, 1 + gap, 1, gap, gap, 0.5 * gap});
    expect_decomposition({1, 1, 2, gap, 0, gap});
    expect_decomposition({0, 0, 0, gap, gap, gap});
  }
}

TEST(Principal, ValuesOfADiagonalTensorAreItsEntries) {
  const Principal p = principal_of({0.1, -3.7, 2.2, 0, 0, 0});
  EXPECT_EQ(p.value, (std::array<double, 3>{0.1, -3.7, 2.2}));
  EXPECT_EQ(principal_of({}).value, (std::array<double, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace breccia::material::principal_test
