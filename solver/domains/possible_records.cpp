#include "domains/possible_records.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>

#include "base/error.hpp"
#include "domains/piece_mesh.hpp"
#include "model/strength_scatter.hpp"
#include "physics/contact/geometry/point.hpp"

namespace breccia {
namespace {

constexpr std::int64_t kFaces = 4, kCorners = 4, kAxes = 3;
constexpr std::int64_t kCodes = 12;  // FaceLink::code

bool within(std::int64_t index, std::int64_t size) { return 0 <= index && index < size; }

template <class T>
bool within(std::int64_t index, const std::vector<T>& list) {
  return within(index, std::ssize(list));
}

template <class List, class Test>
bool all(const List& list, Test test) {
  return std::all_of(list.begin(), list.end(), test);
}

bool is_possible(const ElementRecord& r, const WholeModel& whole) {
  return within(r.id, whole.num_elements) && within(r.group, whole.volume_groups) &&
         within(r.body, whole.body_length) && all(r.vertex, [](GlobalId node) { return node >= 0; }) &&
         all(r.neighbour, [&](GlobalId element) { return element < whole.num_elements; }) &&
         all(r.code, [](std::int8_t code) { return within(code, kCodes); }) && r.field.sides >= 0 &&
         num_planes(r.field.sides) <= kMostSides;
}

bool is_possible(const JointRecord& r, const WholeModel& whole) {
  return within(r.other, whole.num_elements) && within(r.joint.face_a, kFaces) && within(r.joint.code, kCodes) &&
         within(r.joint.law, whole.num_joint_laws());
}

bool is_possible(const OffsetRecord& r, const Records& records) {
  return records.place_of(r.element) >= 0 && r.point / kPointsAnElement == r.element && r.point >= 0;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(Problem{file.string(), 0, "checkpoint", "this checkpoint is damaged: " + what,
                           "a checkpoint that `breccia run` has written", ""});
}

}  // namespace

bool are_possible(const Records& records, const WholeModel& whole) {
  const auto is_pair = [&](const WholeModel::JointGroups& groups) {
    return within(groups.a, whole.volume_groups) && within(groups.b, whole.volume_groups) && groups.num_classes >= 0 &&
           groups.num_classes <= 2 * kMostStrengthClasses + 1 && std::abs(groups.least_class) <= kMostStrengthClasses;
  };
  const bool sets_fit = whole.node_sets.empty() || whole.node_sets.size() == whole.volume_groups.size();
  return sets_fit && all(whole.node_sets, [&](Index set) { return within(set, whole.volume_groups); }) &&
         all(whole.joint_groups, is_pair) &&
         all(records.elements, [&](const ElementRecord& r) { return is_possible(r, whole); }) &&
         all(records.joints, [&](const JointRecord& r) { return is_possible(r, whole); }) &&
         all(records.released, [](const ReleasedRecord& r) { return within(r.joint.face_a, kFaces); }) &&
         all(records.couples, [&](const CoupleRecord& r) { return within(r.contactor, whole.num_elements); }) &&
         all(records.offsets, [&](const OffsetRecord& r) { return is_possible(r, records); }) &&
         all(records.holds,
             [](const HoldRecord& r) { return within(r.corner, kCorners) && within(r.axis, kAxes) && r.entry >= 0; }) &&
         all(records.held, [](const HeldRecord& r) { return within(r.corner, kCorners); }) &&
         all(records.faces,
             [&](const FaceTag& tag) { return within(tag.group, whole.surface_groups) && within(tag.face, kFaces); }) &&
         all(records.corners, [&](const CornerTag& tag) {
           return within(tag.group, std::ssize(whole.surface_groups) + std::ssize(whole.node_groups) +
                                        std::ssize(whole.element_sets));
         });
}

void demand_possible(const std::filesystem::path& file, std::span<const std::byte> whole_model,
                     const Records& records) {
  bool possible = false;
  try {
    possible = are_possible(records, unpack_whole(whole_model));
  } catch (const std::exception&) {  // the bytes end too early, or state a larger size
  }
  if (!possible) refuse(file, "its indices exceed its model");
}

void demand_constraints(const std::filesystem::path& file, const Records& records, const case_::Stage& stage) {
  const std::int64_t number = std::ssize(stage.constraints);
  if (all(records.holds, [&](const HoldRecord& r) { return within(r.entry, number); })) return;
  refuse(file, "it holds nodes by a constraint that its stage does not have");
}

}  // namespace breccia
