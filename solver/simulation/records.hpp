#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "physics/contact/contact_state.hpp"
#include "physics/joint_forces.hpp"

namespace breccia {

/// An element as it travels from rank to rank: what it is and all it remembers. Elements and nodes by global id.
struct ElementRecord {
  GlobalId id = 0;
  std::int64_t source_id = 0;
  Index group = 0, body = 0;
  std::array<GlobalId, 4> vertex{};                                          ///< mesh nodes of the corners
  std::array<GlobalId, 4> neighbour{};                                       ///< by face, -1: free
  std::array<std::int8_t, 4> code{};                                         ///< FaceLink::code
  std::uint8_t released = 0;                                                 ///< a bit a face: freed by fracture
  std::uint8_t contactor = 0;                                                ///< 1: others may touch it
  std::array<std::array<double, 3>, 4> reference{}, position{}, velocity{};  ///< of the corners, m, m/s
  FieldValues field{};                                                       ///< overlap field, m
  double viscous = 0, stress_work = 0;                                       ///< J so far (sweep.hpp)
  std::array<double, 4> damping{};                                           ///< J so far, by corner
};

// What only some elements have, each with the id of the element that takes it along.

/// A joint on the active list. It travels with its side a; its slots mean nothing on the way.
struct JointRecord {
  GlobalId element = 0, other = 0;
  ActiveJoint joint;
};

/// A joint whose faces belong to contact, with side a.
struct ReleasedRecord {
  GlobalId element = 0;
  ReleasedJoint joint;
};

/// A couple that touches, with the element of its point.
struct CoupleRecord {
  GlobalId element = 0, contactor = 0, point = 0;
  TouchingCouple couple;
};

/// A contactor whose overlap field is on the move.
struct RampRecord {
  GlobalId element = 0;
  FieldRamp ramp;
};

/// A contact point's offset outside the spherical boundary, m.
struct OffsetRecord {
  GlobalId element = 0, point = 0;
  double offset = 0;
};

/// A constraint on one axis of a corner, by entry of the stage.
struct HoldRecord {
  GlobalId element = 0;
  Index entry = 0;
  std::int8_t corner = 0, axis = 0;
  double start = 0, velocity = 0;  ///< m, m/s (Constraints)
};

/// A face on a physical surface.
struct FaceTag {
  GlobalId element = 0;
  Index group = 0;
  int face = 0;
};

/// Elements with all that belongs to them; every list ascending by element.
struct Records {
  std::vector<ElementRecord> elements;
  std::vector<JointRecord> joints;
  std::vector<ReleasedRecord> released;
  std::vector<CoupleRecord> couples;
  std::vector<RampRecord> ramps;
  std::vector<OffsetRecord> offsets;
  std::vector<HoldRecord> holds;
  std::vector<FaceTag> faces;
  std::vector<CornerTag> corners;

  /// Place of an element, -1: not here. O(log elements).
  [[nodiscard]] Index place_of(GlobalId element) const;
};

/// Another rank that has originals of this one as proxies or the other way round; both sides list the same ids,
/// ascending.
struct SharedElements {
  int rank = 0;
  std::vector<GlobalId> send;     ///< originals that are proxies there
  std::vector<GlobalId> receive;  ///< proxies whose originals are there
};

/// The same by slots of this rank, in the same order.
struct SharedSlots {
  int rank = 0;
  std::vector<Index> send, receive;
  std::vector<Index> send_position{}, receive_position{};  ///< without their velocities
};

/// The elements marked, packed for a message. @param wanted (elements) 1: yes. O(elements + lists).
[[nodiscard]] std::vector<std::byte> pack(const Records& records, std::span<const std::uint8_t> wanted);

/// Appends what `pack` made. @pre the bytes come from the same build on the same kind of machine
void unpack(std::span<const std::byte> bytes, Records& records);

/// Keeps the elements marked, with what belongs to them. @param wanted (elements) 1: yes
void keep(Records& records, std::span<const std::uint8_t> wanted);

/// Takes in elements that arrived in any order. O(records + arrivals log arrivals).
void merge(Records& records, Records arrivals);

[[nodiscard]] std::vector<std::byte> pack(const WholeModel& whole);
[[nodiscard]] WholeModel unpack_whole(std::span<const std::byte> bytes);

/// The bare mesh of the records: elements and nodes ascending by id, links to elements that are not here `kBeyond`.
/// @param whole  for the names of the groups
[[nodiscard]] Mesh mesh_of(const Records& records, const WholeModel& whole);
/// @param mesh  as mesh_of gave it
[[nodiscard]] Topology topology_of(const Records& records, const Mesh& mesh);

}  // namespace breccia
