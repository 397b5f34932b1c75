#include "physics/active_joints.hpp"

#include <algorithm>

#include "physics/joint_history.hpp"

namespace breccia {
namespace {

namespace jp = joint_point;

/// All are put in order again when as many have come or gone as a quarter of them, or so many of a short list.
constexpr std::size_t kUntidy = 4, kFew = 64;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t block_of(Index place) { return at(place / kLanes); }
std::size_t lane_of(Index place) { return at(place % kLanes); }

/// Calls f(number, row) for all numbers of a joint.
template <class Numbers, class Block, class F>
void for_each_row(Numbers& numbers, Block& block, F&& f) {
  for (std::size_t i = 0; i < 3; ++i) {
    jp::for_each_number(numbers.points[i], block.points[i], f);
    f(numbers.tilt[i], block.tilt[i]);
    f(numbers.normal[i], block.normal[i]);
  }
  f(numbers.area, block.area);
  f(numbers.mode_1, block.mode_1);
  f(numbers.mode_2, block.mode_2);
  f(numbers.friction, block.friction);
  f(numbers.turned, block.turned);
  f(numbers.failed, block.failed);
}

void set_joint(const ActiveJoint& joint, std::size_t lane, JointBlock& block) {
  const jp::Joint<double> numbers = jp::joint_of(joint);
  for_each_row(numbers, block, [&](double x, JointRow& row) { row[lane] = x; });
  block.news[lane] = static_cast<std::uint8_t>(joint.elastic ? kElastic : 0);
}

void get_joint(const JointBlock& block, std::size_t lane, ActiveJoint& joint) {
  jp::Joint<double> numbers;
  for_each_row(numbers, block, [&](double& x, const JointRow& row) { x = row[lane]; });
  jp::set_numbers(numbers, joint);
  joint.state = numbers.failed > 0 ? JointState::failed : JointState::holding;
  joint.elastic = (block.news[lane] & kElastic) != 0;
}

}  // namespace

const ActiveJoint ActiveJoints::operator[](std::size_t i) const {
  const Index place = order_[i];
  const Identity& who = identity(place);
  ActiveJoint joint;
  joint.id = who.id;
  joint.slot_a = who.slot_a;
  joint.slot_b = who.slot_b;
  joint.face_a = who.face_a;
  joint.code = who.code;
  joint.time_of_failure = who.time_of_failure;
  joint.law = law(place / kLanes);
  get_joint(blocks_[block_of(place)], lane_of(place), joint);
  return joint;
}

void ActiveJoints::insert(std::span<const ActiveJoint> batch) {
  const auto middle = static_cast<std::ptrdiff_t>(order_.size());
  for (const ActiveJoint& joint : batch) order_.push_back(keep(joint));
  std::inplace_merge(order_.begin(), order_.begin() + middle, order_.end(),
                     [&](Index a, Index b) { return identity(a).id < identity(b).id; });
  note_changes(batch.size());
}

void ActiveJoints::erase(std::span<const GlobalId> ids) {
  if (ids.empty()) return;
  auto next = ids.begin();
  std::erase_if(order_, [&](Index place) {
    if (next == ids.end() || identity(place).id != *next) return false;
    ++next;
    vacant_[at(kinds_[block_of(place)])].push_back(place);
    return true;
  });
  note_changes(ids.size());
}

void ActiveJoints::break_points(std::span<const GlobalId> ids) {
  for (const Index place : order_) {
    JointBlock& block = blocks_[block_of(place)];
    const std::size_t lane = lane_of(place);
    if (block.failed[lane] > 0 || !std::binary_search(ids.begin(), ids.end(), identity(place).id)) continue;
    for (JointPointRows& rows : block.points) rows.damage[lane] = 1.0;
  }
}

Index ActiveJoints::vacant_place(Index kind) {
  if (vacant_.size() <= at(kind)) vacant_.resize(at(kind) + 1);
  std::vector<Index>& vacant = vacant_[at(kind)];
  if (vacant.empty()) {
    const auto first = static_cast<Index>(identity_.size());
    blocks_.emplace_back();
    kinds_.push_back(kind);
    identity_.resize(identity_.size() + at(kLanes));
    for (Index lane = kLanes; lane > 0; --lane) vacant.push_back(first + lane - 1);
  }
  const Index place = vacant.back();
  vacant.pop_back();
  return place;
}

Index ActiveJoints::keep(const ActiveJoint& joint) {
  const Index place = vacant_place(2 * joint.law + (joint.damage() > 0 ? 1 : 0));
  identity_[at(place)] = {joint.id, joint.slot_a, joint.slot_b, joint.face_a, joint.code, joint.time_of_failure};
  set_joint(joint, lane_of(place), blocks_[block_of(place)]);
  newcomers_.push_back(place);
  return place;
}

/// Neighbours by id are mostly neighbours in space: in this order the kernel finds their nodes close together.
void ActiveJoints::put_in_order() {
  const std::vector<ActiveJoint> all(begin(), end());
  *this = ActiveJoints();
  for (const ActiveJoint& joint : all) order_.push_back(keep(joint));
}

void ActiveJoints::note_changes(std::size_t number) {
  changes_ += number;
  if (changes_ < std::max(kFew, size() / kUntidy)) return;
  put_in_order();
  changes_ = 0;
}

}  // namespace breccia
