#include "detection/point_body/ms_tree.hpp"

namespace breccia::detection {

void MsTree::clear() {
  nodes_.clear();
  nodes_.push_back({{0, 0, 0}, {none, none}, none, none, 0});
  first_ = none;
  free_ = none;
  size_ = 0;
}

Index MsTree::smallest_greater(const CellKey& key) const {
  Index found = none;
  Index current = root();
  while (current != none) {
    const Node& node = at(current);
    if (node.key > key) {
      found = current;
      current = node.son[right];
    } else {
      current = node.son[left];
    }
  }
  return found;
}

Index MsTree::add(const CellKey& key, Index object) {
  Index smallest_greater = none, biggest_smaller = none;
  path_.clear();
  path_.push(0, left);
  Index current = root();
  while (current != none) {
    const bool greater = at(current).key > key;
    (greater ? smallest_greater : biggest_smaller) = current;
    const Side side = greater ? right : left;
    path_.push(current, side);
    current = at(current).son[side];
  }

  const Index added = new_node(key, object);
  at(added).next = smallest_greater;
  (biggest_smaller == none ? first_ : at(biggest_smaller).next) = added;
  at(path_.node[path_.length - 1]).son[path_.side[path_.length - 1]] = added;
  retrace_added();
  return added;
}

Index MsTree::new_node(const CellKey& key, Index object) {
  ++size_;
  const Node node{key, {none, none}, none, object, 0};
  if (free_ == none) {
    nodes_.push_back(node);
    return static_cast<Index>(nodes_.size() - 1);
  }
  const Index place = free_;
  free_ = at(place).next;
  at(place) = node;
  return place;
}

/// A sub-tree below the path has grown by one level: balances up to the node that absorbs it.
void MsTree::retrace_added() {
  for (int k = path_.length - 1; k > 0; --k) {
    Node& node = at(path_.node[k]);
    node.balance = static_cast<std::int8_t>(node.balance + weight(path_.side[k]));
    if (node.balance == 0) return;
    if (node.balance == 1 || node.balance == -1) continue;
    at(path_.node[k - 1]).son[path_.side[k - 1]] = rotate(path_.node[k]).first;
    return;
  }
}

/// A sub-tree below the path has lost one level.
void MsTree::retrace_removed() {
  for (int k = path_.length - 1; k > 0; --k) {
    Node& node = at(path_.node[k]);
    node.balance = static_cast<std::int8_t>(node.balance - weight(path_.side[k]));
    if (node.balance == 1 || node.balance == -1) return;
    if (node.balance == 0) continue;
    const auto [top, lower] = rotate(path_.node[k]);
    at(path_.node[k - 1]).son[path_.side[k - 1]] = top;
    if (!lower) return;
  }
}

/// Turns the sub-tree of an unbalanced node towards its shorter side: cases 1 to 4 of table 4.3, the mirrored ones in one,
/// with `heavy` the side of the higher sub-tree. Returns the new top and whether the sub-tree is lower than before.
std::pair<Index, bool> MsTree::rotate(Index i) {
  const Side heavy = at(i).balance > 0 ? right : left;
  const Side light = other(heavy);
  const int sign = weight(heavy);
  const Index j = at(i).son[heavy];
  const int balance_j = at(j).balance;

  if (balance_j != -sign) {  // cases 1 and 2: eq. (4.22), (4.23), (4.27), (4.28)
    at(i).son[heavy] = at(j).son[light];
    at(j).son[light] = i;
    at(i).balance = static_cast<std::int8_t>(sign - balance_j);
    at(j).balance = static_cast<std::int8_t>(balance_j - sign);
    return {j, balance_j != 0};
  }

  const Index k = at(j).son[light];  // cases 3 and 4: eq. (4.31) to (4.36)
  const int balance_k = at(k).balance;
  at(i).son[heavy] = at(k).son[light];
  at(j).son[light] = at(k).son[heavy];
  at(k).son[light] = i;
  at(k).son[heavy] = j;
  at(i).balance = static_cast<std::int8_t>(balance_k == sign ? -sign : 0);
  at(j).balance = static_cast<std::int8_t>(balance_k == -sign ? sign : 0);
  at(k).balance = 0;
  return {k, true};
}

/// First node of the list in the sub-tree with this key and object; the path is extended down to its place.
/// Rotations leave nodes of equal key on both sides of each other, so both sons of an equal node are tried.
Index MsTree::find(Index subtree, const CellKey& key, Index object) {
  if (subtree == none) return none;
  const Node& node = at(subtree);
  if (node.key >= key) {
    path_.push(subtree, right);
    const Index found = find(node.son[right], key, object);
    if (found != none) return found;
    --path_.length;
  }
  if (node.key == key && node.object == object) return subtree;
  if (node.key <= key) {
    path_.push(subtree, left);
    const Index found = find(node.son[left], key, object);
    if (found != none) return found;
    --path_.length;
  }
  return none;
}

/// Node before `node` in the list. @pre the path leads to `node`
Index MsTree::predecessor_of(Index node) const {
  Index below = at(node).son[right];
  if (below != none) {
    while (at(below).son[left] != none) below = at(below).son[left];
    return below;
  }
  for (int k = path_.length - 1; k > 0; --k) {
    if (path_.side[k] == left) return path_.node[k];
  }
  return none;
}

bool MsTree::remove(const CellKey& key, Index object) {
  path_.clear();
  path_.push(0, left);
  const Index node = find(root(), key, object);
  if (node == none) return false;

  const Index before = predecessor_of(node);
  (before == none ? first_ : at(before).next) = at(node).next;
  unlink(node);
  retrace_removed();
  at(node).next = free_;
  free_ = node;
  --size_;
  return true;
}

/// Takes `node` out of the tree; a node with two sons is replaced by the next smaller one. Leaves the path at the place
/// where a level was lost. @pre the path leads to `node`
void MsTree::unlink(Index node) {
  const int place = path_.length;  // of the node, if it were on the path
  const Index above = path_.node[place - 1];
  const Side side = path_.side[place - 1];
  if (at(node).son[left] == none || at(node).son[right] == none) {
    at(above).son[side] = at(node).son[left] != none ? at(node).son[left] : at(node).son[right];
    return;
  }

  path_.push(node, right);
  Index heir = at(node).son[right];
  while (at(heir).son[left] != none) {
    path_.push(heir, left);
    heir = at(heir).son[left];
  }
  at(path_.node[path_.length - 1]).son[path_.side[path_.length - 1]] = at(heir).son[right];
  at(heir).son[left] = at(node).son[left];
  at(heir).son[right] = at(node).son[right];
  at(heir).balance = at(node).balance;
  at(above).son[side] = heir;
  path_.node[place] = heir;
}

}  // namespace breccia::detection
