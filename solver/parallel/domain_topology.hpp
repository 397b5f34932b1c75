#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

enum class DomainKind { grid, rcb };

/// How space is divided among the ranks.
struct DomainSpec {
  DomainKind kind = DomainKind::rcb;
  std::array<int, 3> n{0, 0, 0};  ///< grid: domains along each axis; all 0: chosen so that least area is cut
  std::string file;               ///< of the case, and line, for messages
  int line = 0;
};

/// Axis-parallel box.
struct DomainBox {
  std::array<double, 3> lower, upper;  ///< m; lower > upper: empty
};

/// Domains along each axis of a grid of `parts`: those asked for, or the factorisation that cuts the least area.
/// @param longest_edge  m, of the largest element
/// Throws InputError when the product of n is not `parts`, or when a domain would be smaller than the largest element; it
/// names the largest grid that fits.
[[nodiscard]] std::array<int, 3> grid_of(const DomainSpec& spec, int parts, const DomainBox& box, double longest_edge);

/// Domain of each element handed in. Collective: elements may lie on the ranks in any way, the answer does not depend on it.
///
/// grid: equal cuboids of the box around all centroids. Source: [Schiava 2009, ch. 9]
/// rcb: recursive bisection of weight; each cut is normal to the longest side of the part's box, and lies where the weights of
/// both sides are as the numbers of domains they get. Our own: a library's cuts depend on how elements are spread, and it
/// needs MPI in a process that is alone. A little more weight on one side moves the cuts a little, so few elements change
/// hands. O(elements log parts), four reductions of 2 kB a part and level.
/// @param weight  (elements) >= 0, relative cost
/// Throws InputError as grid_of, and if there are fewer elements than domains.
[[nodiscard]] std::vector<int> assign_domains(const Communicator& communicator, const DomainSpec& spec, int parts,
                                              std::span<const Vec3> centroid, std::span<const double> weight, double longest_edge);

}  // namespace breccia
