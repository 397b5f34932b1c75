#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "detection/equal_size/radix_sort.hpp"
#include "detection/point_body/hilbert.hpp"

namespace breccia::detection {

/// Cubic cells along which positions are ordered: cell = (x - origin) / size, limited to 0 .. 4^pairs - 1.
struct CurveFrame {
  Vec3 lower = Vec3::Zero();   ///< m, corner of the first cell
  Vec3 centre = Vec3::Zero();  ///< m, median of a sample: where most positions are
  double cells_a_metre = 1;
  int pairs = 1;         ///< HilbertCurve
  double last_cell = 3;  ///< 4^pairs - 1

  /// @pre x is finite
  [[nodiscard]] std::uint32_t place(const Vec3& x) const {
    const auto cell = [&](Eigen::Index axis) {
      return static_cast<std::uint32_t>(std::clamp((x[axis] - lower[axis]) * cells_a_metre, 0.0, last_cell));
    };
    return HilbertCurve::place(cell(0), cell(1), cell(2), pairs);
  }
};

/// A frame in which positions spread as evenly as they are: it holds all of them, save those that lie very far from
/// most (beyond 8 times the extent of the middle half of a sample); they go to cells at its border. O(points): one pass
/// for their box, and medians of 512 of them. Positions that are not finite are passed over.
[[nodiscard]] CurveFrame frame_of(std::span<const Vec3> points);

/// Whether the path through positions, in the order given, is hardly longer than in their order along a curve, in which
/// they are left. Those that are not finite are passed over.
[[nodiscard]] bool is_short_path(std::span<Vec3> positions);

/// Numbers in the order of their positions along the Hilbert curve of a frame. A cell that holds more than `crowd` of
/// them is ordered within itself in the same way, so that the order is good wherever they are dense.
///
/// O(numbers) where they are spread evenly; memory 20 bytes a number that is sorted, 8 a number that stays, kept from
/// call to call.
class CurveOrder {
 public:
  struct Record {
    std::uint32_t place;
    std::uint32_t number;
  };
  static constexpr std::size_t crowd = 16;

  /// As sort, but numbers that are nearly in order remain unchanged: then only a sample is checked, O(log count),
  /// beside one pass for non-finite values.
  template <class Position>
  std::span<const Record> arrange(std::size_t count, const CurveFrame& frame, Position position) {
    if (!follows_curve(count, position)) return sort(count, frame, position);
    kept_.clear();
    kept_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (position(i).allFinite()) kept_.push_back({0, static_cast<std::uint32_t>(i)});
    }
    return kept_;
  }

  /// @param position(i)  m, of the number i < count
  /// @return  those with a finite position, valid until the next call. Throws std::bad_alloc.
  template <class Position>
  std::span<const Record> sort(std::size_t count, const CurveFrame& frame, Position position) {
    places_.resize(count);
    const std::uint32_t beyond = 1U << 6 * frame.pairs;  // where positions that are not finite go
    std::size_t num_finite = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 x = position(i);
      const bool finite = x.allFinite();
      places_[i] = finite ? frame.place(x) : beyond;
      num_finite += finite;
    }
    const std::span<Record> sorted = sort_places(6 * frame.pairs + 1).first(num_finite);
    for_crowds(sorted, [&](std::span<Record> run) { refine(run, position); });
    return sorted;
  }

 private:
  /// Checks a few hundred successive numbers in four places, then every fourth, every sixteenth, and so on.
  template <class Position>
  static bool follows_curve(std::size_t count, Position position) {
    constexpr std::size_t length = 256, places = 4;
    if (count < length) return false;
    std::array<Vec3, length> sample;
    for (std::size_t stride = 1; stride * length <= count; stride *= 4) {
      const std::size_t rest = count - stride * length;
      for (std::size_t place = 0; place < places; ++place) {
        const std::size_t first = rest / (places - 1) * place;
        for (std::size_t i = 0; i < length; ++i) sample[i] = position(first + i * stride);
        if (!is_short_path(sample)) return false;
      }
    }
    return true;
  }

  std::span<Record> sort_places(int num_bits);

  /// visit(run) for every run of equal places that is longer than `crowd`.
  template <class Visit>
  static void for_crowds(std::span<Record> sorted, Visit visit) {
    for (std::size_t begin = 0; begin + crowd < sorted.size();) {
      if (sorted[begin + crowd].place != sorted[begin].place) {
        ++begin;
        continue;
      }
      std::size_t end = begin + crowd + 1;
      while (end < sorted.size() && sorted[end].place == sorted[begin].place) ++end;
      visit(sorted.subspan(begin, end - begin));
      begin = end;
    }
  }

  /// Orders a run of equal places along a curve through its own box, 16 cells an edge, and again where they still
  /// crowd.
  template <class Position>
  static void refine(std::span<Record> run, Position position) {
    Vec3 low = position(run[0].number), high = low;
    for (const Record& record : run) {
      const Vec3 x = position(record.number);
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const double width = (0.5 * high - 0.5 * low).maxCoeff();  // halves, as the difference itself may overflow
    if (!(width > 1e-290)) return;                             // all in one place
    const CurveFrame frame{low, low, 8 / width, 2, 15};
    for (Record& record : run) record.place = frame.place(position(record.number));
    std::sort(run.begin(), run.end(), [](const Record& a, const Record& b) {
      return a.place != b.place ? a.place < b.place : a.number < b.number;
    });
    for_crowds(run, [&](std::span<Record> inner) { refine(inner, position); });
  }

  std::vector<std::uint32_t> places_;
  std::vector<Record> kept_;  ///< of arrange, where nothing is sorted
  RadixSort<Record> sorter_;
};

}  // namespace breccia::detection
