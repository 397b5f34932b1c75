#include "parallel/bisection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace breccia {
namespace {

constexpr std::size_t kBins = 256;  ///< of a histogram; each pass refines the bin that contains the cut
constexpr int kPasses = 5;          ///< 2^-40 of the box: finer than elements are apart, along the tilted normal too
/// Cuts are planes tilted by this slope, and by its square along the third axis: regular meshes have many centroids in
/// one plane, which could only go to one side together.
constexpr double kTilt = 1e-4;
constexpr double kRoundOff = 1e-12;  ///< of a box, so that its own elements are never outside

/// Several domains that are still one part.
struct Part {
  int first, count;  ///< domains
  int axis = 0;
  double lower = 0, upper = 0;        ///< m, where the cut lies along its normal
  std::int64_t below = 0, total = 0;  ///< weight below `lower`, and of the part
};

/// Weights as integers, so that sums do not depend on their order.
class Bisection {
 public:
  Bisection(const Communicator& communicator, int parts, std::span<const Vec3> centroid, std::span<const double> weight)
      : communicator_(communicator), centroid_(centroid), parts_{{0, parts}}, part_(centroid.size(), 0) {
    double largest = 0;
    for (const double w : weight) largest = std::max(largest, w);
    largest = communicator.max(largest);
    for (const double w : weight) weight_.push_back(1 + std::llround((largest > 0 ? w / largest : 0.0) * kHeaviest));
  }

  std::vector<int> run() {
    while (std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.count > 1; })) {
      measure();
      for (int pass = 0; pass < kPasses; ++pass) narrow();
      split();
    }
    std::vector<int> domain;
    for (const std::size_t p : part_) domain.push_back(parts_[p].first);
    return domain;
  }

 private:
  static constexpr double kHeaviest = 1e6;

  static double along_normal(int axis, double x, double y, double z) {
    const std::array<double, 3> p{x, y, z};
    const auto a = static_cast<std::size_t>(axis);
    return p[a] + kTilt * (p[(a + 1) % 3] + kTilt * p[(a + 2) % 3]);
  }
  [[nodiscard]] double place(std::size_t e, int axis) const {
    return along_normal(axis, centroid_[e][0], centroid_[e][1], centroid_[e][2]);
  }

  /// Boxes of the parts; the cut is sought along the longest side.
  void measure() {
    std::vector<double> most(6 * parts_.size(), -std::numeric_limits<double>::infinity());
    std::vector<std::int64_t> total(parts_.size(), 0);
    for (std::size_t e = 0; e < part_.size(); ++e) {
      double* of_part = most.data() + 6 * part_[e];
      total[part_[e]] += weight_[e];
      for (int i = 0; i < 3; ++i) {
        of_part[i] = std::max(of_part[i], centroid_[e][i]);
        of_part[3 + i] = std::max(of_part[3 + i], -centroid_[e][i]);
      }
    }
    communicator_.max(most);
    communicator_.sum(total);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const double* m = most.data() + 6 * p;
      Part& part = parts_[p];
      part.axis = 0;
      for (int i = 1; i < 3; ++i) {
        if (m[i] + m[3 + i] > m[part.axis] + m[3 + part.axis]) part.axis = i;
      }
      const double lower = along_normal(part.axis, -m[3], -m[4], -m[5]),
                   upper = along_normal(part.axis, m[0], m[1], m[2]);
      const double slack = kRoundOff * (std::abs(lower) + std::abs(upper));
      part.lower = lower - slack;
      part.upper = upper + slack;
      part.below = 0;
      part.total = total[p];
    }
  }

  /// Domains on the lower side of a part's cut.
  static int lower_count(const Part& part) { return part.count / 2; }

  /// Brings the bounds of each cut together to one bin.
  void narrow() {
    std::vector<std::int64_t> bins(kBins * parts_.size(), 0);
    for (std::size_t e = 0; e < part_.size(); ++e) {
      const Part& part = parts_[part_[e]];
      if (part.count == 1) continue;
      const double x = place(e, part.axis);
      if (x < part.lower || x > part.upper) continue;
      bins[part_[e] * kBins + bin_of(part, x)] += weight_[e];
    }
    communicator_.sum(bins);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      Part& part = parts_[p];
      if (part.count == 1) continue;
      const auto wanted = static_cast<std::int64_t>(static_cast<double>(part.total) * lower_count(part) / part.count);
      std::size_t bin = 0;
      while (bin + 1 < kBins && part.below < wanted && part.below + bins[p * kBins + bin] <= wanted)
        part.below += bins[p * kBins + bin++];
      const double width = (part.upper - part.lower) / static_cast<double>(kBins);
      part.lower += width * static_cast<double>(bin);
      part.upper = bin + 1 == kBins ? part.upper : part.lower + width;
    }
  }

  static std::size_t bin_of(const Part& part, double x) {
    const double width = part.upper - part.lower;
    const double share = width > 0 ? (x - part.lower) / width : 0.0;
    return std::min(kBins - 1, static_cast<std::size_t>(share * static_cast<double>(kBins)));
  }

  /// Elements on the cut itself go to the upper side.
  void split() {
    std::vector<Part> halves;
    std::vector<std::size_t> lower(parts_.size()), upper(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      lower[p] = upper[p] = halves.size();
      const int below = lower_count(part);
      if (part.count > 1) {
        halves.push_back({part.first, below});
        upper[p] = halves.size();
      }
      halves.push_back({part.first + (part.count > 1 ? below : 0), part.count > 1 ? part.count - below : 1});
    }
    for (std::size_t e = 0; e < part_.size(); ++e) {
      const Part& part = parts_[part_[e]];
      const bool below = part.count > 1 && place(e, part.axis) < 0.5 * (part.lower + part.upper);
      part_[e] = below ? lower[part_[e]] : upper[part_[e]];
    }
    parts_ = std::move(halves);
  }

  const Communicator& communicator_;
  std::span<const Vec3> centroid_;
  std::vector<std::int64_t> weight_;
  std::vector<Part> parts_;
  std::vector<std::size_t> part_;  ///< (elements) index into parts_
};

}  // namespace

std::vector<int> bisect(const Communicator& communicator, int parts, std::span<const Vec3> centroid,
                        std::span<const double> weight) {
  return Bisection(communicator, parts, centroid, weight).run();
}

}  // namespace breccia
