#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/surface_sides.hpp"
#include "physics/contact/elements.hpp"
#include "physics/contact/geometry/overlap.hpp"
#include "physics/contact/geometry/point.hpp"
#include "physics/contact/history.hpp"
#include "physics/number_vector.hpp"

namespace breccia {

/// A contact point and a contactor that may touch before the next search.
struct ContactCouple {
  Index point;      ///< index into ContactState::points
  Index contactor;  ///< index into ContactState::contactors
  /// m: while ContactState::travel is less, the point is not in the contactor or so near that it could matter.
  double apart_until = -std::numeric_limits<double>::infinity();
  bool operator==(const ContactCouple& other) const { return point == other.point && contactor == other.contactor; }
};

/// The couples of one point, which follow those of the point before it in ContactState::couples.
struct PointCouples {
  Index point;
  Index count;
  double apart_until;  ///< m: no more than the smallest of these couples
};

/// A couple that may come to matter within the next steps, apart from the others, which are many more.
struct AwakeCouple {
  Index couple;  ///< index into ContactState::couples
  Index point, contactor;
  Index slot;          ///< of the contactor
  double apart_until;  ///< m, of the couple, brought up to date here
};

/// A couple that touches, with its history. It lives as long as the overlap: a point that slides into a neighbouring
/// element keeps it, a point that leaves the body loses it. Only the energy gained or lost by the couple and its
/// delayed normal force remain, with d = 0 and without offset: first a tensile force removes gains, then, while the
/// point stays near, the rest is kept for correction in its next overlap with the body.
struct TouchingCouple {
  Index point = 0;
  Index contactor = 0;
  PairHistory<double> history{};
};

/// The functions of the contactor's overlap that counted in the last step; of an overlap that the mesh came with all.
[[nodiscard]] inline OverlapRows sides_of(const PairHistory<double>& history) {
  return history.sides > 0 ? static_cast<OverlapRows>(history.sides) : kAllRows;
}

/// Within one point.
inline void sort_by_contactor(std::span<TouchingCouple> couples) {
  const auto before = [](const TouchingCouple& a, const TouchingCouple& b) { return a.contactor < b.contactor; };
  if (!std::is_sorted(couples.begin(), couples.end(), before)) std::sort(couples.begin(), couples.end(), before);
}

/// Overlap field of a contactor (geometry/field.hpp).
struct FieldValues {
  std::array<double, 4> depth{};                  ///< m, at its corners, > 0
  SurfaceSides sides = 0;                         ///< that it meets
  SideRows planes{};                              ///< m, those at rest beside its own faces (mesh/surface_planes.hpp)
  std::array<std::array<double, 3>, 4> normal{};  ///< mean outward normals at its corners, at rest
  bool operator==(const FieldValues&) const = default;
};

/// A contactor whose field fracture has changed.
struct ChangedField {
  Index contactor = 0;
  FieldValues before;
};

/// Force of the spherical boundary on a point.
struct BoundaryForce {
  Index point;
  Vec3 force;  ///< N
};

/// Everything about contact that changes in a run. Plain data.
struct ContactState {
  // Who may touch whom.
  std::vector<ContactPoint> points;           ///< in the order in which they came
  std::vector<Index> order;                   ///< (points) indices by ascending id
  std::vector<Index> contactors;              ///< slots by ascending global element id
  std::vector<Index> contactor_of_slot;       ///< (num_slots) -1: none
  std::vector<std::array<double, 4>> height;  ///< (contactors) m, of the corners above their opposite faces, at rest
  std::vector<double> body_length;            ///< (bodies) H, m
  std::vector<double> body_extent;            ///< (bodies) m
  /// m: every search finds the points that are so near to the box of a contactor.
  double near = std::numeric_limits<double>::infinity();
  std::vector<ContactCouple> couples;  ///< by (point id, contactor)
  std::vector<PointCouples> by_point;  ///< the same, point by point; made with them (couples.hpp)
  /// Sum over the steps so far of the largest motion of any node of this rank's couples, m. While it is not counted
  /// (infinite), couples are evaluated in every step.
  double travel = std::numeric_limits<double>::infinity();
  std::vector<ContactCouple> fresh;  ///< made by fracture since the last forces; by (point id, contactor)

  std::vector<std::uint8_t> relevant;  ///< (num_slots) 1: forces on it are evaluated on this rank; empty: on all

  // Overlap field.
  std::vector<FieldValues> field;          ///< (contactors)
  std::vector<ChangedField> changed;       ///< since the last forces, in no order: no sum goes over them
  std::vector<Index> change_of_contactor;  ///< (contactors) index into `changed`, -1: none

  // History and forces of the last step.
  std::vector<TouchingCouple> touching;  ///< by (point id, contactor)
  std::vector<BoundaryForce> boundary;   ///< by point id
  std::vector<double> boundary_offset;  ///< (points) m outside the sphere without force: where the point was first seen

  // Derived from the couples (couples.hpp).
  std::vector<AwakeCouple> awake;  ///< by (point id, contactor): all whose apart_until is less than awake_until
  double awake_until = -std::numeric_limits<double>::infinity();  ///< m: while `travel` is less the list is complete
  double travel_before = 0;                                       ///< m, in the last step

  // Scratch, worth keeping only for its storage.
  std::vector<TouchingCouple> touching_before;
  StepElements elements;

  [[nodiscard]] bool evaluated(Index slot) const {
    return relevant.empty() || relevant[static_cast<std::size_t>(slot)] != 0;
  }
  [[nodiscard]] GlobalId id(Index point) const { return points[static_cast<std::size_t>(point)].id; }
  /// The order of everything that is summed: point id, then contactor.
  [[nodiscard]] bool before(const ContactCouple& a, const ContactCouple& b) const {
    const GlobalId ia = id(a.point), ib = id(b.point);
    return ia != ib ? ia < ib : a.contactor < b.contactor;
  }
};

}  // namespace breccia
