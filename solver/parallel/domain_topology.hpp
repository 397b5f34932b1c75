#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

enum class DomainKind { grid, rcb };

/// Axis-parallel box.
struct DomainBox {
  std::array<double, 3> lower, upper;  ///< m; lower > upper: empty
};

/// How space is divided among the ranks.
struct DomainSpec {
  DomainKind kind = DomainKind::rcb;
  std::array<int, 3> n{0, 0, 0};  ///< grid: domains along each axis; 0: chosen so that least area is cut
  std::string file;               ///< of the case, and line, for messages
  int line = 0;
  std::optional<DomainBox> box;  ///< grid: the box that n divides, once it is fixed; outer domains extend to infinity
};

/// Domains along each axis of a grid of `parts`: the factorisation that agrees with the given numbers, fits and cuts
/// the least area; among equals the one with the fewest domains along x, then y.
/// @param box  of the centroids;  @param longest_edge  m, of the largest element
/// Throws InputError when no product of n is `parts`, with all factorisations; or when a domain would be smaller than
/// the largest element, with the largest grid that fits.
[[nodiscard]] std::array<int, 3> grid_of(const DomainSpec& spec, int parts, const DomainBox& box, double longest_edge);

/// A grid with fixed n and box: its domains do not move while bodies move. rcb: unchanged. Collective. Throws as
/// grid_of.
[[nodiscard]] DomainSpec settled(const Communicator& communicator, const DomainSpec& spec, int parts,
                                 std::span<const Vec3> centroid, double longest_edge);

/// Domain of each element handed in. Collective: elements may lie on the ranks in any way, the answer does not depend
/// on it.
///
/// grid: equal cuboids of the box around all centroids, or of the fixed one. Domains may be empty. Source:
/// [Schiava, 9.2.1] rcb: recursive bisection of weight; each cut is normal to the longest side of the part's box (but
/// for a slope of 1e-4 that parts elements in one plane), and lies where the weights of both sides are as the numbers
/// of domains they get. Implemented here: the cuts of a library depend on the distribution of the elements, and it
/// needs MPI on a single rank as well. A little more weight on one side moves the cuts a little, so few elements change
/// hands. O(elements log parts), seven reductions of at most 2 kB a part and level.
/// @param weight  (elements) >= 0, relative cost
/// Throws InputError as grid_of unless the grid is fixed, and if there are fewer elements than domains.
[[nodiscard]] std::vector<int> assign_domains(const Communicator& communicator, const DomainSpec& spec, int parts,
                                              std::span<const Vec3> centroid, std::span<const double> weight,
                                              double longest_edge);

}  // namespace breccia
