#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "base/field.hpp"
#include "discretisation/local_mesh.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"
#include "physics/stable_step.hpp"

namespace breccia {

/// Contribution of contact to the frequency of an element, which reduces the stable step.
///
/// A couple of a point (weight w, shape N on the target's nodes) and a contactor (barycentric lambda) is a stiffness
/// w kappa g g^T of rank one, kappa = s / H with s = stiffest_slope(law), g the gradient of the overlap. By rows it is
/// at most diag(w kappa N_i (1 + q)) on the target and diag(w kappa lambda_a (1 + 1/q)) on the contactor for any q > 0;
/// with the best q all couples of a target part P and a contactor part Q together give
///
///   omega_c^2 <= kappa G^2 (max_P A_i/m_i + max_Q (A_a + w)/m_a)
///
/// A_i: of the free faces at a node, sum over its faces of (x_i + sum_j x_j) / (12 x_i) of their areas for some
/// positive x, as for every matrix of numbers that are not negative: a third for x = 1. With A_i/m_i of the node and of
/// its neighbours for x (two steps of a power iteration) light nodes between heavy ones count for less. Of the sum of
/// several faces the largest component in any direction: along the normal of each, across it as far as friction is
/// elastic. w: weight of a point, which may lie on one node of a smaller contactor; G: slope of the overlap field. Both
/// directions, P on Q and Q on P, act at once. Nodes constrained in all directions have infinite mass.
///
/// Damping adds to it (ContactBound in bound.hpp).
///
/// Possible contacts are found by parts: free faces are put in cells of about `kCellSizes` face sizes at their present
/// places, those of a body in a cell make a patch, and patches count against each other when their boxes come within
/// `kSpeedMargin` of their relative speeds times the time until the next evaluation, and a share of their faces' size.
/// A patch is merged from its parts on the ranks by exact maxima, so the result is the same on any number of ranks; it
/// does not depend on couples and searches.

/// Faces of one rank's elements, a bit a face.
struct ContactFaces {
  std::vector<std::uint8_t> open;  ///< (num_slots) has nothing across it
  std::vector<std::uint8_t> torn;  ///< (num_slots) of these: can meet its own body where it is: freed by fracture, or
                                   ///< opposite to another face of the body close by
  std::vector<std::uint8_t> pointed;  ///< (num_slots) carries contact points if it is open
};

/// What the open faces of an element add, but for who is near.
struct ContactElement {
  std::array<double, 4> area_over_mass{}, per_mass{};    ///< A_i/m_i, 1/m_i of corners on open faces; 0: others,
                                                         ///< constrained ones
  std::array<double, 4> area{}, longest{}, steepness{};  ///< by open face: m2; m, edge; G^2
};

/// Calls f(face) for the bits that are set, ascending.
template <class F>
void for_each_face(unsigned bits, F&& f) {
  for (int face = 0; face < 4; ++face) {
    if ((bits >> face & 1) != 0) f(face);
  }
}

struct ContactStepModel {
  const ContactParams& params;
  const LocalMesh& mesh;
  std::span<const double> body_length;  ///< (bodies) H, m
  const ContactFaces& faces;
  std::span<const std::uint8_t> held;   ///< (num_nodes) 1: its motion is prescribed in all directions
  const ContactState* state = nullptr;  ///< the overlap field; null: as of elements on their own
};

/// Steepest slope of the normal law, where unloading begins, Pa: b sigma_p.
[[nodiscard]] double stiffest_slope(const ContactLaw& law);

/// Free faces of one body's group in one cell. What is merged is the largest of each number, on any rank.
struct ContactPatch {
  enum Number : std::size_t {
    box = 0,              ///< -low, high by axis, m
    reference_box = 6,    ///< the same at rest
    velocity = 12,        ///< -least, most by axis, m/s
    area_over_mass = 18,  ///< A_i/m_i, m2/kg
    per_mass = 19,        ///< 1/m_i, 1/kg
    steepness = 20,       ///< G^2
    weight = 21,          ///< of a point, m2; 0: no face carries any
    per_length = 22,      ///< 1/H, 1/m
    torn = 23,            ///< 1: some faces are
    count = 24
  };
  std::int64_t level = 0;  ///< 2^level <= longest edge of the faces < 2^(level+1), m
  std::int64_t group = 0, body = 0;
  std::array<std::int64_t, 3> cell{};
  std::array<double, count> largest{};

