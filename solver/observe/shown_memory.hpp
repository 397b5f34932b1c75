#pragma once

#include <vector>

#include "domains/domain.hpp"

namespace breccia {

/// A scalar that elements of some law remember, and that is shown.
struct ShownNumber {
  const char* name;
  BulkLaw law;
  std::size_t place;  ///< in the memory of the law

  /// Of an element; 0 where its law is another.
  [[nodiscard]] double of(const Domain& domain, Index slot) const;
};

/// Of all laws in the model, alike on all ranks.
[[nodiscard]] std::vector<ShownNumber> shown_numbers(const Model& model);

}  // namespace breccia
