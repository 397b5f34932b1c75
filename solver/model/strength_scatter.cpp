#include "model/strength_scatter.hpp"

#include <cmath>
#include <cstdint>

#include "mesh/random_rotation.hpp"

namespace breccia {
namespace {

constexpr double kClassRatio = 1.02;

/// Stream of random bits kept apart from those of meshes and velocities of the same seed.
constexpr std::uint64_t kStrengthStream = 0x5ca77e25d1571a7eULL;

/// In (0, 1).
double uniform(std::uint64_t seed, GlobalId id) {
  const std::uint64_t bits = random_bits(seed, static_cast<std::uint64_t>(id) ^ kStrengthStream, 0);
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

}  // namespace

Index strength_class(const case_::Joint& joint, GlobalId id, double area) {
  const double m = joint.weibull_modulus;
  double log_factor = std::log(-std::log(uniform(joint.weibull_seed, id))) / m - std::lgamma(1 + 1 / m);
  if (joint.weibull_area > 0) log_factor += std::log(joint.weibull_area / area) / m;
  return static_cast<Index>(std::lround(log_factor / std::log(kClassRatio)));
}

double strength_factor(Index number) {
  // By products, which round alike everywhere; pow does not.
  const double ratio = number < 0 ? 1 / kClassRatio : kClassRatio;
  double factor = 1;
  for (Index i = std::abs(number); i > 0; --i) factor *= ratio;
  return factor;
}

}  // namespace breccia
