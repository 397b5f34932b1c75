#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

enum class DomainKind { grid, rcb };

/// How space is divided among the ranks.
struct DomainSpec {
  DomainKind kind = DomainKind::rcb;
  std::array<int, 3> n{0, 0, 0};  ///< grid: domains along each axis; 0: chosen so that least is cut
};

/// Owner of each element handed in. Collective.
[[nodiscard]] std::vector<int> assign_domains(const Communicator& communicator, const DomainSpec& spec, int parts,
                                              std::span<const Vec3> centroid, std::span<const double> weight);

}  // namespace breccia
