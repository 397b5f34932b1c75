#pragma once

#include <span>
#include <vector>

#include "physics/contact/step/bound.hpp"
#include "physics/contact/step/elements.hpp"

namespace breccia {

/// Upper bounds of what contact adds to elements wherever the bodies are: as if each could touch the stiffest and
/// lightest faces of any group, and the sphere. No less than ContactShares::of.
class ContactUpperBounds {
 public:
  ContactUpperBounds(const ContactStepModel& model, const ContactElements& elements);

  /// Of this rank's elements, of which `update` takes the largest of all ranks.
  [[nodiscard]] std::span<double> numbers() { return numbers_; }
  /// Bounds from the numbers. O(groups^2)
  void update();

  /// Of any node of a volume group, 1/s2. @pre updated
  [[nodiscard]] double of_group(Index group) const { return groups_[static_cast<std::size_t>(group)].most; }
  /// Of an element's corners. @pre updated, an original with open faces
  [[nodiscard]] ContactShare of(Index slot) const;

 private:
  struct Group {
    std::vector<ContactBound> bounds;  ///< of its nodes in contact with any group
    double wall = 0;                   ///< 1/s2 over A_i/m_i: of the sphere
    double most = 0;
  };
  [[nodiscard]] static double share(const Group& group, double area_over_mass, double per_mass);

  const ContactStepModel& model_;
  const ContactElements& elements_;
  std::vector<double> numbers_;  ///< as ContactElements::largest()
  std::vector<Group> groups_;
};

/// Patches of this rank's faces near an element alone, of which parts may be missing: what ContactShares makes of them
/// for this element is no more than with all patches of the model.
[[nodiscard]] ContactPatches patches_around(const ContactStepModel& model, const ContactElements& elements,
                                            const Field<double>& position, const Field<double>& velocity,
                                            double coarsening, Index slot);

}  // namespace breccia
