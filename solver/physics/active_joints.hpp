#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "physics/active_joint.hpp"
#include "physics/joint_block.hpp"

namespace breccia {

/// The active list: joints in ascending order of their ids. They are stored in blocks of eight of one law, by rows, for
/// the kernel, joints that arrive with damage and without in separate blocks; a joint is read and added as an
/// ActiveJoint. Each keeps its place in memory while others are added and removed, which happens in almost every step
/// of a breaking body, until after many changes all are sorted again.
class ActiveJoints {
 public:
  /// What the kernel need not know of a joint.
  struct Identity {
    GlobalId id = 0;
    Index slot_a = 0, slot_b = 0;
    std::int8_t face_a = 0, code = 0;
    double time_of_failure = -1;
  };

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = ActiveJoint;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = const ActiveJoint;

    Iterator(const ActiveJoints* joints, std::size_t i) : joints_(joints), i_(i) {}
    const ActiveJoint operator*() const { return (*joints_)[i_]; }
    Iterator& operator++() {
      ++i_;
      return *this;
    }
    void operator++(int) { ++i_; }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }

   private:
    const ActiveJoints* joints_;
    std::size_t i_;
  };

  ActiveJoints() = default;
  /// @param joints  ascending by id
  explicit ActiveJoints(std::span<const ActiveJoint> joints) { insert(joints); }

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] bool empty() const { return order_.empty(); }
  /// A copy of the i-th joint: some 90 numbers.
  [[nodiscard]] const ActiveJoint operator[](std::size_t i) const;
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

  /// @param batch  ascending by id, none of them on the list. O(list + batch): 4 B a joint of the list are moved,
  /// seldom all of it.
  void insert(std::span<const ActiveJoint> batch);
  /// Takes joints off the list. @param ids  ascending, all of them on the list. O(list), none when there are none
  void erase(std::span<const GlobalId> ids);
  /// Joints that have not failed fail at their next evaluation and release their forces (active_joint_forces).
  /// @param ids  ascending; those that are not on the list do not matter. O(list)
  void break_points(std::span<const GlobalId> ids);

  // For the kernel and its caller. A place is a lane of a block: kLanes block + lane.
  [[nodiscard]] std::span<const Index> order() const { return order_; }  ///< places by ascending id
  [[nodiscard]] std::span<JointBlock> blocks() { return blocks_; }
  [[nodiscard]] Index law(Index block) const { return kinds_[static_cast<std::size_t>(block)] / 2; }
  [[nodiscard]] Identity& identity(Index place) { return identity_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] const Identity& identity(Index place) const { return identity_[static_cast<std::size_t>(place)]; }
  /// Places taken since the last call: their nodes are not in the blocks yet.
  [[nodiscard]] std::vector<Index> take_newcomers() { return std::exchange(newcomers_, {}); }

 private:
  [[nodiscard]] Index vacant_place(Index kind);
  [[nodiscard]] Index keep(const ActiveJoint& joint);
  void put_in_order();
  void note_changes(std::size_t number);

  std::vector<JointBlock> blocks_;
  std::vector<Index> kinds_;                ///< (blocks) 2 law, + 1: the joints came with damage
  std::vector<Identity> identity_;          ///< (places)
  std::vector<Index> order_;                ///< places by ascending id
  std::vector<std::vector<Index>> vacant_;  ///< by kind: places that are free, the next to be taken last
  std::vector<Index> newcomers_;
  std::size_t changes_ = 0;  ///< joints that were added or removed since the last sort
};

}  // namespace breccia
