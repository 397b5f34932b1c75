#include "physics/contact/locate.hpp"

#include <algorithm>

#include "physics/contact/couples.hpp"

namespace breccia {

/// How far ahead the list reaches changes no result: a longer list is made less often and read with more couples.
void Locator::wake() {
  constexpr double kLastTravels = 16;  // ahead, in what was travelled in the last step
  wake_couples(kLastTravels * std::max(0.0, contact_.travel - contact_.travel_before), contact_);
}

/// Locates a point in its contactors. @param couples  of one point
void Locator::collect(std::span<AwakeCouple> couples) {
  const std::size_t before = located_.size();
  Vec3 x = Vec3::Zero();
  for (AwakeCouple& couple : couples) {
    if (contact_.travel < couple.apart_until) continue;
    const std::size_t block = located_.size() / kLanes, lane = located_.size() % kLanes;
    if (located_.size() == before) {
      points_.push_back({couple.point, before});
      x = view_.place_of(view_.point(couple.point));
    }
    located_.push_back(&couple);
    if (block == blocks_.size()) blocks_.emplace_back();
    LocateBlock& b = blocks_[block];
    b.tetra[lane] = &view_.element(couple.slot).tetra;
    for (std::size_t axis = 0; axis < 3; ++axis) b.x[axis][lane] = x[static_cast<Eigen::Index>(axis)];
    if (lane + 1 == kLanes) kernels_.locate(b);
  }
}

/// Evaluates the last block if it is not full.
void Locator::fill_last_block() {
  const std::size_t count = located_.size() % kLanes;
  if (count == 0) return;
  LocateBlock& block = blocks_[located_.size() / kLanes];
  for (std::size_t lane = count; lane < kLanes; ++lane) block.tetra[lane] = block.tetra[0];
  kernels_.locate(block);
}

/// Fills inside_ and beside_ from the located couples [first, end).
void Locator::sort_out(std::size_t first, std::size_t end) {
  inside_.clear();
  beside_.clear();
  for (std::size_t k = first; k < end; ++k) {
    const LocateBlock& block = blocks_[k / kLanes];
    const std::size_t lane = k % kLanes;
    if (block.where[lane] == Whereabouts::outside) {
      located_[k]->apart_until = contact_.travel + block.safe[lane];
    } else if (block.where[lane] != Whereabouts::nowhere) {
      std::vector<Nearby>& nearby = block.where[lane] == Whereabouts::inside ? inside_ : beside_;
      nearby.push_back({located_[k],
                        {block.lambda[0][lane], block.lambda[1][lane], block.lambda[2][lane], block.lambda[3][lane]},
                        block.safe[lane]});
    }
  }
}

}  // namespace breccia
