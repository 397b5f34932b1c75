#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "case/case.hpp"
#include "domains/element_sizes.hpp"
#include "parallel/communicator.hpp"
#include "parallel/domain_topology.hpp"
#include "state/records.hpp"

namespace breccia {

/// Another rank that has originals of this one as proxies or the other way round; both sides list the same ids,
/// ascending.
struct SharedElements {
  int rank = 0;
  std::vector<GlobalId> send;     ///< originals that are proxies there
  std::vector<GlobalId> receive;  ///< proxies whose originals are there
};

/// What a rank works on until the next decomposition.
struct Piece {
  Records records;                         ///< originals and proxies
  std::vector<std::uint8_t> original;      ///< (elements) 1: this rank's own
  std::vector<SharedElements> neighbours;  ///< ascending ranks
};

/// How far the proxies reach.
///
/// A rank holds every element whose box comes within distance() of the box around its originals. Until nodes have moved
/// by more than allowed_motion() since, beside what all have moved together, that is enough for the same bits as on one
/// rank:
/// - what touches an original then is within twice that motion, the margin;
/// - a point that comes to an original brings its contact history since the last search, when its rank sent what it
///   touched. Since then neither it nor any element has moved by more than half the buffer of the search, so that all
///   it touched is within two buffers more;
/// - around such elements corner clusters are complete, since what is bonded to them at a vertex is no further away
///   than the size of these: a ring, or two around shared nodes, where what touches any element of a node counts;
/// - the stable step of contact on shared nodes (contact_step.cpp) comes from the faces at the nodes of an original,
///   the nodes of these, and twice more so: three rings around it, wherever they have moved.
struct Reach {
  double margin = 0;   ///< m
  double buffers = 0;  ///< m, two of the largest
  int rings = 1;       ///< of elements
  int step_rings = 0;  ///< of elements, for the stable step; no fewer than `rings` if there are any

  [[nodiscard]] double allowed_motion() const { return margin / 2; }
  /// Of an element. @param size  m, largest of the elements up to most_rings() away from it (sizes_around)
  [[nodiscard]] double distance(double size) const {
    return std::max(margin + buffers + rings * size, step_rings * size);
  }
  [[nodiscard]] int most_rings() const { return std::max(rings, step_rings); }
};

/// @param edge    m, mean over the elements of their longest
/// @param buffer  m, largest that a search may choose
[[nodiscard]] Reach reach_of(const case_::Case& input, double edge, double buffer);

/// How far each element of this rank reaches, m. Collective. @param vertices, size  of sizes_around
[[nodiscard]] std::vector<double> distances(const Communicator& communicator,
                                            std::span<const std::array<GlobalId, 4>> vertices, std::vector<double> size,
                                            const Reach& reach);

/// Settings of the case.
[[nodiscard]] DomainSpec domain_spec(const case_::Case& input);

/// Gives every element to the domain it lies in and every rank the proxies it needs. Collective.
/// @param domains a grid is fixed by the first call
/// @param mine    this rank's originals, in their present state; on the first call all elements on one rank
/// @param weight  (elements of mine) relative cost
/// @param sizes   of all elements, in their present state
/// O(elements log elements) and two exchanges of elements, those that change hands and proxies.
/// Throws on all ranks what assign_domains throws.
[[nodiscard]] Piece decompose(const Communicator& communicator, DomainSpec& domains, Records mine,
                              const std::vector<double>& weight, const Sizes& sizes, const Reach& reach);

}  // namespace breccia
