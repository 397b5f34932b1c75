#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/field.hpp"
#include "discretisation/blocks.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {

/// Corner of the linked element that meets corner i of the own face, for all 16 codes of a link.
[[nodiscard]] constexpr int linked_corner(int code, int i) {
  return code < 12 ? matching_corner(code, i)
                   : kFaceCorners[static_cast<std::size_t>(code - 12)][static_cast<std::size_t>(i)];
}

/// The intact joints for the element-centric sweep: each own-node element evaluates its own side of the joints on its
/// four faces. Elastic joints need only k A0 / 3 and the neighbour's corners.
///
/// link = 16 slot + code. Codes 0..11 are FaceLink codes of an intact joint. Codes 12 + f point back at the element's
/// own face f (opening zero, no force): free faces, joints on the active list, joints handed over to contact, padding.
struct JointLinks {
  Field<std::int32_t> link;  ///< [own block][4 faces][8]
  Field<std::int32_t>
      place;  ///< [own block][4 faces][3 corners of the face][8] where x of the linked corner stands in a nodal field
  Field<double>
      stiffness;        ///< [own block][4 faces][8] k A0 / 3, N/m: force a metre of opening at each corner of the face
  Field<double> limit;  ///< [own block][8] m2: below this |opening|^2 every joint of the element is surely elastic

  [[nodiscard]] static std::size_t at(Index slot, int face) {
    return static_cast<std::size_t>(slot / kLanes) * 32 + static_cast<std::size_t>(face) * 8 +
           static_cast<std::size_t>(slot % kLanes);
  }
  [[nodiscard]] static constexpr std::int32_t make_link(Index slot, int code) { return slot * 16 + code; }
  [[nodiscard]] static constexpr std::int32_t self_link(Index slot, int face) { return slot * 16 + 12 + face; }
  [[nodiscard]] static constexpr Index slot_of(std::int32_t link) { return link >> 4; }
  [[nodiscard]] static constexpr int code_of(std::int32_t link) { return link & 15; }

  /// Every face is its own link, nothing is stiff. @param slots  of own-node elements, a multiple of 8
  void reset(Index slots) {
    const auto own = static_cast<std::size_t>(slots);
    link.resize(own * 4);
    place.resize(own * 12);
    stiffness.assign(own * 4, 0.0);
    limit.assign(own, std::numeric_limits<double>::infinity());
    for (Index s = 0; s < slots; ++s) {
      for (int f = 0; f < 4; ++f) detach(s, f);
    }
  }

  /// The joint between face `face_a` of slot a and the face of slot b that `code` names (FaceLink) is intact. The other
  /// side sees the same match of corners: own corner i <-> (rotation - i), which is its own inverse.
  void attach(Index a, int face_a, Index b, int code) {
    set(a, face_a, make_link(b, code));
    set(b, code / 3, make_link(a, 3 * face_a + code % 3));
  }
  /// The joint on this face is no longer evaluated by the sweep.
  void detach(Index slot, int face) { set(slot, face, self_link(slot, face)); }

 private:
  void set(Index slot, int face, std::int32_t value) {
    link[at(slot, face)] = value;
    const Index other = slot_of(value);
    const std::size_t first =
        static_cast<std::size_t>(slot / kLanes) * 96 + static_cast<std::size_t>(face * 24 + slot % kLanes);
    for (int i = 0; i < 3; ++i) {
      place[first + static_cast<std::size_t>(i * kLanes)] =
          other / kLanes * 96 + linked_corner(code_of(value), i) * 24 + other % kLanes;
    }
  }
};

/// Slots of a rank must fit into a link, and 12 a slot into a place.
inline constexpr Index kMaxSlots = (1 << 27) - kLanes;

}  // namespace breccia
