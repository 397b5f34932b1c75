#pragma once

#include <vector>

#include "physics/contact/state.hpp"

namespace breccia {

/// The couples that a rank keeps: those whose forces, or whose point's other forces, act on elements on which it
/// evaluates forces (ContactState::matters). A point's couples stand in a row and stay together, since what it touches
/// decides what it may touch next. A rank that is alone keeps all.
class KeptCouples {
 public:
  /// @pre contact outlives this object; its `couples`, `fresh` and what belongs to them change through it
  explicit KeptCouples(ContactState& contact) : contact_(contact) {}

  /// ContactState::couples have been replaced by a search.
  void replaced();
  /// Couples that fracture has made; none of them is there yet. @param made  in any order, also twice; changed
  /// @return  whether couples with elements that are not evaluated here came about: of these, positions and what they
  /// touch have to be received from now on
  [[nodiscard]] bool add(std::vector<ContactCouple>& made);
  /// Whether couples of a point, if it has any, are kept. O(log couples).
  [[nodiscard]] bool is_kept(Index point) const;

 private:
  void keep_evaluated();
  void choose_again(const std::vector<ContactCouple>& made);

  ContactState& contact_;
  // On one of several ranks: all couples of the last search and of choose_again(), in order, and what fracture has
  // made since.
  std::vector<ContactCouple> all_, made_since_;
};

}  // namespace breccia
