#include "contact/displacement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// It is time to act when this share of the allowance has really been used up; else the bound is brought down.
constexpr double kUsedUp = 0.75;

/// Largest of what has been added: the displacement's components, their negatives, its square.
class Largest {
 public:
  Largest() { values_.fill(-std::numeric_limits<double>::infinity()); }
  void add(const std::array<double, 3>& u) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      raise(values_[i], u[i]);
      raise(values_[3 + i], -u[i]);
      square += u[i] * u[i];
    }
    raise(values_[6], square);
  }
  [[nodiscard]] std::span<double> values() { return values_; }
  [[nodiscard]] double displacement() const {
    double diagonal = 0;
    for (std::size_t i = 0; i < 3; ++i) diagonal += (values_[i] + values_[3 + i]) * (values_[i] + values_[3 + i]);
    return std::min(std::sqrt(values_[6]), 0.5 * std::sqrt(diagonal));
  }

 private:
  static void raise(double& largest, double value) { largest = value > largest ? value : largest; }

  std::array<double, 7> values_;
};

}  // namespace

double relative_displacement(const LocalMesh& local, const Field<double>& now, const Field<double>& then,
                             const Communicator& communicator) {
  Largest largest;
  for (std::size_t block = 0; block < then.size(); block += std::size_t{3} * kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (local.counted[block / 3 + lane] == 0) continue;
      std::array<double, 3> u;
      for (std::size_t i = 0; i < 3; ++i) u[i] = now[block + i * kLanes + lane] - then[block + i * kLanes + lane];
      largest.add(u);
    }
  }
  communicator.max(largest.values());
  return largest.displacement();
}

bool DisplacementWatch::used_up(double allowed, double ahead, const LocalMesh& local, const Field<double>& now,
                                const Field<double>& then, const Communicator& communicator) {
  const double unknown = 2 * length_ * (late_ - before_);
  if (bound_ + unknown + ahead <= allowed) return false;
  start_from(relative_displacement(local, now, then, communicator));
  return !(bound_ + ahead <= kUsedUp * allowed);
}

}  // namespace breccia
