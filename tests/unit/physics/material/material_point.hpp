#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "physics/material/drucker_prager.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// A material point that is led along a history of deformation gradients.
struct MaterialPoint {
  ElasticParams params = make_elastic_params(BulkLaw::drucker_prager, 30e9, 0.2, 0);
  material::DruckerPragerMemory memory{};
  Mat3 gradient = Mat3::Identity();
  Mat3 piola = Mat3::Zero();
  double work = 0;  ///< J/m3, of the stress along the history, by the trapezoid

  explicit MaterialPoint(const DruckerPragerParams& p) { params.drucker_prager = p; }

  [[nodiscard]] double bulk() const { return params.lambda + 2.0 / 3.0 * params.mu; }
  [[nodiscard]] Mat3 kirchhoff() const { return piola * gradient.transpose(); }

  void go_to(const Mat3& f) {
    elasticity::Tensor<double> result;
    material::drucker_prager_piola(params, tensor(f).data(), numbers(), result.data());
    work += 0.5 * (piola + matrix(result)).cwiseProduct(f - gradient).sum();
    gradient = f;
    piola = matrix(result);
  }

  /// To principal logarithmic strains along x, y, z, in steps of equal strain.
  void go_to_strains(const Vec3& from, const Vec3& to, int steps, const Mat3& turn = Mat3::Identity()) {
    for (int i = 1; i <= steps; ++i) {
      const Vec3 strain = from + (to - from) * i / steps;
      go_to(turn * strain.array().exp().matrix().asDiagonal());
    }
  }

  [[nodiscard]] double stored() const {
    return material::drucker_prager_energy(params, tensor(gradient).data(), numbers());
  }

  [[nodiscard]] double* numbers() { return memory.inverse_plastic.data(); }
  [[nodiscard]] const double* numbers() const { return memory.inverse_plastic.data(); }
};

inline bool same_plastic_state(const material::DruckerPragerMemory& a, const material::DruckerPragerMemory& b) {
  return a.inverse_plastic == b.inverse_plastic && a.plastic_shear == b.plastic_shear && a.compaction == b.compaction &&
         a.plastic_work == b.plastic_work;
}

inline Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

}  // namespace breccia::test
