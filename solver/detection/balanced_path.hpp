#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace breccia::detection {

/// The way down a balanced binary tree, and the balancing back up along it. Source: [Schiava, 4.3, tables 4.2 and 4.3]
///
/// Shared by the trees of the detection: what their nodes carry and how they are ordered is theirs alone. A tree is a
/// vector of nodes with `Index son[2]` and `std::int8_t balance` (height of the right sub-tree minus height of the left
/// one: -1, 0 or 1). Node 0 is empty, its left son is the root of the tree; `none` is no son.
///
/// The path holds the nodes left on the way down and the sides by which they were left; one to be used again, not per
/// call. Cost of `attach` and `detach`: O(height), one or, in `detach`, at most height rotations.
class BalancedPath {
 public:
  enum Side : std::uint8_t { left = 0, right = 1 };
  static constexpr Index none = -1;

  /// Back above the root.
  void restart() {
    length_ = 0;
    push(0, left);
  }
  void push(Index node, Side side) {
    node_[length_] = node;
    side_[length_] = side;
    ++length_;
  }
  void pop() { --length_; }

  [[nodiscard]] int length() const { return length_; }
  [[nodiscard]] Index node(int place) const { return node_[place]; }
  [[nodiscard]] Side side(int place) const { return side_[place]; }

  /// Hangs `added`, a node without sons, on the free side at the end of the path and balances the tree.
  template <class Node>
  void attach(std::vector<Node>& nodes, Index added) {
    at(nodes, node_[length_ - 1]).son[side_[length_ - 1]] = added;
    retrace_added(nodes);
  }

  /// Takes `node` out of the tree and balances it; the other nodes keep their numbers. @pre the path leads to `node`
  template <class Node>
  void detach(std::vector<Node>& nodes, Index node) {
    unlink(nodes, node);
    retrace_removed(nodes);
  }

 private:
  template <class Node>
  static Node& at(std::vector<Node>& nodes, Index node) {
    return nodes[static_cast<std::size_t>(node)];
  }
  static int weight(Side side) { return side == right ? 1 : -1; }

  template <class Node>
  void retrace_added(std::vector<Node>& nodes);
  template <class Node>
  void retrace_removed(std::vector<Node>& nodes);
  template <class Node>
  void unlink(std::vector<Node>& nodes, Index node);
  template <class Node>
  static std::pair<Index, bool> rotate(std::vector<Node>& nodes, Index i);

  /// 1.45 log2(2^31) < 46 levels, the empty node and the removed one's place make 48.
  /// @{
  Index node_[48];
  Side side_[48];
  int length_ = 0;
  /// @}
};

/// A sub-tree below the path has grown by one level: balances up to the node that absorbs it.
template <class Node>
void BalancedPath::retrace_added(std::vector<Node>& nodes) {
  for (int k = length_ - 1; k > 0; --k) {
    Node& node = at(nodes, node_[k]);
    node.balance = static_cast<std::int8_t>(node.balance + weight(side_[k]));
    if (node.balance == 0) return;
    if (node.balance == 1 || node.balance == -1) continue;
    at(nodes, node_[k - 1]).son[side_[k - 1]] = rotate(nodes, node_[k]).first;
    return;
  }
}

/// A sub-tree below the path has lost one level.
template <class Node>
void BalancedPath::retrace_removed(std::vector<Node>& nodes) {
  for (int k = length_ - 1; k > 0; --k) {
    Node& node = at(nodes, node_[k]);
    node.balance = static_cast<std::int8_t>(node.balance - weight(side_[k]));
    if (node.balance == 1 || node.balance == -1) return;
    if (node.balance == 0) continue;
    const auto [top, lower] = rotate(nodes, node_[k]);
    at(nodes, node_[k - 1]).son[side_[k - 1]] = top;
    if (!lower) return;
  }
}

/// Turns the sub-tree of an unbalanced node towards its shorter side: cases 1 to 4 of table 4.3, the mirrored ones in
/// one, with `heavy` the side of the higher sub-tree. Returns the new top and whether the sub-tree is lower than
/// before.
template <class Node>
std::pair<Index, bool> BalancedPath::rotate(std::vector<Node>& nodes, Index i) {
  Node& top = at(nodes, i);
  const Side heavy = top.balance > 0 ? right : left;
  const Side light = heavy == right ? left : right;
  const int sign = weight(heavy);
  const Index j = top.son[heavy];
  Node& son = at(nodes, j);
  const int balance_j = son.balance;

  if (balance_j != -sign) {  // cases 1 and 2: eq. (4.22), (4.23), (4.27), (4.28)
    top.son[heavy] = son.son[light];
    son.son[light] = i;
    top.balance = static_cast<std::int8_t>(sign - balance_j);
    son.balance = static_cast<std::int8_t>(balance_j - sign);
    return {j, balance_j != 0};
  }

  const Index k = son.son[light];  // cases 3 and 4: eq. (4.31) to (4.36)
  Node& grandson = at(nodes, k);
  const int balance_k = grandson.balance;
  top.son[heavy] = grandson.son[light];
  son.son[light] = grandson.son[heavy];
  grandson.son[light] = i;
  grandson.son[heavy] = j;
  top.balance = static_cast<std::int8_t>(balance_k == sign ? -sign : 0);
  son.balance = static_cast<std::int8_t>(balance_k == -sign ? sign : 0);
  grandson.balance = 0;
  return {k, true};
}

/// A node with two sons is replaced by the next smaller one. Leaves the path at the place where a level was lost.
template <class Node>
void BalancedPath::unlink(std::vector<Node>& nodes, Index node) {
  Node& leaving = at(nodes, node);
  const int place = length_;  // of the node, if it were on the path
  const Index above = node_[place - 1];
  const Side side = side_[place - 1];
  if (leaving.son[left] == none || leaving.son[right] == none) {
    at(nodes, above).son[side] = leaving.son[left] != none ? leaving.son[left] : leaving.son[right];
    return;
  }

  push(node, right);
  Index heir = leaving.son[right];
  while (at(nodes, heir).son[left] != none) {
    push(heir, left);
    heir = at(nodes, heir).son[left];
  }
  at(nodes, node_[length_ - 1]).son[side_[length_ - 1]] = at(nodes, heir).son[right];
  at(nodes, heir).son[left] = leaving.son[left];
  at(nodes, heir).son[right] = leaving.son[right];
  at(nodes, heir).balance = leaving.balance;
  at(nodes, above).son[side] = heir;
  node_[place] = heir;
}

}  // namespace breccia::detection
