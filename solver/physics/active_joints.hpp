#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "physics/active_joint.hpp"

namespace breccia {

/// The active list: joints in ascending order of their ids. Each stays in its place in memory while others come and go, since
/// in a breaking body some do in almost every step.
class ActiveJoints {
 public:
  template <class Joint, class Pool>
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = ActiveJoint;
    using difference_type = std::ptrdiff_t;
    using pointer = Joint*;
    using reference = Joint&;

    Iterator() = default;
    Iterator(Pool* pool, const Index* place) : pool_(pool), place_(place) {}
    Joint& operator*() const { return (*pool_)[static_cast<std::size_t>(*place_)]; }
    Joint* operator->() const { return &**this; }
    Iterator& operator++() {
      ++place_;
      return *this;
    }
    Iterator operator++(int) { return std::exchange(*this, Iterator(pool_, place_ + 1)); }
    bool operator==(const Iterator& other) const { return place_ == other.place_; }

   private:
    Pool* pool_ = nullptr;
    const Index* place_ = nullptr;
  };

  ActiveJoints() = default;
  /// @param joints  ascending by id
  explicit ActiveJoints(const std::vector<ActiveJoint>& joints) { insert(joints); }

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] bool empty() const { return order_.empty(); }
  [[nodiscard]] ActiveJoint& operator[](std::size_t i) { return pool_[static_cast<std::size_t>(order_[i])]; }
  [[nodiscard]] const ActiveJoint& operator[](std::size_t i) const { return pool_[static_cast<std::size_t>(order_[i])]; }
  [[nodiscard]] auto begin() { return Iterator<ActiveJoint, std::vector<ActiveJoint>>(&pool_, order_.data()); }
  [[nodiscard]] auto end() { return Iterator<ActiveJoint, std::vector<ActiveJoint>>(&pool_, order_.data() + order_.size()); }
  [[nodiscard]] auto begin() const { return Iterator<const ActiveJoint, const std::vector<ActiveJoint>>(&pool_, order_.data()); }
  [[nodiscard]] auto end() const {
    return Iterator<const ActiveJoint, const std::vector<ActiveJoint>>(&pool_, order_.data() + order_.size());
  }

  /// @param batch  ascending by id, none of them on the list. O(list + batch), 4 B a joint of the list are moved.
  void insert(const std::vector<ActiveJoint>& batch) {
    const auto middle = static_cast<std::ptrdiff_t>(order_.size());
    for (const ActiveJoint& joint : batch) order_.push_back(keep(joint));
    std::inplace_merge(order_.begin(), order_.begin() + middle, order_.end(),
                       [&](Index a, Index b) { return pool_[static_cast<std::size_t>(a)].id < pool_[static_cast<std::size_t>(b)].id; });
  }

  /// Takes the joints off the list for which leaves(joint). O(list).
  template <class Leaves>
  void erase_if(Leaves&& leaves) {
    std::erase_if(order_, [&](Index place) {
      if (!leaves(std::as_const(pool_[static_cast<std::size_t>(place)]))) return false;
      vacant_.push_back(place);
      return true;
    });
  }

 private:
  Index keep(const ActiveJoint& joint) {
    if (vacant_.empty()) {
      pool_.push_back(joint);
      return static_cast<Index>(pool_.size() - 1);
    }
    const Index place = vacant_.back();
    vacant_.pop_back();
    pool_[static_cast<std::size_t>(place)] = joint;
    return place;
  }

  std::vector<ActiveJoint> pool_;
  std::vector<Index> order_;   ///< places in the pool, by ascending id
  std::vector<Index> vacant_;  ///< places free again
};

}  // namespace breccia
