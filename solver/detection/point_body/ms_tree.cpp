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
  path_.restart();
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
  path_.attach(nodes_, added);
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

/// First node of the list in the sub-tree with this key and object; the path is extended down to its place.
/// Rotations leave nodes of equal key on both sides of each other, so both sons of an equal node are tried.
Index MsTree::find(Index subtree, const CellKey& key, Index object) {
  if (subtree == none) return none;
  const Node& node = at(subtree);
  if (node.key >= key) {
    path_.push(subtree, right);
    const Index found = find(node.son[right], key, object);
    if (found != none) return found;
    path_.pop();
  }
  if (node.key == key && node.object == object) return subtree;
  if (node.key <= key) {
    path_.push(subtree, left);
    const Index found = find(node.son[left], key, object);
    if (found != none) return found;
    path_.pop();
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
  for (int k = path_.length() - 1; k > 0; --k) {
    if (path_.side(k) == left) return path_.node(k);
  }
  return none;
}

bool MsTree::remove(const CellKey& key, Index object) {
  path_.restart();
  const Index node = find(root(), key, object);
  if (node == none) return false;

  const Index before = predecessor_of(node);
  (before == none ? first_ : at(before).next) = at(node).next;
  path_.detach(nodes_, node);
  at(node).next = free_;
  free_ = node;
  --size_;
  return true;
}

}  // namespace breccia::detection
