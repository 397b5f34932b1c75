#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "detection/balanced_path.hpp"

namespace breccia::detection {

/// Cell of a point. Cells are ordered by z, then y, then x. Source: [Schiava, eq. (6.6)]
struct CellKey {
  std::int32_t z, y, x;
  auto operator<=>(const CellKey&) const = default;
};

/// MS-tree: a balanced binary tree that is a sorted list at the same time. Source: [Schiava, ch. 4 and 6.3]
///
/// A node's left son is greater or equal, its right son smaller or equal; nodes of equal key coexist, in the order in
/// which they were added. The balance of a node, height of its right sub-tree minus height of its left one, is -1, 0 or
/// 1, so n nodes stand at most 1.45 log2(n + 2) high. Every node names the next one in ascending order (C_n of the
/// source), kept up to date by `add` and `remove`. Nodes live in one array and refer to each other by index; a removed
/// node's place is used again. Node numbers stay valid until their node is removed or the tree cleared.
class MsTree {
 public:
  static constexpr Index none = BalancedPath::none;

  MsTree() { clear(); }

  /// Drops all nodes, keeps the storage.
  void clear();
  void reserve(std::size_t num_nodes) { nodes_.reserve(num_nodes + 1); }

  /// Adds a node after all nodes of equal key. Source: algorithm 6.3. O(log n).
  Index add(const CellKey& key, Index object);

  /// Removes the first node that carries both; false if there is none. O(log n + nodes of this key).
  bool remove(const CellKey& key, Index object);

  /// First node of the list whose key is greater, or none. Source: algorithm 6.2. O(log n).
  /// @{
  [[nodiscard]] Index smallest_greater_z(std::int32_t z) const { return smallest_greater({z, INT32_MAX, INT32_MAX}); }
  [[nodiscard]] Index smallest_greater_zy(std::int32_t z, std::int32_t y) const {
    return smallest_greater({z, y, INT32_MAX});
  }
  [[nodiscard]] Index smallest_greater(const CellKey& key) const;
  /// @}

  [[nodiscard]] Index first() const { return first_; }  ///< smallest node
  [[nodiscard]] Index next(Index node) const { return at(node).next; }
  [[nodiscard]] const CellKey& key(Index node) const { return at(node).key; }
  [[nodiscard]] Index object(Index node) const { return at(node).object; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Shape of the tree. `root` is the topmost node that carries a key, none in an empty tree.
  /// @{
  [[nodiscard]] Index root() const { return nodes_[0].son[left]; }
  [[nodiscard]] Index left_son(Index node) const { return at(node).son[left]; }
  [[nodiscard]] Index right_son(Index node) const { return at(node).son[right]; }
  [[nodiscard]] int balance(Index node) const { return at(node).balance; }
  /// @}

 private:
  using enum BalancedPath::Side;
  using Side = BalancedPath::Side;

  struct Node {
    CellKey key;
    Index son[2];
    Index next;
    Index object;
    std::int8_t balance;
  };

  [[nodiscard]] Node& at(Index node) { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const Node& at(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }

  Index new_node(const CellKey& key, Index object);
  [[nodiscard]] Index find(Index subtree, const CellKey& key, Index object);
  [[nodiscard]] Index predecessor_of(Index node) const;

  std::vector<Node> nodes_;  ///< nodes_[0]: the empty node above the root, which is its left son
  BalancedPath path_;
  Index first_ = none;
  Index free_ = none;  ///< places of removed nodes, chained by `next`
  std::size_t size_ = 0;
};

}  // namespace breccia::detection
