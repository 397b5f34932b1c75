#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/extent.hpp"
#include "contact/contact_surface.hpp"
#include "contact/couple_search.hpp"
#include "contact/face_release.hpp"
#include "contact/kept_couples.hpp"
#include "state/records.hpp"

namespace breccia {

/// Contact of one rank: keeps the points, contactors and couples of a ContactState up to date.
///
/// A couple is a pair that passes the couple test of detection/point_body/search.hpp at the positions of the last full
/// search and may touch (ContactSurface). This definition is kept at all times, so the couples at hand are those that a
/// full search at these positions would find.
class ContactSearch {
 public:
  /// @pre all arguments outlive this object; only `contact`, empty at first, changes, through this object and
  /// contact_forces. Faces broken from the start are free in the topology.
  /// O(elements). Throws InternalError if an argument does not fit the others.
  ContactSearch(const ContactSearchParams& search, const ContactModel& model, ContactState& contact);

  /// Contact of a piece of the model as its records hold it. @param records  of the elements of model.mesh
  ContactSearch(const ContactSearchParams& search, const Model& model, const Records& records, ContactState& contact);

  ContactSearch(const ContactSearch&) = delete;
  ContactSearch& operator=(const ContactSearch&) = delete;

  /// After every step. @param length  m, no node of a couple here has moved further in it
  void count_travel(double length);
  /// CoupleSearch::due(). Collective.
  [[nodiscard]] bool due(const NodalState& nodes, const KnownMotion& motion, const Communicator& communicator) {
    return search_.due(nodes, motion, communicator);
  }
  /// A full search; arguments as of CoupleSearch::search().
  void search(const NodalState& nodes, double step_length, std::span<const std::uint8_t> current = {});
  /// How far around extent() a search finds couples, m.
  [[nodiscard]] double search_reach(double step_length) const { return search_.reach(step_length); }
  /// Box around the elements on which this rank evaluates forces.
  [[nodiscard]] Extent extent(const Field<double>& position) const;
  /// If the case enables detection.verify: throws InternalError with the pair if a pair touches and is no couple.
  void verify(const NodalState& nodes) const;
  [[nodiscard]] bool verifies() const { return verify_; }

  /// For one of several ranks, which receive each other's speeds with a delay of one step. From now on only the couples
  /// of KeptCouples are kept. @param relevant  (num_slots) 1: forces on it are evaluated here
  /// @pre before the first search
  void restrict_to(std::vector<std::uint8_t> relevant);
  /// Marks the slots of all points and contactors in couples. @param marks  (num_slots)
  void mark_coupled(std::vector<std::uint8_t>& marks) const;
  /// What the points of these elements touch. @param slots  ascending by element id
  [[nodiscard]] std::vector<CoupleRecord> touching_of(std::span<const Index> slots) const;
  /// Takes what other ranks hold of the couples of their points that touch, as far as forces here depend on it.
  /// @param touching  by (element, point, contactor). @pre couples are those that are kept
  void adopt(std::span<const CoupleRecord> touching);
  /// Writes the contact state of an element into its record and the lists; elements ascending.
  void store(Index element, ElementRecord& record, Records& records) const;

  /// Faces freed by fracture (FaceRelease). @return  as KeptCouples::add()
  bool release_faces(std::span<const FreedFace> faces) { return kept_.add(release_.release(faces)); }

  [[nodiscard]] const ContactState& contact() const { return contact_; }
  [[nodiscard]] const CornerClusters& clusters() const { return surface_.clusters(); }
  [[nodiscard]] const CoupleSearch& searches() const { return search_; }

 private:
  void restore_contactors(const Records& records);
  void restore_faces(const Records& records);
  void restore_offsets(const Records& records);
  [[nodiscard]] bool concerns(const TouchingCouple& couple) const;

  bool verify_;
  ContactState& contact_;
  ContactSurface surface_;
  CoupleSearch search_;
  KeptCouples kept_;
  FaceRelease release_;
};

}  // namespace breccia