  /// Of the boxes and velocities: their numbers begin at `first`.
  [[nodiscard]] double low(std::size_t first, std::size_t axis) const { return -largest[first + axis]; }
  [[nodiscard]] double high(std::size_t first, std::size_t axis) const { return largest[first + 3 + axis]; }
  /// Upper bound of the edges of its level, m.
  [[nodiscard]] double face_size() const { return std::ldexp(1.0, static_cast<int>(level) + 1); }
  void raise(std::size_t number, double value) { largest[number] = std::max(largest[number], value); }
  void raise_all(const ContactPatch& other) {
    for (std::size_t k = 0; k < count; ++k) raise(k, other.largest[k]);
  }
  [[nodiscard]] auto key() const { return std::tuple(level, group, body, cell[0], cell[1], cell[2]); }
};

/// Edges of a cell in largest face sizes of its level.
inline constexpr double kCellSizes = 1.0;
/// Relative speeds may grow by this factor until the next evaluation.
inline constexpr double kSpeedMargin = 2.0;
/// Patches come near each other by this share of their faces' size however slow they are.
inline constexpr double kSizeMargin = 0.25;

/// Patches of a rank, or of the whole model.
struct ContactPatches {
  std::vector<ContactPatch> list;  ///< each key() once
  std::vector<Index> place;        ///< (4 num_slots) of open faces of originals: where in the list; -1: none

  /// Ascending by key(), the same order on any number of ranks: of equal contributions the first is named.
  void sort();
  /// Adds those of all ranks, this one's among them or not, merged with its own where they are parts of one.
  /// O(patches)
  void merge(const std::vector<std::vector<ContactPatch>>& of_all);
};

class ContactElements;

/// Those of the originals' open faces at present, in any order.
/// @param elements    of this model, up to date
/// @param coarsening  >= 1: cells larger by it.  O(faces)
[[nodiscard]] ContactPatches contact_patches(const ContactStepModel& model, const ContactElements& elements,
                                             const Field<double>& position, const Field<double>& velocity,
                                             double coarsening);
/// Of some originals alone.
[[nodiscard]] ContactPatches contact_patches(const ContactStepModel& model, const ContactElements& elements,
                                             const Field<double>& position, const Field<double>& velocity,
                                             double coarsening, std::span<const Index> slots);

/// Contributions of contact to the elements, of one evaluation.
class ContactShares {
 public:
  /// @param patches  of the whole model, merged, at the same positions
  /// @param time     s, within which things may meet. All that is given outlives this object.
  /// O(patches), and O(patches log patches) before the first contribution
  ContactShares(const ContactStepModel& model, const ContactElements& elements, const ContactPatches& patches,
                double time);
  ~ContactShares();
  ContactShares(const ContactShares&) = delete;
  ContactShares& operator=(const ContactShares&) = delete;

  /// omega_c^2 of an original; 0 where nothing can be met. O(log patches) for the first of its patch
  [[nodiscard]] ContactShare of(Index slot);
  /// No less than any corner of it has, 1/s2, computed without a search: as if it could be in contact with everything.
  /// O(groups) for the first of its patch
  [[nodiscard]] double at_most(Index slot);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// omega_c^2 of the originals, by slot; 0 where nothing can be met within `time`, s.
/// @param patches  as for ContactShares
[[nodiscard]] std::vector<ContactShare> contact_shares(const ContactStepModel& model, const ContactElements& elements,
                                                       const ContactPatches& patches, double time);

}  // namespace breccia
