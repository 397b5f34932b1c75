#pragma once

#include <span>
#include <vector>

#include "contact/contact_surface.hpp"
#include "contact/couple_search.hpp"

namespace breccia {

/// A face that has nothing across it any more. One side of a joint is enough.
struct FreedFace {
  Index slot;
  int face;
};

/// What follows from faces that fracture has freed: their points, the couples they make, the couples of elements no
/// longer bonded, and the change of the overlap field. Points and couples are found by the test of the last full search
/// at its positions, so a full search would find no other set.
class FaceRelease {
 public:
  /// @pre all arguments outlive this object; `surface` and `contact` change
  FaceRelease(ContactSurface& surface, CoupleSearch& search, ContactState& contact)
      : surface_(surface), search_(search), contact_(contact) {}

  /// Faces that are free already are passed over.
  /// @return  the couples that came about, in any order, some of them twice; none of them was there before
  [[nodiscard]] std::vector<ContactCouple>& release(std::span<const FreedFace> faces);

 private:
  void collect_sides(std::span<const FreedFace> faces);
  void store_clusters();
  void free_corners_of(const Topology::Face& side);
  void couple_new_points(std::size_t first);
  void couple_separated(std::size_t first);
  void couple_points_of(Index element, Index other, std::size_t first);

  ContactSurface& surface_;
  CoupleSearch& search_;
  ContactState& contact_;
  // Work space.
  std::vector<Topology::Face> sides_;  ///< both of every face, sorted
  std::vector<Index> nodes_;           ///< of these faces, ascending
  std::vector<Index> old_clusters_;    ///< of the corners at these nodes, before the faces broke
  std::vector<Index> freed_;           ///< corners, with the faces of one side
  std::vector<Index> changed_, contactors_;
  std::vector<ContactCouple> made_;
};

}  // namespace breccia
