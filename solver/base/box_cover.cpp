#include "base/box_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

namespace breccia {
namespace {

constexpr std::size_t kBins = 16;

/// Half the surface of a box, m2: how likely it is that something is near to it.
double half_surface(const Extent& box) {
  if (box.empty()) return 0;
  const Vec3 edge = box.upper - box.lower;
  return edge[0] * edge[1] + edge[1] * edge[2] + edge[2] * edge[0];
}

/// Some of the boxes, first .. end - 1 of their order.
struct Part {
  std::size_t first, end;
  Extent box;

  [[nodiscard]] double cost() const { return half_surface(box) * static_cast<double>(end - first); }
};

struct Cut {
  int axis = -1;  ///< -1: there is none
  double place = 0;
};

/// The boxes of a part by the bin that their middle lies in.
struct Bins {
  std::array<Extent, kBins> box;
  std::array<std::size_t, kBins> count{};
};

double middle(const Extent& box, int axis) { return 0.5 * (box.lower[axis] + box.upper[axis]); }

class Cover {
 public:
  explicit Cover(std::span<const Extent> boxes) {
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(boxes_), [](const Extent& b) { return !b.empty(); });
  }

  std::vector<Extent> run() {
    std::vector<Part> parts{part(0, boxes_.size())};
    for (bool cut = true; cut && parts.size() < kMostBoxes;) {
      const auto dearest = std::max_element(parts.begin(), parts.end(),
                                            [](const Part& a, const Part& b) { return a.cost() < b.cost(); });
      cut = split(*dearest, parts);
    }
    std::vector<Extent> cover;
    for (const Part& each : parts) {
      if (!each.box.empty()) cover.push_back(each.box);
    }
    return cover;
  }

 private:
  [[nodiscard]] Part part(std::size_t first, std::size_t end) const {
    Part made{first, end, {}};
    for (std::size_t i = first; i < end; ++i) made.box.add(boxes_[i]);
    return made;
  }

  /// @param which  one of `parts`, replaced by its halves.  @return  whether it has been cut
  bool split(const Part& which, std::vector<Part>& parts) {
    const Cut cut = best_cut(which);
    if (cut.axis < 0) return false;
    const auto begin = boxes_.begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(which.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(which.end);
    const auto bound = std::partition(first, end, [&](const Extent& box) { return middle(box, cut.axis) < cut.place; });
    const Part low = part(which.first, static_cast<std::size_t>(bound - begin)), high = part(low.end, which.end);
    *std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.first == low.first; }) = low;
    parts.push_back(high);
    return true;
  }

  /// The cut between bins that leaves the least cost, if that is less than the cost of the whole.
  [[nodiscard]] Cut best_cut(const Part& whole) const {
    Cut best;
    double least = whole.cost();
    for (int axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = whole.first; i < whole.end; ++i) {
        low = std::min(low, middle(boxes_[i], axis));
        high = std::max(high, middle(boxes_[i], axis));
      }
      const double width = (high - low) / kBins;
      if (!(width > 0 && std::isfinite(width))) continue;
      const Bins bins = filled(whole, axis, low, width);
      for (std::size_t bin = 1; bin < kBins; ++bin) {
        const double cost = cost_of(bins, 0, bin) + cost_of(bins, bin, kBins);
        if (!(cost < least)) continue;
        least = cost;
        best = {axis, low + static_cast<double>(bin) * width};
      }
    }
    return best;
  }

  [[nodiscard]] Bins filled(const Part& whole, int axis, double low, double width) const {
    Bins bins;
    for (std::size_t i = whole.first; i < whole.end; ++i) {
      const double place = (middle(boxes_[i], axis) - low) / width;
      const std::size_t bin = std::min(static_cast<std::size_t>(place), kBins - 1);
      bins.box[bin].add(boxes_[i]);
      ++bins.count[bin];
    }
    return bins;
  }

  [[nodiscard]] static double cost_of(const Bins& bins, std::size_t first, std::size_t end) {
    Part joined{0, 0, {}};
    for (std::size_t bin = first; bin < end; ++bin) {
      joined.box.add(bins.box[bin]);
      joined.end += bins.count[bin];
    }
    return joined.cost();
  }

  std::vector<Extent> boxes_;
};

}  // namespace

std::vector<Extent> cover(std::span<const Extent> boxes) { return Cover(boxes).run(); }

bool near_any(const Extent& box, std::span<const Extent> boxes, double distance) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Extent& other) { return box.near(other, distance); });
}

}  // namespace breccia
