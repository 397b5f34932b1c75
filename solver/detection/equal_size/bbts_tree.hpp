#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "detection/balanced_path.hpp"
#include "detection/equal_size/cell.hpp"

namespace breccia::detection {

/// Spatial ordering criterion: cells are ordered by z, then y, then x. Source: [Schiava, eq. (4.14)]
template <int D, class Coordinate>
constexpr std::strong_ordering spatial_order(const Cell<D, Coordinate>& a, const Cell<D, Coordinate>& b) {
  for (std::size_t axis = D; axis-- > 0;) {
    if (a[axis] != b[axis]) return a[axis] <=> b[axis];
  }
  return std::strong_ordering::equal;
}

/// Balanced binary tree of cells, each with the objects in it. Source: [Schiava, 4.2 and 4.3]
///
/// Every object is a node. Of the objects of one cell a single node stands in the tree, the others are chained to it (P
/// of the source), so a cell is found in one descent. A node's left son is greater, its right son smaller; the balance
/// of a node, height of the right sub-tree minus height of the left one, is -1, 0 or 1 after every call. Nodes live in
/// one array and refer to each other by index: 24 bytes an object for 16-bit coordinates, against 40 with pointers in
/// eq. (4.16).
///
/// The balancing is shared with MsTree, the rest is not: that one lets equal keys coexist in the tree and keeps its
/// list for them, which costs the second pointer update and the two-sided descent that the chains avoid here. Removal,
/// which the source does not have, serves who keeps a tree from call to call.
template <int D, class Coordinate>
class BbtsTree {
 public:
  using Key = Cell<D, Coordinate>;
  static constexpr Index none = BalancedPath::none;

  BbtsTree() { clear(); }

  /// Drops all nodes, keeps the storage.
  void clear();
  void reserve(std::size_t num_objects) { nodes_.reserve(num_objects + 1); }

  /// Source: algorithm 4.2. O(log n).
  void add(const Key& key, Index object);

  /// Removes the object from its cell; false if it is not there. O(log n + objects of the cell).
  bool remove(const Key& key, Index object);

  /// First node of the cell, or none. Source: algorithm 4.3. O(log n).
  [[nodiscard]] Index find(const Key& key) const;

  [[nodiscard]] Index next_in_cell(Index node) const { return at(node).chained; }  ///< none after the last
  [[nodiscard]] const Key& key(Index node) const { return at(node).key; }
  [[nodiscard]] Index object(Index node) const { return at(node).object; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

  /// Calls visit(node) for the first node of every cell, in ascending order. O(n).
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    walk(root(), visit);
  }

  /// Whether order and balances are as promised, from the heights themselves. O(n).
  [[nodiscard]] bool is_ordered_and_balanced() const { return inspect(root(), nullptr, nullptr) >= 0; }

 private:
  using enum BalancedPath::Side;

  struct Node {
    Key key;
    std::int8_t balance;
    Index son[2];
    Index chained;  ///< next object of the same cell; of a free place, the next free place
    Index object;
  };

  [[nodiscard]] Node& at(Index node) { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const Node& at(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] Index root() const { return nodes_[0].son[left]; }

  Index new_node(const Key& key, Index object);
  void give_up(Index node);
  Index descend(const Key& key);
  template <class Visit>
  void walk(Index subtree, Visit& visit) const;
  [[nodiscard]] int inspect(Index subtree, const Key* above_all, const Key* below_all) const;

  std::vector<Node> nodes_;  ///< nodes_[0]: the empty node above the root, which is its left son
  BalancedPath path_;
  Index free_ = none;
  std::size_t size_ = 0;
};

template <int D, class Coordinate>
void BbtsTree<D, Coordinate>::clear() {
  nodes_.clear();
  nodes_.push_back({{}, 0, {none, none}, none, none});
  free_ = none;
  size_ = 0;
}

template <int D, class Coordinate>
Index BbtsTree<D, Coordinate>::new_node(const Key& key, Index object) {
  ++size_;
  const Node node{key, 0, {none, none}, none, object};
  if (free_ == none) {
    nodes_.push_back(node);
    return static_cast<Index>(nodes_.size() - 1);
  }
  const Index place = free_;
  free_ = at(place).chained;
  at(place) = node;
  return place;
}

template <int D, class Coordinate>
void BbtsTree<D, Coordinate>::give_up(Index node) {
  at(node).chained = free_;
  free_ = node;
  --size_;
}

/// Leads the path to the node of the key, which is returned, or to its free place.
template <int D, class Coordinate>
Index BbtsTree<D, Coordinate>::descend(const Key& key) {
  path_.restart();
  Index current = root();
  while (current != none) {
    const auto order = spatial_order<D, Coordinate>(at(current).key, key);
    if (order == 0) break;
    const auto side = order > 0 ? right : left;
    path_.push(current, side);
    current = at(current).son[side];
  }
  return current;
}

template <int D, class Coordinate>
void BbtsTree<D, Coordinate>::add(const Key& key, Index object) {
  const Index found = descend(key);
  const Index added = new_node(key, object);
  if (found == none) {
    path_.attach(nodes_, added);
  } else {
    at(added).chained = at(found).chained;
    at(found).chained = added;
  }
}

template <int D, class Coordinate>
bool BbtsTree<D, Coordinate>::remove(const Key& key, Index object) {
  const Index first = descend(key);
  Index before = none, node = first;
  while (node != none && at(node).object != object) {
    before = node;
    node = at(node).chained;
  }
  if (node == none) return false;

  if (node == first && at(first).chained == none) {
    path_.detach(nodes_, node);
  } else if (node == first) {  // the node of the tree stays where it is and gets the next object
    node = at(first).chained;
    at(first).object = at(node).object;
    at(first).chained = at(node).chained;
  } else {
    at(before).chained = at(node).chained;
  }
  give_up(node);
  return true;
}

template <int D, class Coordinate>
Index BbtsTree<D, Coordinate>::find(const Key& key) const {
  Index current = root();
  while (current != none) {
    const auto order = spatial_order<D, Coordinate>(at(current).key, key);
    if (order == 0) break;
    current = at(current).son[order > 0 ? right : left];
  }
  return current;
}

template <int D, class Coordinate>
template <class Visit>
void BbtsTree<D, Coordinate>::walk(Index subtree, Visit& visit) const {
  if (subtree == none) return;
  walk(at(subtree).son[right], visit);
  visit(subtree);
  walk(at(subtree).son[left], visit);
}

/// Height of the sub-tree whose keys have to lie between the two, or -1 if a promise is broken in it.
template <int D, class Coordinate>
int BbtsTree<D, Coordinate>::inspect(Index subtree, const Key* above_all, const Key* below_all) const {
  if (subtree == none) return 0;
  const Node& node = at(subtree);
  if (above_all != nullptr && spatial_order<D, Coordinate>(node.key, *above_all) >= 0) return -1;
  if (below_all != nullptr && spatial_order<D, Coordinate>(node.key, *below_all) <= 0) return -1;
  const int left_height = inspect(node.son[left], above_all, &node.key);
  const int right_height = inspect(node.son[right], &node.key, below_all);
  if (left_height < 0 || right_height < 0 || node.balance != right_height - left_height) return -1;
  if (node.balance < -1 || node.balance > 1) return -1;
  return (left_height > right_height ? left_height : right_height) + 1;
}

}  // namespace breccia::detection
