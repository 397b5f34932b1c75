#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "physics/contact/state.hpp"
#include "physics/joint_forces.hpp"
#include "state/element_fields.hpp"
#include "state/field_table.hpp"

namespace breccia {

// The table of fields. What changes between two steps is declared here, entity by entity, and nowhere listed again:
// messages between ranks, the state hash and checkpoints are walks over these tables. Entities are known by global ids;
// every record travels with an element, the first member of all but ElementRecord.

/// An element with its four nodes: what it is in the mesh, and its state.
struct ElementRecord {
  GlobalId id = 0;
  std::int64_t source_id = 0;
  Index group = 0, body = 0;
  std::array<GlobalId, 4> vertex{};                                          ///< mesh nodes of the corners
  std::array<GlobalId, 4> neighbour{};                                       ///< by face, -1: free
  std::array<std::int8_t, 4> code{};                                         ///< FaceLink::code
  std::uint8_t torn = 0;                                                     ///< a bit a face (model/torn_faces.hpp)
  std::uint8_t released = 0;                                                 ///< a bit a face: freed by fracture
  std::uint8_t contactor = 0;                                                ///< 1: others may touch it
  std::array<std::array<double, 3>, 4> reference{}, position{}, velocity{};  ///< of the corners, m, m/s
  FieldValues field{};                                                       ///< overlap field
  ElementNumbers numbers{};                                                  ///< state/element_fields.hpp
  std::array<double, 4> damping{};                                           ///< J so far, by corner
};
template <>
struct FieldTable<ElementRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"id", "1", kState, [](auto& r) -> auto& { return r.id; }},
      FieldRow{"source_id", "1", kNotHashed, [](auto& r) -> auto& { return r.source_id; }},
      FieldRow{"group", "1", kNotHashed, [](auto& r) -> auto& { return r.group; }},
      FieldRow{"body", "1", kNotHashed, [](auto& r) -> auto& { return r.body; }},
      FieldRow{"vertex", "1", kNotHashed, [](auto& r) -> auto& { return r.vertex; }},
      FieldRow{"neighbour", "1", kNotHashed, [](auto& r) -> auto& { return r.neighbour; }},
      FieldRow{"code", "1", kNotHashed, [](auto& r) -> auto& { return r.code; }},
      FieldRow{"torn_faces", "1", kNotHashed, [](auto& r) -> auto& { return r.torn; }},
      FieldRow{"reference", "m", kNotHashed, [](auto& r) -> auto& { return r.reference; }},
      FieldRow{"position", "m", kState, [](auto& r) -> auto& { return r.position; }},
      FieldRow{"velocity", "m/s", kState, [](auto& r) -> auto& { return r.velocity; }},
      FieldRow{"damping_work", "J", kState, [](auto& r) -> auto& { return r.damping; }},
      FieldRow{"numbers", "as in element_fields.hpp", kState, [](auto& r) -> auto& { return r.numbers; }},
      FieldRow{"released_faces", "1", kState, [](auto& r) -> auto& { return r.released; }},
      FieldRow{"contactor", "1", kState, [](auto& r) -> auto& { return r.contactor; }},
      FieldRow{"overlap_depth", "m", kState, [](auto& r) -> auto& { return r.field.depth; }},
      FieldRow{"surface_sides", "1", kState, [](auto& r) -> auto& { return r.field.sides; }},
      FieldRow{"surface_planes", "m", kNotHashed, [](auto& r) -> auto& { return r.field.planes; }},
      FieldRow{"surface_normals", "1", kNotHashed, [](auto& r) -> auto& { return r.field.normal; }},
  };
// clang-format on
}
;

/// A joint on the active list, with its side a. The slots of its sides are not part of the record.
struct JointRecord {
  GlobalId element = 0, other = 0;
  ActiveJoint joint;
};
template <>
struct FieldTable<JointRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kState, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"other", "1", kState, [](auto& r) -> auto& { return r.other; }},
      FieldRow{"id", "1", kState, [](auto& r) -> auto& { return r.joint.id; }},
      FieldRow{"face", "1", kState, [](auto& r) -> auto& { return r.joint.face_a; }},
      FieldRow{"code", "1", kState, [](auto& r) -> auto& { return r.joint.code; }},
      FieldRow{"law", "1", kState, [](auto& r) -> auto& { return r.joint.law; }},
      FieldRow{"history", "as in physics/joint_history.hpp", kState, [](auto& r) -> auto& { return r.joint.history; }},
      FieldRow{"time_of_failure", "s", kState, [](auto& r) -> auto& { return r.joint.time_of_failure; }},
      FieldRow{"elastic", "1", kState, [](auto& r) -> auto& { return r.joint.elastic; }},
  };
// clang-format on
}
;

/// A joint whose faces belong to contact, with side a.
struct ReleasedRecord {
  GlobalId element = 0;
  ReleasedJoint joint;
};
template <>
struct FieldTable<ReleasedRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kState, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"id", "1", kState, [](auto& r) -> auto& { return r.joint.id; }},
      FieldRow{"face", "1", kState, [](auto& r) -> auto& { return r.joint.face_a; }},
      FieldRow{"mode", "1", kState, [](auto& r) -> auto& { return r.joint.mode; }},
      FieldRow{"time_of_failure", "s", kState, [](auto& r) -> auto& { return r.joint.time_of_failure; }},
      FieldRow{"dissipated", "J", kNotHashed, [](auto& r) -> auto& { return r.joint.dissipated; }},
      FieldRow{"opening", "m", kNotHashed, [](auto& r) -> auto& { return r.joint.opening; }},
      FieldRow{"slip", "m", kNotHashed, [](auto& r) -> auto& { return r.joint.slip; }},
  };
