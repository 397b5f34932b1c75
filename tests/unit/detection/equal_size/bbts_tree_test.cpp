#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "detection/equal_size/bbts_tree.hpp"

namespace breccia::detection::bbts_tree_test {
namespace {

using Tree = BbtsTree<3, std::int16_t>;
using Key = Tree::Key;

struct Before {
  bool operator()(const Key& a, const Key& b) const { return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]); }
};
using Oracle = std::multimap<Key, Index, Before>;

/// Cells with their objects, sorted: by z, y, x as std::multimap has them, the objects of a cell by number.
using Content = std::vector<std::pair<Key, std::vector<Index>>>;

Content content_of(const Tree& tree) {
  Content content;
  tree.for_each_cell([&](Index first) {
    content.push_back({tree.key(first), {}});
    std::vector<Index>& objects = content.back().second;
    for (Index n = first; n != Tree::none; n = tree.next_in_cell(n)) {
      EXPECT_EQ(tree.key(n), tree.key(first)) << "a node is chained to another cell";
      objects.push_back(tree.object(n));
    }
    std::sort(objects.begin(), objects.end());
  });
  return content;
}

Content content_of(const Oracle& oracle) {
  Content content;
  for (const auto& [key, object] : oracle) {
    if (content.empty() || content.back().first != key) content.push_back({key, {}});
    content.back().second.push_back(object);
  }
  for (auto& cell : content) std::sort(cell.second.begin(), cell.second.end());
  return content;
}

/// A tree and std::multimap told the same; compared after every change.
class Twins {
 public:
  void add(const Key& key, Index object) {
    tree_.add(key, object);
    oracle_.emplace(key, object);
    compare(key);
  }
  void remove(const Key& key, Index object) {
    const auto [begin, end] = oracle_.equal_range(key);
    const auto entry = std::find_if(begin, end, [&](const auto& e) { return e.second == object; });
    ASSERT_EQ(tree_.remove(key, object), entry != end);
    if (entry != end) oracle_.erase(entry);
    compare(key);
  }
  [[nodiscard]] const Tree& tree() const { return tree_; }

 private:
  void compare(const Key& changed) const {
    ASSERT_TRUE(tree_.is_ordered_and_balanced());
    ASSERT_EQ(tree_.size(), oracle_.size());
    ASSERT_EQ(content_of(tree_), content_of(oracle_));
    ASSERT_EQ(tree_.find(changed) != Tree::none, oracle_.contains(changed));
  }

  Tree tree_;
  Oracle oracle_;
};

Key key_of(int x, int y = 0, int z = 0) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(z)};
}

constexpr int num_objects = 600;

/// Keys of the sequences asked for: numbered lines, random cells of the whole type, and a few cells with many objects.
std::vector<std::pair<const char*, std::vector<Key>>> sequences() {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> whole(INT16_MIN, INT16_MAX), few(-2, 1);
  std::vector<Key> up, anywhere, clustered, columns;
  for (int k = 0; k < num_objects; ++k) {
    up.push_back(key_of(k % 10, k / 10 % 10, k / 100));
    anywhere.push_back(key_of(whole(random), whole(random), whole(random)));
    clustered.push_back(key_of(few(random), few(random), few(random)));
    columns.push_back(key_of(k / 100, k / 10 % 10, k % 10));
  }
  std::vector<Key> down(up.rbegin(), up.rend());
  return {
      {"ascending", up}, {"descending", down}, {"random", anywhere}, {"clustered", clustered}, {"x-major", columns}};
}

TEST(BbtsTree, OrdersCellsByZThenYThenX) {
  const auto order = spatial_order<3, std::int16_t>;
  EXPECT_TRUE(order(key_of(9, 9, 0), key_of(0, 0, 1)) < 0);
  EXPECT_TRUE(order(key_of(9, 0, 1), key_of(0, 1, 1)) < 0);
  EXPECT_TRUE(order(key_of(-3, 1, 1), key_of(-2, 1, 1)) < 0);
  EXPECT_TRUE(order(key_of(INT16_MIN), key_of(INT16_MAX)) < 0);
  EXPECT_TRUE(order(key_of(4, 5, 6), key_of(4, 5, 6)) == 0);
}

