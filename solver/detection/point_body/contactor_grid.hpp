#pragma once

#include <span>
#include <vector>

#include "detection/point_body/cells.hpp"
#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// Contactors binned by their enlarged boxes, for the few points that appear between two searches: `couples_of` finds
/// what a full search with the same contactors and buffer would find for one more point.
class ContactorGrid {
 public:
  /// @param contactors  (num_contactors) corners, m; must live and stay as they are until the next build
  /// @param buffer      m, >= 0
  /// O(num_contactors) for contactors of like size. Throws InternalError if the buffer is negative or not finite.
  void build(std::span<const Corners> contactors, double buffer);

  /// @param contactors  out: those that form a couple with the point (search.hpp), ascending; old content is dropped
  /// @pre build has been called. O(contactors in the point's cell).
  void couples_of(const Vec3& point, std::vector<Index>& contactors) const;

 private:
  [[nodiscard]] std::size_t bucket(std::int32_t x, std::int32_t y, std::int32_t z) const;
  void fill_buckets();

  std::span<const Corners> contactors_;
  double buffer_ = 0;
  Cells cells_{1.0};
  std::vector<Index> start_;    ///< (buckets + 1) first entry of a bucket
  std::vector<Index> entries_;  ///< contactors whose box touches a cell of the bucket
  std::vector<Index> wide_;     ///< contactors over too many cells to be binned
};

}  // namespace breccia::detection
