#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/index.hpp"
#include "base/types.hpp"

namespace breccia {

/// Sets of the numbers 0 .. size-1, at first each in a set of its own (union-find with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size = 0) { reset(size); }
  /// Each number in a set of its own again. No allocation up to the largest size so far.
  void reset(std::size_t size) {
    parent_.resize(size);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// The smallest member of the set of i.
  [[nodiscard]] Index root(Index i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  void join(Index a, Index b) {
    a = root(a), b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;  ///< never larger than the number itself
};

}  // namespace breccia
