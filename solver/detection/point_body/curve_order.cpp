#include "detection/point_body/curve_order.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace breccia::detection {

namespace {

constexpr std::size_t sample_size = 512;

/// Quartiles of a coordinate in a sample.
struct Quartiles {
  double low, middle, high;
};

Quartiles quartiles(std::span<double> sample) {
  const auto at = [&](std::size_t quarter) {
    const auto nth = sample.begin() + static_cast<std::ptrdiff_t>(quarter * (sample.size() - 1) / 4);
    std::nth_element(sample.begin(), nth, sample.end());
    return *nth;
  };
  return {at(1), at(2), at(3)};
}

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
};

Box box_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& x : points) {
    if (!x.allFinite()) continue;
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

}  // namespace

CurveFrame frame_of(std::span<const Vec3> points) {
  constexpr double reach = 8;
  std::array<std::array<double, sample_size>, 3> sample;
  std::size_t count = 0;
  const std::size_t stride = points.size() / sample_size + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!points[i].allFinite()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) sample[axis][count] = points[i][static_cast<Eigen::Index>(axis)];
    ++count;
  }
  CurveFrame frame;
  if (count == 0) return frame;

  const Box box = box_of(points);
  std::array<Quartiles, 3> spread;
  double middle_half = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    spread[axis] = quartiles({sample[axis].data(), count});
    middle_half = std::max(middle_half, 0.5 * spread[axis].high - 0.5 * spread[axis].low);
  }
  double width = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Quartiles& of = spread[static_cast<std::size_t>(axis)];
    const double margin = middle_half > 0 ? 2 * reach * middle_half : std::numeric_limits<double>::infinity();
    frame.centre[axis] = of.middle;
    frame.lower[axis] = std::max(box.low[axis], of.low - margin);
    width = std::max(width, std::min(box.high[axis], of.high + margin) - frame.lower[axis]);
  }
  frame.pairs = std::clamp(static_cast<int>(std::bit_width(points.size()) + 6) / 6, 1, HilbertCurve::most_pairs);
  frame.last_cell = static_cast<double>((1U << 2 * frame.pairs) - 1);
  frame.cells_a_metre = (frame.last_cell + 1) / std::clamp(width, 1e-290, 1e290);
  return frame;
}

bool is_short_path(std::span<Vec3> positions) {
  constexpr double most =
      1.4;  // of 1e6 points: this curve in any frame to 1.13, Z-order to 1.39; by rows, at random to 4.7
  constexpr int pairs = 3;
  constexpr double edge = 1 << 2 * pairs;
  const auto finite_end =
      std::remove_if(positions.begin(), positions.end(), [](const Vec3& x) { return !x.allFinite(); });
  const std::span<Vec3> path(positions.begin(), finite_end);
  if (path.empty()) return true;
  const Box box = box_of(path);
  const auto length = [&] {
    double sum = 0;  // halves, as a distance itself may overflow
    for (std::size_t i = 1; i < path.size(); ++i) sum += (0.5 * path[i] - 0.5 * path[i - 1]).lpNorm<1>();
    return sum;
  };
  const double given = length(), width = (0.5 * box.high - 0.5 * box.low).maxCoeff();
  if (!(width > 1e-290) || !std::isfinite(given)) return false;
  const CurveFrame frame{box.low, box.low, 0.5 * edge / width, pairs, edge - 1};
  std::sort(path.begin(), path.end(), [&](const Vec3& a, const Vec3& b) { return frame.place(a) < frame.place(b); });
  return given <= most * length();
}

std::span<CurveOrder::Record> CurveOrder::sort_places(int num_bits) {
  const int most = RadixSort<Record>::widest_digit(places_.size()), passes = (num_bits + most - 1) / most;
  const int digit_bits = (num_bits + passes - 1) / passes;
  const std::uint32_t mask = (1U << digit_bits) - 1;
  const auto make = [this](std::size_t i) { return Record{places_[i], static_cast<std::uint32_t>(i)}; };
  const auto digit = [=](const Record& record, int pass) { return record.place >> digit_bits * pass & mask; };
  return sorter_.sort(places_.size(), passes, digit_bits, make, digit, 0);
}

}  // namespace breccia::detection
