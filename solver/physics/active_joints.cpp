#include "physics/active_joints.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace breccia {
namespace {

/// All are sorted again when a quarter of them was added or removed, or so many of a short list.
constexpr std::size_t kSortFraction = 4, kLeastChanges = 64;

std::size_t block_of(Index place) { return at(place / kLanes); }
std::size_t lane_of(Index place) { return at(place % kLanes); }

/// Calls f(number of the joint, its row) for all that the joint remembers.
template <class Joint, class Rows, class F>
void for_each_row(Joint& joint, Rows& rows, F&& f) {
  const auto pair = [&](const JointNumber&, auto& number, auto& row) { f(number, row); };
  for (std::size_t i = 0; i < 3; ++i) for_each_number(pair, joint.points[i], rows.points[i]);
  for_each_common_number(pair, joint, rows);
}

void set_joint(const ActiveJoint& joint, std::size_t lane, JointBlock& block) {
  for_each_row(joint.history, block.history, [&](double x, JointRow& row) { row[lane] = x; });
  block.news[lane] = static_cast<std::uint8_t>(joint.elastic ? kElastic : 0);
}

void get_joint(const JointBlock& block, std::size_t lane, ActiveJoint& joint) {
  for_each_row(joint.history, block.history, [&](double& x, const JointRow& row) { x = row[lane]; });
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
    double& failed = block.history.failed[lane];
    if (failed > 0 || !std::binary_search(ids.begin(), ids.end(), identity(place).id)) continue;
    failed = kFailsNext;
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
  if (changes_ < std::max(kLeastChanges, size() / kSortFraction)) return;
  put_in_order();
  changes_ = 0;
}

}  // namespace breccia
