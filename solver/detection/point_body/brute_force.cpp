#include "detection/point_body/brute_force.hpp"

#include "detection/point_body/couple_test.hpp"

namespace breccia::detection {

void BruteForce::search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
                        std::vector<Couple>& couples) {
  demand_searchable(points.size(), contactors.size(), buffer);
  found_.clear();
  for (std::size_t c = 0; c < contactors.size(); ++c) {
    const CoupleTest test(contactors[c], buffer);
    if (test.skipped()) continue;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (test.holds(points[p])) found_.push_back({static_cast<Index>(p), static_cast<Index>(c)});
    }
  }
  sorter_.sort(found_, points.size(), couples);
}

}  // namespace breccia::detection
