#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace breccia {

/// Boxes in a binary tree, halved at the middle of their longest extent.
class PatchTree {
 public:
  struct Box {
    std::array<double, 3> low, high;
  };

  /// @param boxes  outlive this object. O(n log n)
  explicit PatchTree(std::span<const Box> boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(0, order_.size());
  }

  /// Calls visit(i) for every box i that overlaps this one, in an order that depends on the boxes alone.
  template <class F>
  void query(const Box& box, F&& visit) const {
    query(
        box, [](std::size_t) { return false; }, visit);
  }
  /// The same without the boxes below nodes n for which skip(n) holds when their turn comes.
  template <class Skip, class F>
  void query(const Box& box, Skip&& skip, F&& visit) const {
    if (!nodes_.empty()) descend(0, 0, order_.size(), box, skip, visit);
  }

  /// (nodes) what is known of all boxes below each: join(value, value) of its halves, value_of(i) of single boxes.
  template <class Value, class F, class Join>
  [[nodiscard]] std::vector<Value> by_node(F&& value_of, Join&& join) const {
    std::vector<Value> values(nodes_.size());
    if (!nodes_.empty()) gather(0, 0, order_.size(), value_of, join, values);
    return values;
  }

 private:
  static constexpr std::size_t kLeaf = 4;
  struct Node {
    Box box;
    std::int32_t right;  ///< index of the second half; the first follows the node. -1: a leaf
  };

  [[nodiscard]] const Box& box_at(std::size_t i) const { return boxes_[static_cast<std::size_t>(order_[i])]; }
  [[nodiscard]] static bool overlap(const Box& a, const Box& b) {
    bool over = true;
    for (std::size_t k = 0; k < 3; ++k) over = over && a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
    return over;
  }

  void build(std::size_t first, std::size_t last) {
    Box all = box_at(first);
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        all.low[k] = std::min(all.low[k], box_at(i).low[k]);
        all.high[k] = std::max(all.high[k], box_at(i).high[k]);
      }
    }
    const std::size_t node = nodes_.size();
    nodes_.push_back({all, -1});
    if (last - first <= kLeaf) return;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (all.high[k] - all.low[k] > all.high[axis] - all.low[axis]) axis = k;
    }
    const std::size_t middle = (first + last) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](std::int32_t a, std::int32_t b) {
                       const Box &p = boxes_[static_cast<std::size_t>(a)], &q = boxes_[static_cast<std::size_t>(b)];
                       const double pc = p.low[axis] + p.high[axis], qc = q.low[axis] + q.high[axis];
                       return pc != qc ? pc < qc : a < b;
                     });
    build(first, middle);
    nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
    build(middle, last);
  }

  template <class Value, class F, class Join>
  void gather(std::size_t node, std::size_t first, std::size_t last, F&& value_of, Join&& join,
              std::vector<Value>& values) const {
    if (nodes_[node].right < 0) {
      values[node] = value_of(order_[first]);
      for (std::size_t i = first + 1; i < last; ++i) values[node] = join(values[node], value_of(order_[i]));
      return;
    }
    const std::size_t middle = (first + last) / 2, right = static_cast<std::size_t>(nodes_[node].right);
    gather(node + 1, first, middle, value_of, join, values);
    gather(right, middle, last, value_of, join, values);
    values[node] = join(values[node + 1], values[right]);
  }

  template <class Skip, class F>
  void descend(std::size_t node, std::size_t first, std::size_t last, const Box& box, Skip&& skip, F&& visit) const {
    if (!overlap(nodes_[node].box, box) || skip(node)) return;
    if (nodes_[node].right < 0) {
      for (std::size_t i = first; i < last; ++i) {
        if (overlap(box_at(i), box)) visit(order_[i]);
      }
      return;
    }
    const std::size_t middle = (first + last) / 2;
    descend(node + 1, first, middle, box, skip, visit);
    descend(static_cast<std::size_t>(nodes_[node].right), middle, last, box, skip, visit);
  }

  std::span<const Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace breccia
