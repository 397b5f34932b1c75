#pragma once

#include <array>

#include "base/types.hpp"
#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// The definition of a couple (search.hpp), prepared for one contactor. Every algorithm decides with `holds`, so their
/// sets are the same bit for bit.
///
///   (1) min_a x_a - b <= p <= max_a x_a + b, componentwise, border included
///   (2) n_a . (p - x_0) <= n_a . (x_f - x_0) + b |n_a| + r,   a = 0..3
///
/// with buffer b, n_a the outward normal of the face opposite corner a (twice its area long), x_f a corner of it, and r
/// a bound of the round-off of this very comparison, 32 eps h^2 d (h, d: diagonals of the box and of the enlarged box).
/// So a sliver whose normal is nothing but round-off rejects no point that the exact comparison accepts. A larger
/// buffer never loses a couple. With a volume that is not positive (2) is left out.
class CoupleTest {
 public:
  /// @param corners  m
  /// @param buffer   m, >= 0
  CoupleTest(const Corners& corners, double buffer);

  /// A corner is not finite: the contactor has no couples.
  [[nodiscard]] bool skipped() const { return skipped_; }
  /// (2) applies.
  [[nodiscard]] bool has_planes() const { return has_planes_; }

  /// (1). Without branches: in a search about half of the candidates pass, in no order a processor could guess.
  [[nodiscard]] bool in_box(const Vec3& p) const {
    return (p[0] >= low_[0]) & (p[0] <= high_[0]) & (p[1] >= low_[1]) & (p[1] <= high_[1]) & (p[2] >= low_[2]) &
           (p[2] <= high_[2]);
  }

  /// (2), likewise. An overflow (a NaN on either side) keeps the couple. True without planes.
  [[nodiscard]] bool in_planes(const Vec3& p) const {
    const double x = p[0] - origin_[0], y = p[1] - origin_[1], z = p[2] - origin_[2];
    bool outside = false;
    for (const Plane& plane : planes_) {
      outside |= plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z > plane.limit;
    }
    return !(outside & has_planes_);
  }

  /// True if `p` and the contactor are a couple: (1) and (2). False for a point that is not finite.
  [[nodiscard]] bool holds(const Vec3& p) const { return in_box(p) && in_planes(p); }

  /// normal . (p - origin) <= limit
  struct Plane {
    std::array<double, 3> normal;
    double limit;
  };
  [[nodiscard]] const std::array<Plane, 4>& planes() const { return planes_; }  ///< @pre has_planes()
  [[nodiscard]] const Vec3& origin() const { return origin_; }                  ///< corner 0
  [[nodiscard]] const Vec3& low() const { return low_; }                        ///< of the enlarged box
  [[nodiscard]] const Vec3& high() const { return high_; }

 private:
  void set_planes(const Corners& corners, double buffer, double box_diagonal);

  Vec3 low_, high_;
  Vec3 origin_;
  std::array<Plane, 4> planes_{};
  bool skipped_ = false;
  bool has_planes_ = false;
};

/// What every search refuses: a buffer that is negative or not finite, more points or contactors than Index can number.
/// Throws InternalError.
void demand_searchable(std::size_t num_points, std::size_t num_contactors, double buffer);

}  // namespace breccia::detection