TEST(BbtsTree, IsOrderedBalancedAndCompleteAfterEveryInsertionAndEveryDeletion) {
  for (const auto& [name, keys] : sequences()) {
    for (const bool backwards : {false, true}) {
      SCOPED_TRACE(std::string(name) + (backwards ? ", last in first out" : ", first in first out"));
      Twins twins;
      for (std::size_t k = 0; k < keys.size(); ++k) {
        ASSERT_NO_FATAL_FAILURE(twins.add(keys[k], static_cast<Index>(k)));
      }
      for (std::size_t k = 0; k < keys.size(); ++k) {
        const std::size_t gone = backwards ? keys.size() - 1 - k : k;
        ASSERT_NO_FATAL_FAILURE(twins.remove(keys[gone], static_cast<Index>(gone)));
      }
      EXPECT_EQ(twins.tree().size(), 0U);
    }
  }
}

TEST(BbtsTree, IsOrderedBalancedAndCompleteWhileInsertionsAndDeletionsMix) {
  for (const int width : {1, 2, 6, 40}) {
    SCOPED_TRACE(width);
    std::mt19937 random(static_cast<unsigned>(width));
    std::uniform_int_distribution<int> coordinate(-width, width - 1);
    Twins twins;
    std::vector<std::pair<Key, Index>> present;
    for (Index k = 0; k < 3000; ++k) {
      // Grows to about 200 objects, then shrinks and grows again: all heights are seen from both sides.
      const bool grow = present.size() < 2 || random() % 100 < (k / 400 % 2 == 0 ? 75U : 30U);
      if (grow) {
        const Key key = key_of(coordinate(random), coordinate(random), coordinate(random));
        present.emplace_back(key, k);
        ASSERT_NO_FATAL_FAILURE(twins.add(key, k));
      } else {
        std::swap(present[random() % present.size()], present.back());
        ASSERT_NO_FATAL_FAILURE(twins.remove(present.back().first, present.back().second));
        present.pop_back();
      }
    }
  }
}

TEST(BbtsTree, DoesNotRemoveAnObjectFromACellItIsNotIn) {
  Twins twins;
  for (Index k = 0; k < 20; ++k) twins.add(key_of(k % 5), k);
  ASSERT_NO_FATAL_FAILURE(twins.remove(key_of(1), 2));
  ASSERT_NO_FATAL_FAILURE(twins.remove(key_of(7), 2));
  EXPECT_EQ(twins.tree().size(), 20U);
}

TEST(BbtsTree, UsesThePlacesOfRemovedObjectsAgain) {
  Tree tree;
  tree.reserve(100);
  const std::size_t bytes = tree.bytes();
  for (Index k = 0; k < 100; ++k) tree.add(key_of(k % 13), k);
  for (Index k = 100; k < 1000; ++k) {
    ASSERT_TRUE(tree.remove(key_of((k - 100) % 13), k - 100));
    tree.add(key_of(k % 13), k);
  }
  EXPECT_EQ(tree.bytes(), bytes);
}

TEST(BbtsTree, NeedsNoMoreMemoryThanPublished) {
  constexpr std::size_t published_bytes = 40;  // an object with 16-bit coordinates, eq. (4.16)
  constexpr std::size_t n = 1000;
  Tree tree;
  tree.reserve(n);
  for (std::size_t k = 0; k < n; ++k) tree.add(key_of(static_cast<int>(k)), static_cast<Index>(k));
  EXPECT_LE(tree.bytes(), published_bytes * n);
}

}  // namespace
}  // namespace breccia::detection::bbts_tree_test
