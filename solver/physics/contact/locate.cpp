#include "physics/contact/locate.hpp"

#include <algorithm>

#include "physics/contact/couples.hpp"

namespace breccia {

/// For some steps, if they are as long as the last one.
void Locator::wake() {
  constexpr double kSteps = 16;
  wake_couples(kSteps * std::max(0.0, contact_.travel - contact_.travel_before), contact_);
}

/// Locates a point in its contactors. @param couples  of one point
void Locator::collect(std::span<AwakeCouple> couples) {
  const std::size_t before = located_.size();
  Vec3 x = Vec3::Zero();
  for (AwakeCouple& couple : couples) {
    if (contact_.travel < couple.apart_until) continue;
    const std::size_t lane = located_.size() % kLanes;
    if (located_.size() == before) {
      points_.push_back({couple.point, before});
      x = view_.place_of(view_.point(couple.point));
    }
    located_.emplace_back().here.couple = &couple;
    block_.tetra[lane] = &view_.tetra_of(couple.contactor);
    for (std::size_t axis = 0; axis < 3; ++axis) block_.x[axis][lane] = x[static_cast<Eigen::Index>(axis)];
    if (lane + 1 == kLanes) locate(located_.size() - kLanes);
  }
}

/// Evaluates the block. @param first  of its couples
void Locator::locate(std::size_t first) {
  const std::size_t count = located_.size() - first;
  for (std::size_t lane = count; lane < kLanes; ++lane) block_.tetra[lane] = block_.tetra[0];
  kernels_.locate(block_);
  for (std::size_t lane = 0; lane < count; ++lane) {
    Located& located = located_[first + lane];
    for (std::size_t a = 0; a < 4; ++a) located.here.lambda[a] = block_.lambda[a][lane];
    located.here.safe = block_.safe[lane];
    located.where = block_.where[lane];
  }
}

/// Fills inside_ and beside_ from the located couples [first, end).
void Locator::sort_out(std::size_t first, std::size_t end) {
  inside_.clear();
  beside_.clear();
  for (std::size_t k = first; k < end; ++k) {
    const Located& located = located_[k];
    switch (located.where) {
      case Whereabouts::inside:
        inside_.push_back(located.here);
        break;
      case Whereabouts::beside:
        beside_.push_back(located.here);
        break;
      case Whereabouts::outside:
        located.here.couple->apart_until = contact_.travel + located.here.safe;
        break;
      case Whereabouts::nowhere:
        break;
    }
  }
}

}  // namespace breccia
