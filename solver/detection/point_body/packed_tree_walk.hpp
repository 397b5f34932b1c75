#pragma once

#include "detection/point_body/packed_tree_kernel.hpp"

namespace breccia::detection {
namespace {

/// The walk of a packed tree, level by level. Nothing branches on a box: the children that are met are written behind
/// those found so far by their bit mask.
///
/// Lanes: what an instruction set does with eight boxes or points,
///   Box(query):           unsigned meets(const float* group)              bit k: box k of the group meets the query's
///   Body(query):          unsigned holds(const double* leaf)              bit k: point k of the leaf is a couple
///   number(first, mask, to):   to = first + each bit that is set;  choose(from, mask, to):  to = from[each bit that is
///   set];
///                         eight are written, those behind the last are of no meaning
template <class Lanes>
std::size_t walk_to_leaves(const PackedTreeView& tree, const PackedQuery& query, PackedFrontier& frontier) {
  if (tree.num_levels == 0) return 0;
  const typename Lanes::Box box(query);
  std::uint32_t* now = frontier.now;
  std::uint32_t* next = frontier.next;
  std::size_t count = 1;
  now[0] = 0;
  for (int level = tree.num_levels - 1; level >= 0 && count > 0; --level) {
    const float* const groups = tree.boxes + 48 * tree.level[level];
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t group = now[i];
      const unsigned mask = box.meets(groups + std::size_t{48} * group);
      Lanes::number(8 * group, mask, next + found);
      found += static_cast<std::size_t>(__builtin_popcount(mask));
    }
    std::uint32_t* const done = now;
    now = next;
    next = done;
    count = found;
  }
  frontier = {now, next};
  return count;
}

template <class Lanes>
std::size_t points_of_leaves(const PackedTreeView& tree, const PackedQuery& query, const std::uint32_t* leaves,
                             std::size_t count, std::int32_t* hits) {
  const typename Lanes::Body body(query);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned mask = body.holds(tree.leaves + std::size_t{24} * leaves[i]);
    Lanes::choose(tree.points + std::size_t{8} * leaves[i], mask, hits + found);
    found += static_cast<std::size_t>(__builtin_popcount(mask));
  }
  return found;
}

}  // namespace
}  // namespace breccia::detection
