#pragma once

#include <string>
#include <vector>

#include "domains/domain.hpp"

namespace breccia {

/// What users call the bodies: by the groups of the mesh that they consist of, and by the number as well where another
/// body has elements of such a group: "plate", "core + shell", "blocks (body 12)". Of more than three groups the first
/// two are named and the others counted. On the first rank; empty on others. Collective. O(elements + bodies).
[[nodiscard]] std::vector<std::string> body_names(const Domain& domain);

/// @param groups_of_body  (bodies) indices into groups, ascending
[[nodiscard]] std::vector<std::string> body_names(const std::vector<std::vector<Index>>& groups_of_body,
                                                  const std::vector<std::string>& groups);

}  // namespace breccia