// clang-format on
}
;

/// A couple that touches, with the element of its point. Indices of point and contactor are not part of the record.
struct CoupleRecord {
  GlobalId element = 0, contactor = 0, point = 0;
  TouchingCouple couple;
};
template <>
struct FieldTable<CoupleRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kState, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"contactor", "1", kState, [](auto& r) -> auto& { return r.contactor; }},
      FieldRow{"point", "1", kState, [](auto& r) -> auto& { return r.point; }},
      FieldRow{"history", "see contact/history.hpp", kState, [](auto& r) -> auto& { return r.couple.history; }},
  };
// clang-format on
}
;

/// A contact point's offset outside the spherical boundary.
struct OffsetRecord {
  GlobalId element = 0, point = 0;
  double offset = 0;
};
template <>
struct FieldTable<OffsetRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kState, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"point", "1", kState, [](auto& r) -> auto& { return r.point; }},
      FieldRow{"offset", "m", kState, [](auto& r) -> auto& { return r.offset; }},
  };
// clang-format on
}
;

/// A constraint on one axis of a corner, by entry of the stage: where displacements count from, and the last velocity.
struct HoldRecord {
  GlobalId element = 0;
  Index entry = 0;
  std::int8_t corner = 0, axis = 0;
  double start = 0, velocity = 0;
};
template <>
struct FieldTable<HoldRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kState, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"entry", "1", kState, [](auto& r) -> auto& { return r.entry; }},
      FieldRow{"corner", "1", kState, [](auto& r) -> auto& { return r.corner; }},
      FieldRow{"axis", "1", kState, [](auto& r) -> auto& { return r.axis; }},
      FieldRow{"start", "m", kState, [](auto& r) -> auto& { return r.start; }},
      FieldRow{"velocity", "m/s", kState, [](auto& r) -> auto& { return r.velocity; }},
  };
// clang-format on
}
;

/// A force that constraints and absorbing boundaries put on a corner in the last step. Not hashed: it matters only
/// where an absorbing boundary of the next stage takes it over, and then velocities depend on it.
struct HeldRecord {
  GlobalId element = 0;
  std::int8_t corner = 0;
  std::array<double, 3> force{};
};
template <>
struct FieldTable<HeldRecord> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kNotHashed, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"corner", "1", kNotHashed, [](auto& r) -> auto& { return r.corner; }},
      FieldRow{"force", "N", kNotHashed, [](auto& r) -> auto& { return r.force; }},
  };
// clang-format on
}
;

/// A face on a physical surface.
struct FaceTag {
  GlobalId element = 0;
  Index group = 0;
  int face = 0;
};
template <>
struct FieldTable<FaceTag> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kNotHashed, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"group", "1", kNotHashed, [](auto& r) -> auto& { return r.group; }},
      FieldRow{"face", "1", kNotHashed, [](auto& r) -> auto& { return r.face; }},
  };
// clang-format on
}
;

template <>
struct FieldTable<CornerTag> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"element", "1", kNotHashed, [](auto& r) -> auto& { return r.element; }},
      FieldRow{"group", "1", kNotHashed, [](auto& r) -> auto& { return r.group; }},
      FieldRow{"corners", "1", kNotHashed, [](auto& r) -> auto& { return r.corners; }},
  };
// clang-format on
}
;

/// Elements with all that belongs to them; every list ascending by element.
struct Records {
  std::vector<ElementRecord> elements;
  std::vector<JointRecord> joints;
  std::vector<ReleasedRecord> released;
  std::vector<CoupleRecord> couples;
  std::vector<OffsetRecord> offsets;
  std::vector<HoldRecord> holds;
  std::vector<HeldRecord> held;
  std::vector<FaceTag> faces;
  std::vector<CornerTag> corners;

  /// Place of an element, -1: not here. O(log elements).
  [[nodiscard]] Index place_of(GlobalId element) const;
};

/// The lists of the records by name.
inline constexpr std::tuple kRecordLists{
    std::pair{"element", &Records::elements},        std::pair{"joint", &Records::joints},
    std::pair{"released_joint", &Records::released}, std::pair{"couple", &Records::couples},
    std::pair{"boundary_offset", &Records::offsets}, std::pair{"hold", &Records::holds},
    std::pair{"held_force", &Records::held},         std::pair{"surface_face", &Records::faces},
    std::pair{"surface_corner", &Records::corners}};

/// Calls visit(name, list) for every list of the records.
template <class R, class Visit>
void for_each_list(R& records, Visit&& visit) {
  std::apply([&](const auto&... row) { (visit(row.first, records.*row.second), ...); }, kRecordLists);
}

/// The elements marked, packed for a message: list by list, field by field, numbers of fixed width, little-endian.
/// @param wanted (elements) 1: yes. O(elements + lists).
[[nodiscard]] std::vector<std::byte> pack(const Records& records, std::span<const std::uint8_t> wanted);

/// Appends what `pack` made. Throws InternalError if the bytes are not whole.
void unpack(std::span<const std::byte> bytes, Records& records);

/// Keeps the elements marked, with what belongs to them. @param wanted (elements) 1: yes
void keep(Records& records, std::span<const std::uint8_t> wanted);

/// Takes in elements that arrived in any order. O(records + arrivals log arrivals).
void merge(Records& records, Records arrivals);

}  // namespace breccia
