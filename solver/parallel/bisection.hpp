#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Recursive coordinate bisection (domain_topology.hpp). Collective. @pre parts >= 1
[[nodiscard]] std::vector<int> bisect(const Communicator& communicator, int parts, std::span<const Vec3> centroid,
                                      std::span<const double> weight);

}  // namespace breccia
