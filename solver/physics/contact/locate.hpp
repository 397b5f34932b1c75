#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "physics/contact/block.hpp"
#include "physics/contact/resolve.hpp"
#include "physics/contact/view.hpp"

/// For the sources of physics/contact alone.
namespace breccia {

/// Finds the contactors that points are in or just beside, several couples side by side. Couples that cannot touch yet
/// are skipped.
class Locator {
 public:
  Locator(ContactView& view, ContactState& contact, const ContactKernels& kernels)
      : view_(view), contact_(contact), kernels_(kernels) {}

  /// Calls use(point, couples whose contactor holds it, couples beside whose contactor it lies) for every point that
  /// may touch something, by ascending ids; couples ascending.
  template <class Use>
  void for_each_point(Use&& use) {
    if (!(contact_.travel < contact_.awake_until)) wake();
    const std::span<AwakeCouple> awake{contact_.awake};
    for (std::size_t first = 0, end = 0; first < awake.size(); first = end) {
      for (end = first + 1; end < awake.size() && awake[end].point == awake[first].point; ++end) continue;
      collect(awake.subspan(first, end - first));
      if (located_.size() >= kMostLocated) use_located(use);
    }
    use_located(use);
    contact_.travel_before = contact_.travel;
  }

 private:
  /// Couples that are located before the first of their points is used: few, so that they remain in the cache.
  static constexpr std::size_t kMostLocated = 64;

  /// A point, with its couples.
  struct LocatedPoint {
    Index point;
    std::size_t first;  ///< of its couples that are located
  };

  template <class Use>
  void use_located(Use&& use) {
    fill_last_block();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sort_out(points_[i].first, i + 1 < points_.size() ? points_[i + 1].first : located_.size());
      use(points_[i].point, std::as_const(inside_), beside_);
    }
    points_.clear();
    located_.clear();
  }

  void wake();
  void collect(std::span<AwakeCouple> couples);
  void fill_last_block();
  void sort_out(std::size_t first, std::size_t end);

  ContactView& view_;
  ContactState& contact_;
  const ContactKernels& kernels_;
  std::vector<LocateBlock> blocks_;
  std::vector<LocatedPoint> points_;   ///< a few, to be used next
  std::vector<AwakeCouple*> located_;  ///< of these, eight a block
  std::vector<Nearby> inside_;         ///< of the point at hand, ascending: couples whose contactor holds it
  std::vector<Nearby> beside_;         ///< likewise: it lies just outside
};

}  // namespace breccia
