#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "domains/domain.hpp"
#include "model/gauge_points.hpp"

namespace breccia {

/// The [[gauge]] entries of a case on a rank's part of the model. A point stays with the element that holds it at rest,
/// at the same barycentric coordinates; the rank of that element reads it.
class PointGauges {
 public:
  /// @pre input outlives this object
  explicit PointGauges(const case_::Case& input) : input_(input), points_(gauge_points(input)) {}

  /// Finds elements and groups on the model as it is divided now. Collective.
  /// Throws InputError on all ranks where a point is outside of the model.
  void find(const Domain& domain);

  /// The numbers of all columns in their order (case/history_columns.hpp), in the last step, which was sampled:
  ///   displacement u = sum_c w_c (x_n - X)_c, velocity likewise of v_(n+1/2), Cauchy stress of the element at t_n,
  ///   elongation |D + u_b - u_a| - |D| with D = X_b - X_a, strain = elongation / |D|,
  ///   broken joints: those that have failed and have a corner on the group.
  /// The same bits on all ranks and for any number of them. Collective. O(points + failed joints), one reduction.
  [[nodiscard]] std::vector<double> read(const Domain& domain) const;

 private:
  static constexpr std::size_t kNumbers = 12;  ///< of a point: displacement, velocity, stress
  struct Place {
    std::size_t point;
    Index slot;
    std::array<double, 4> weights;
  };
  /// Corners of elements that belong to a group.
  struct Marked {
    std::size_t gauge;
    std::vector<std::uint8_t> corners;  ///< (mesh elements) a bit a corner
  };

  void refuse_points_outside(const Domain& domain, const std::vector<double>& held) const;
  [[nodiscard]] std::array<double, kNumbers> numbers_at(const Domain& domain, const Place& place) const;
  [[nodiscard]] std::array<double, 2> elongation(std::size_t first, const std::vector<double>& numbers) const;

  const case_::Case& input_;
  std::vector<GaugePoint> points_;
  std::vector<Place> places_;  ///< of this rank
  std::vector<Marked> marked_;
};

}  // namespace breccia
