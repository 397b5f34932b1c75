#pragma once

#include <string>
#include <vector>

#include "domains/domain.hpp"

namespace breccia {

/// What users call the bodies: by the group of the mesh, and by the number as well where the group has several:
/// "plate", "blocks (body 12)". On the first rank; empty on others. Collective. O(elements + bodies).
[[nodiscard]] std::vector<std::string> body_names(const Domain& domain);

/// @param group_of_body  (bodies) index into groups; -1: in none
[[nodiscard]] std::vector<std::string> body_names(const std::vector<Index>& group_of_body,
                                                  const std::vector<std::string>& groups);

}  // namespace breccia
