#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "detection/point_body/ms_tree.hpp"

namespace breccia::detection::ms_tree_test {
namespace {

/// The tree's rules, checked from the root: sons on their sides, balances equal to the difference of heights and in
/// -1..1, the list equal to the walk in ascending order. Returns the height.
class Inspection {
 public:
  explicit Inspection(const MsTree& tree) : tree_(tree) {
    height_ = visit(tree.root());
    std::vector<Index> list;
    for (Index n = tree.first(); n != MsTree::none && list.size() <= tree.size(); n = tree.next(n)) list.push_back(n);
    EXPECT_EQ(list, ascending_) << "the list is not the walk through the tree";
    EXPECT_EQ(ascending_.size(), tree.size());
    for (std::size_t k = 1; k < ascending_.size(); ++k) {
      EXPECT_LE(tree.key(ascending_[k - 1]), tree.key(ascending_[k])) << "the list is not sorted";
    }
  }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::vector<Index> objects() const {
    std::vector<Index> objects;
    for (const Index n : ascending_) objects.push_back(tree_.object(n));
    return objects;
  }

 private:
  int visit(Index node) {
    if (node == MsTree::none) return 0;
    const Index left = tree_.left_son(node), right = tree_.right_son(node);
    EXPECT_TRUE(left == MsTree::none || tree_.key(left) >= tree_.key(node));
    EXPECT_TRUE(right == MsTree::none || tree_.key(right) <= tree_.key(node));
    const int right_height = visit(right);
    ascending_.push_back(node);
    const int left_height = visit(left);
    EXPECT_EQ(tree_.balance(node), right_height - left_height);
    EXPECT_LE(std::abs(tree_.balance(node)), 1);
    return std::max(left_height, right_height) + 1;
  }

