#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/extent.hpp"
#include "base/field.hpp"
#include "contact/contact_surface.hpp"
#include "contact/displacement.hpp"
#include "contact/halo_roles.hpp"
#include "detection/point_body/contactor_grid.hpp"
#include "detection/point_body/search.hpp"
#include "discretisation/nodal_state.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Largest buffer, m, that searches choose. @param asked  m, of the case; 0: chosen at every search
/// @param contactor_size  m, mean
[[nodiscard]] double largest_buffer(double asked, double contactor_size);

/// Full searches of one rank, and the positions at which the last one was made: points that fracture adds are coupled
/// at these, so that couples are the same whether they were found by a search or added after it.
///
/// With buffer b the set holds every pair that touches while no node has moved by more than b/2 since the search,
/// beside what all have moved together. The sum of max_speed dt bounds the largest displacement from above; only when
/// it passes b/2 the displacement itself is computed, less what all nodes have moved together
/// (contact/displacement.hpp), and either the sum is brought down to it or a search is done. Without a buffer given
/// b is 10 % of the contactors' mean size (the edge of the regular tetrahedron of their mean volume): the number of
/// couples grows as (1 + 5 b/size)^3, and so small a buffer still lasts for hundreds of steps of a stiff material. In a
/// run so fast that it would last for less than 20 steps it is larger, up to 40 %.
class CoupleSearch {
 public:
  /// @param contactor_size  m, mean. @pre all arguments outlive this object
  CoupleSearch(const ContactSearchParams& search, const ContactSurface& surface, const ContactState& contact,
               double contactor_size);

  /// Speeds of other ranks are received with a delay of one step. @pre before the first search
  void expect_late_speeds();
  /// Whether a search is due; to be called once a step. Collective.
  [[nodiscard]] bool due(const NodalState& nodes, const KnownMotion& motion, const Communicator& communicator);
  /// A full search. @param step_length  m, KnownMotion::length
  /// @param current  (num_slots) 1: at its position of now; others are further than reach() from evaluated elements.
  /// Empty: all
  /// @param couples  out: sorted (ContactState::before)
  void search(const NodalState& nodes, double step_length, std::span<const std::uint8_t> current,
              std::vector<ContactCouple>& couples);
  /// How far around the evaluated elements the next search finds couples, m.
  [[nodiscard]] double reach(double step_length) const { return kContactorReach * buffer_for(step_length); }

  [[nodiscard]] bool searched() const { return searched_; }
  [[nodiscard]] double buffer() const { return buffer_; }  ///< m, of the last search
  /// m: every search, with any buffer, finds the points within this distance of the box of a contactor.
  [[nodiscard]] double always_found() const;
  [[nodiscard]] double contactor_size() const { return size_; }  ///< m, mean
  /// Share, 0..1, of what nodes may move after the last search that they have moved. @pre searched(). Collective.
  [[nodiscard]] double used_up(const NodalState& nodes, const Communicator& communicator) const;

  // At the positions of the last search; @pre searched().

  [[nodiscard]] Vec3 position(const ContactPoint& point) const;
  /// @return  m; NaN: the contactor was out of reach
  [[nodiscard]] const detection::Corners& corners(Index contactor) const {
    return corners_[static_cast<std::size_t>(contactor)];
  }
  /// Contactors that form a couple with a point, ascending. The first call after a search: O(contactors).
  void contactors_of(const Vec3& point, std::vector<Index>& contactors);

 private:
  [[nodiscard]] double buffer_for(double step_length) const;
  void choose(std::span<const std::uint8_t> current);
  void find_roles(std::span<const std::uint8_t> current);

  /// Work space of a search.
  struct Chosen {
    std::vector<Index> points, contactors;  ///< by ascending ids
    std::vector<detection::Corners> corners;
    std::vector<Vec3> positions;
    std::vector<Extent> extents;  ///< (num_slots)
    std::vector<HaloRole> roles;  ///< (num_slots)
    std::vector<detection::Couple> found;
  };

  double asked_buffer_;  ///< m; 0: chosen at every search
  const ContactSurface& surface_;
  const ContactState& contact_;
  std::unique_ptr<detection::PointBodySearch> detection_;
  double size_;  ///< m
  bool searched_ = false;
  double buffer_ = 0;  ///< m
  DisplacementWatch moved_;
  Field<double> reference_;                  ///< nodal field, positions
  std::vector<detection::Corners> corners_;  ///< (contactors)
  detection::ContactorGrid grid_;            ///< built when it is first needed after a search
  bool grid_built_ = false;
  Chosen chosen_;
};

}  // namespace breccia
