#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/contact/step/contact_step.hpp"

namespace breccia {

/// ContactElement of the originals that have open faces, kept between evaluations: only elements whose causes have
/// changed are found again.
class ContactElements {
 public:
  /// What an element with its own nodes depends on. Depths of the overlap field stay as they are.
  struct Cause {
    std::uint8_t open = 0, held = 0;  ///< bits of faces and of corners
    std::int32_t sides = 0;           ///< of the overlap field; -1: there is none
    bool operator==(const Cause&) const = default;
  };
  /// Largest numbers of a volume group's elements so far.
  struct Largest {
    enum Number : std::size_t { area_over_mass, per_mass, steepness, area, per_length, count };
  };
  struct Entry {
    Index slot = 0;
    Cause cause;
    ContactElement element;
  };

  /// Brings all up to date. @param model  of one and the same mesh. O(slots), and O(elements that changed); elements
  /// that share nodes change together
  void update(const ContactStepModel& model);

  /// All of them; without open faces (Entry::cause) where these have been closed again.
  [[nodiscard]] std::span<const Entry> list() const { return list_; }
  /// @pre an original that has open faces
  [[nodiscard]] const Entry& entry(Index slot) const {
    return list_[static_cast<std::size_t>(place_[static_cast<std::size_t>(slot)])];
  }
  [[nodiscard]] const ContactElement& of(Index slot) const { return entry(slot).element; }
  /// (volume groups, Largest::count) m2/kg, 1/kg, 1, m2, 1/m: of all elements that any update found, so no less than
  /// those of the present ones
  [[nodiscard]] const std::vector<double>& largest() const { return largest_; }

 private:
  void raise_largest(const ContactStepModel& model, const Entry& entry);

  std::vector<Index> place_;  ///< (slots) in list_, -1: has had no open face
  std::vector<Entry> list_;
  std::vector<double> largest_;
  // At the last update:
  std::vector<std::uint8_t> own_held_, shared_held_;  ///< nodes of both kinds
  std::vector<std::uint8_t> shared_open_;             ///< elements that share nodes
};

}  // namespace breccia
