#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/search_params.hpp"
#include "mesh/corner_clusters.hpp"
#include "mesh/topology.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// What contact reads of the model of a rank; nothing of it changes in a run.
struct ContactModel {
  const ContactParams& params;
  const Mesh& mesh;
  const Topology& topology;
  const LocalMesh& local;

  [[nodiscard]] Index slot_of(Index element) const { return local.slot_of_element[static_cast<std::size_t>(element)]; }
};

/// Who may touch whom: the contact points of the free faces, the contactors, and which elements are still bonded.
///
/// Targets are the points of free faces, contactors the elements that contact/contactors.hpp chooses. A point and a
/// contactor may touch when their groups have a law and their elements are not bonded around a corner (an element is
/// bonded to itself).
class ContactSurface {
 public:
  /// No points and no contactors yet. @pre all arguments outlive this object; only `contact` changes, through this
  /// object and others. Throws InternalError if an argument does not fit the others. O(elements).
  ContactSurface(const ContactSearchParams& search, const ContactModel& model, ContactState& contact);

  /// Chooses the contactors of a whole model and builds their overlap field. @return  m, their mean size. O(elements).
  [[nodiscard]] double choose_contactors(const ContactSearchParams& search);
  /// Points of all faces that are free in the topology; call sort_points() after the last.
  void add_free_points();
  /// Points of one face, where it may carry some; call sort_points() after the last.
  void add_points(Index element, int face);
  /// Breaks faces between two elements. @param changed  out: corners whose cluster changed (CornerClusters)
  void break_faces(std::span<const Topology::Face> sides, std::vector<Index>& changed);

  [[nodiscard]] bool any_law() const { return any_law_; }
  /// Whether points on the element of a slot may touch anything, and anything it.
  [[nodiscard]] bool may_press(Index slot) const { return presses_[group_of(slot)]; }
  [[nodiscard]] bool may_be_pressed(Index slot) const { return pressed_[group_of(slot)]; }
  /// Whether the groups of two slots have a contact law.
  [[nodiscard]] bool has_law(Index slot, Index other) const;
  /// @param point, contactor  indices of ContactState
  [[nodiscard]] bool may_touch(Index point, Index contactor) const;
  /// First point of each face of an element, -1: the face has none.
  [[nodiscard]] const std::array<Index, 4>& first_points(Index element) const {
    return first_point_[static_cast<std::size_t>(element)];
  }
  [[nodiscard]] const CornerClusters& clusters() const { return clusters_; }
  [[nodiscard]] const ContactModel& model() const { return model_; }

 private:
  [[nodiscard]] std::size_t group_of(Index slot) const {
    return static_cast<std::size_t>(model_.local.block_group[static_cast<std::size_t>(slot / kLanes)]);
  }

  ContactModel model_;
  ContactState& contact_;
  CornerClusters clusters_;
  std::vector<std::uint8_t> carries_;              ///< (elements) a bit a face: may carry points
  std::vector<std::array<Index, 4>> first_point_;  ///< (elements)
  std::vector<bool> presses_, pressed_;  ///< (volume groups) its points, its elements have a law with some group
  bool any_law_;
};

}  // namespace breccia
