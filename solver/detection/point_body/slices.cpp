#include "detection/point_body/slices.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::detection {

namespace {

/// Narrows [low, high] by coefficient * t <= bound.
void narrow(double coefficient, double bound, double& low, double& high) {
  if (coefficient > 0) {
    high = std::min(high, bound / coefficient);
  } else if (coefficient < 0) {
    low = std::max(low, bound / coefficient);
  } else if (bound < 0) {
    high = low - 1;
  }
}

/// Smallest value of coefficient * t over an interval.
double least(double coefficient, double low, double high) { return std::min(coefficient * low, coefficient * high); }

}  // namespace

Slices::Slices(const Cells& cells, const CoupleTest& test)
    : cells_(cells),
      test_(test),
      box_(cell_box(cells, test)),
      low_(test.low() - test.origin()),
      high_(test.high() - test.origin()) {
  // Round-off of the bounds is some eps times the box, that of cell borders some eps times the coordinates.
  const double coordinate = std::max(test.low().cwiseAbs().maxCoeff(), test.high().cwiseAbs().maxCoeff());
  slack_ = 1e-12 * (high_ - low_).norm() + 1e-14 * coordinate;
  if (test.has_planes() && std::isfinite(slack_)) {
    add_planes();
    add_shadow();
  }
}

void Slices::add_planes() {
  for (const CoupleTest::Plane& plane : test_.planes()) {
    const auto& n = plane.normal;
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0) || !std::isfinite(1 / length) || !std::isfinite(plane.limit / length)) continue;
    planes_[static_cast<std::size_t>(num_planes_++)] = {{n[0] / length, n[1] / length, n[2] / length},
                                                        plane.limit / length + slack_};
  }
}

void Slices::add_shadow() {
  for (int i = 0; i < num_planes_; ++i) {
    const auto& [n, limit] = planes_[static_cast<std::size_t>(i)];
    // Against the box: n_x x is at least its least value there.
    shadow_[static_cast<std::size_t>(num_edges_++)] = {n[1], n[2], limit - least(n[0], low_[0], high_[0])};
    if (n[0] <= 0) continue;
    for (int j = 0; j < num_planes_; ++j) {
      const auto& [m, other_limit] = planes_[static_cast<std::size_t>(j)];
      if (m[0] >= 0) continue;
      shadow_[static_cast<std::size_t>(num_edges_++)] = {n[1] * -m[0] + m[1] * n[0], n[2] * -m[0] + m[2] * n[0],
                                                         limit * -m[0] + other_limit * n[0]};
    }
  }
}

/// What the layer of cells has in common with the box, about the origin, m. Cells at the bound reach to infinity.
Slices::Interval Slices::layer(std::int32_t cell, Eigen::Index axis) const {
  const double from = cell <= -Cells::bound ? -INFINITY : cell * cells_.size() - test_.origin()[axis];
  const double to = cell >= Cells::bound ? INFINITY : (cell + 1) * cells_.size() - test_.origin()[axis];
  return {std::clamp(from, low_[axis], high_[axis]), std::clamp(to, low_[axis], high_[axis])};
}

CellRange Slices::cells_of(const Interval& interval, std::size_t axis) const {
  if (interval.low > interval.high) return {0, -1};
  const double origin = test_.origin()[static_cast<Eigen::Index>(axis)];
  return {std::max(box_.low[axis], cells_.of(origin + interval.low - slack_)),
          std::min(box_.high[axis], cells_.of(origin + interval.high + slack_))};
}

CellRange Slices::y_range(std::int32_t z) const {
  if (num_planes_ == 0) return {box_.low[1], box_.high[1]};
  const Interval in_z = layer(z, 2);
  Interval y{low_[1], high_[1]};
  for (int k = 0; k < num_edges_; ++k) {
    const auto& [a, b, c] = shadow_[static_cast<std::size_t>(k)];
    narrow(a, c - least(b, in_z.low, in_z.high), y.low, y.high);
  }
  return cells_of(y, 1);
}

CellRange Slices::x_range(std::int32_t z, std::int32_t y) const {
  if (num_planes_ == 0) return {box_.low[0], box_.high[0]};
  const Interval in_z = layer(z, 2), in_y = layer(y, 1);
  Interval x{low_[0], high_[0]};
  for (int k = 0; k < num_planes_; ++k) {
    const auto& [n, limit] = planes_[static_cast<std::size_t>(k)];
    narrow(n[0], limit - least(n[1], in_y.low, in_y.high) - least(n[2], in_z.low, in_z.high), x.low, x.high);
  }
  return cells_of(x, 0);
}

}  // namespace breccia::detection