  const MsTree& tree_;
  std::vector<Index> ascending_;
  int height_ = 0;
};

/// A sub-tree of height h whose balances are in -1..1 has at least F(h + 2) - 1 nodes (Fibonacci): the classical bound.
double height_bound(std::size_t n) { return 1.4405 * std::log2(static_cast<double>(n) + 2) - 0.3277; }

CellKey along_x(int x) { return {0, 0, x}; }

std::vector<int> ascending(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<std::vector<int>> adversarial_orders(int n) {
  const std::vector<int> up = ascending(n);
  std::vector<int> down(up.rbegin(), up.rend()), outside_in, inside_out, equal(up.size(), 7), few;
  for (int k = 0; k < n / 2; ++k) {
    outside_in.push_back(k);
    outside_in.push_back(n - 1 - k);
    few.push_back(k % 3);
  }
  inside_out.assign(outside_in.rbegin(), outside_in.rend());
  std::vector<int> shuffled = up;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  return {up, down, outside_in, inside_out, equal, few, shuffled};
}

TEST(MsTree, OrdersCellsByZThenYThenX) {
  EXPECT_LT((CellKey{0, 9, 9}), (CellKey{1, 0, 0}));
  EXPECT_LT((CellKey{1, 0, 9}), (CellKey{1, 1, 0}));
  EXPECT_LT((CellKey{1, 1, -3}), (CellKey{1, 1, -2}));
  EXPECT_LT((CellKey{-2, 5, 5}), (CellKey{-1, 5, 5}));
}

TEST(MsTree, TurnsThreeNodesIntoOneWithTwoSonsInEachOfTheFourCases) {
  for (const std::vector<int>& order : {std::vector{3, 2, 1}, {1, 2, 3}, {3, 1, 2}, {1, 3, 2}}) {
    MsTree tree;
    for (const int x : order) tree.add(along_x(x), x);
    EXPECT_EQ(tree.key(tree.root()).x, 2);
    EXPECT_EQ(tree.key(tree.left_son(tree.root())).x, 3) << "the left son is the greater one";
    EXPECT_EQ(tree.key(tree.right_son(tree.root())).x, 1);
    EXPECT_EQ(tree.balance(tree.root()), 0);
  }
}

TEST(MsTree, StaysBelowTheHeightBoundForAdversarialOrders) {
  for (const std::vector<int>& order : adversarial_orders(20000)) {
    MsTree tree;
    for (const int x : order) tree.add(along_x(x), x);
    EXPECT_LE(Inspection(tree).height(), height_bound(order.size()));
  }
}

TEST(MsTree, HasASortedListAndBalancedNodesAfterEveryInsertion) {
  for (const std::vector<int>& order : adversarial_orders(200)) {
    MsTree tree;
    for (const int x : order) {
      tree.add(along_x(x), x);
      Inspection inspection(tree);
      if (HasFailure()) return;
    }
    ASSERT_EQ(tree.size(), order.size());
  }
}

TEST(MsTree, KeepsNodesOfEqualKeyInTheOrderOfInsertion) {
  std::mt19937 random(2);
  std::vector<std::pair<CellKey, Index>> expected;
  MsTree tree;
  for (Index object = 0; object < 2000; ++object) {
    const CellKey key{static_cast<std::int32_t>(random() % 3) - 1, static_cast<std::int32_t>(random() % 3), 5};
    tree.add(key, object);
    expected.emplace_back(key, object);
  }
  std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Index> objects;
  for (const auto& entry : expected) objects.push_back(entry.second);
  EXPECT_EQ(Inspection(tree).objects(), objects);
}

TEST(MsTree, FindsTheFirstNodeOfTheListThatIsGreater) {
  std::mt19937 random(3);
  const auto draw = [&] { return static_cast<std::int32_t>(random() % 9) - 4; };
  MsTree tree;
  for (Index object = 0; object < 300; ++object) tree.add({draw(), draw(), draw()}, object);
  const auto first_where = [&](const auto& greater) {
    Index n = tree.first();
    while (n != MsTree::none && !greater(tree.key(n))) n = tree.next(n);
    return n;
  };
  for (int k = 0; k < 2000; ++k) {
    const std::int32_t z = draw() + (k % 3 - 1) * 3, y = draw(), x = draw();
    EXPECT_EQ(tree.smallest_greater_z(z), first_where([&](const CellKey& c) { return c.z > z; }));
    EXPECT_EQ(tree.smallest_greater_zy(z, y),
              first_where([&](const CellKey& c) { return std::tuple(c.z, c.y) > std::tuple(z, y); }));
    EXPECT_EQ(tree.smallest_greater({z, y, x}),
              first_where([&](const CellKey& c) { return std::tuple(c.z, c.y, c.x) > std::tuple(z, y, x); }));
  }
}

TEST(MsTree, KeepsListAndBalanceWhenNodesAreRemovedAndAddedAtRandom) {
  std::mt19937 random(4);
  for (const int distinct : {1, 5, 1000}) {
    MsTree tree;
    std::vector<std::pair<int, Index>> model;  // sorted by key, equal keys by age
    for (Index step = 0; step < 1500; ++step) {
      const bool shrink = step >= 750;
      if (!model.empty() && random() % 10 < (shrink ? 7u : 3u)) {
        const auto victim = model.begin() + static_cast<std::ptrdiff_t>(random() % model.size());
        ASSERT_TRUE(tree.remove(along_x(victim->first), victim->second));
        model.erase(victim);
      } else {
        const int x = static_cast<int>(random() % static_cast<unsigned>(distinct));
        tree.add(along_x(x), step);
        const auto place = std::upper_bound(model.begin(), model.end(), x,
                                            [](int key, const auto& entry) { return key < entry.first; });
        model.insert(place, {x, step});
      }
      const Inspection inspection(tree);
      std::vector<Index> objects;
      for (const auto& entry : model) objects.push_back(entry.second);
      ASSERT_EQ(inspection.objects(), objects);
      ASSERT_LE(inspection.height(), std::max(1.0, height_bound(model.size())));
      if (HasFailure()) return;
    }
  }
}

TEST(MsTree, IsEmptyAfterRemovingEverythingFromEitherEnd) {
  for (const bool upwards : {true, false}) {
    MsTree tree;
    for (int x = 0; x < 500; ++x) tree.add(along_x(x), x);
    for (int k = 0; k < 500; ++k) {
      const int x = upwards ? k : 499 - k;
      ASSERT_TRUE(tree.remove(along_x(x), x));
      Inspection inspection(tree);
      if (HasFailure()) return;
    }
    EXPECT_EQ(tree.size(), 0u);
    EXPECT_EQ(tree.first(), MsTree::none);
    EXPECT_EQ(tree.root(), MsTree::none);
  }
}

TEST(MsTree, ChangesNothingWhenTheNodeToRemoveIsAbsent) {
  MsTree tree;
  EXPECT_FALSE(tree.remove(along_x(1), 1));
  for (int x = 0; x < 50; ++x) tree.add(along_x(x / 5), x);
  const std::vector<Index> before = Inspection(tree).objects();
  EXPECT_FALSE(tree.remove(along_x(3), 20));
  EXPECT_FALSE(tree.remove(along_x(99), 3));
  EXPECT_EQ(Inspection(tree).objects(), before);
}

TEST(MsTree, UsesThePlacesOfRemovedNodesAgain) {
  MsTree tree;
  Index largest = 0;
  for (int x = 0; x < 100; ++x) largest = std::max(largest, tree.add(along_x(x), x));
  for (int round = 0; round < 10; ++round) {
    for (int x = 0; x < 100; x += 3) ASSERT_TRUE(tree.remove(along_x(x), x));
    for (int x = 0; x < 100; x += 3) EXPECT_LE(tree.add(along_x(x), x), largest);
  }
  EXPECT_EQ(Inspection(tree).objects(), ascending(100));
}

TEST(MsTree, ForgetsEverythingWhenCleared) {
  MsTree tree;
  for (int x = 0; x < 100; ++x) tree.add(along_x(x), x);
  tree.clear();
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_EQ(tree.smallest_greater_z(-5), MsTree::none);
  tree.add(along_x(4), 17);
  EXPECT_EQ(Inspection(tree).objects(), std::vector<Index>{17});
}

}  // namespace
}  // namespace breccia::detection::ms_tree_test
