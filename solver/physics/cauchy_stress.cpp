#include "physics/cauchy_stress.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace breccia {
namespace {

elasticity::Corners<double> corners_of(const LocalMesh& mesh, Index slot, const double* field) {
  elasticity::Corners<double> corners;
  for (int c = 0; c < 4; ++c) {
    const Vec3 value = load_node(field, mesh.corner_node(slot, c));
    corners[static_cast<std::size_t>(c)] = {value[0], value[1], value[2]};
  }
  return corners;
}

}  // namespace

Mat3 cauchy_stress(const LocalMesh& mesh, const ElasticParams& params, Index slot, const double* position,
                   const double* velocity, const MaterialMemory& memory) {
  namespace el = elasticity;
  el::Tensor<double> inverse;
  const auto s = static_cast<std::size_t>(slot);
  for (std::size_t i = 0; i < 9; ++i) inverse[i] = mesh.gradient[s / kLanes * 72 + i * kLanes + s % kLanes];
  const el::Tensor<double> f = el::deformation<double>(corners_of(mesh, slot, position), inverse);
  const el::Tensor<double> cof = el::cofactor(f);
  const double j = el::determinant(f, cof);
  el::Tensor<double> piola =
      has_memory(params.law) ? bulk_piola(params, f, memory.of(slot)) : el::elastic_piola(f, params);
  if (params.viscosity > 0 && velocity != nullptr) {
    const el::Tensor<double> rate = el::deformation<double>(corners_of(mesh, slot, velocity), inverse);
    const el::Tensor<double> viscous = el::viscous_piola(rate, cof, j, params);
    for (std::size_t i = 0; i < 9; ++i) piola[i] += viscous[i];
  }
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Mat3 product = Eigen::Map<const RowMajor>(piola.data()) * Eigen::Map<const RowMajor>(f.data()).transpose();
  return (product + product.transpose()) / (2.0 * el::clamped(j, params));
}

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

Vec3 principal_stresses(const Mat3& stress) {
  const double scale = stress.cwiseAbs().maxCoeff();
  if (scale == 0.0) return Vec3::Zero();
  const double mean = stress.trace() / 3.0 / scale;
  const Mat3 s = stress / scale - mean * Mat3::Identity();
  const double j2 = 0.5 * s.squaredNorm();
  if (j2 < 1e-300) return Vec3::Constant(scale * mean);

  // Lode angle in 0..pi/6 from the axis of the eigenvalue that stands apart: its cosine is insensitive there.
  const double j3 = s.determinant();
  const double cosine = 0.5 * std::abs(j3) * std::pow(3.0 / j2, 1.5);
  const double apart = std::copysign(2.0 * std::sqrt(j2 / 3.0) * std::cos(std::acos(std::min(cosine, 1.0)) / 3.0), j3);

  // The columns of s - apart I span the plane orthogonal to its direction.
  Mat3 plane = s - apart * Mat3::Identity();
  Eigen::Index first = 0;
  plane.colwise().squaredNorm().maxCoeff(&first);
  const Vec3 a = plane.col(first).normalized();
  plane -= a * (a.transpose() * plane);
  Eigen::Index second = 0;
  plane.colwise().squaredNorm().maxCoeff(&second);
  const Vec3 b = plane.col(second).normalized();
  const double aa = a.dot(s * a), bb = b.dot(s * b), ab = a.dot(s * b);
  const double half = 0.5 * (aa + bb), radius = std::hypot(0.5 * (aa - bb), ab);

  Vec3 principal = scale * (Vec3(apart, half + radius, half - radius) + Vec3::Constant(mean));
  std::sort(principal.data(), principal.data() + 3, [](double x, double y) { return x > y; });
  return principal;
}

}  // namespace breccia
