#pragma once

#include "detection/point_body/couple_sorter.hpp"
#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// Every point against every contactor, O(num_points num_contactors): the reference for the other algorithms.
class BruteForce final : public PointBodySearch {
 public:
  void search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
              std::vector<Couple>& couples) override;

 private:
  std::vector<Couple> found_;
  CoupleSorter sorter_;
};

}  // namespace breccia::detection
