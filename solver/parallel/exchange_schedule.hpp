#pragma once

#include <compare>
#include <vector>

namespace breccia {

/// Two ranks that exchange something; a < b.
struct RankPair {
  int a = 0, b = 0;
  friend auto operator<=>(const RankPair&, const RankPair&) = default;
};

/// The order in which pairs of ranks exchange: steps, in each of which a rank meets at most one other.
/// A step is a colour of the edges of the graph of neighbours. At most one step more than a rank has neighbours, the
/// bound of Vizing; colours by fans and alternating paths. Depends on the set of pairs alone, not on their order.
/// Source: couples after [Schiava, 9]; colours [Misra and Gries 1992].
/// @param pairs  in any order; twice the same counts once
/// @return pairs by step, ascending in each
/// @pre 0 <= a < b. Cost: O(pairs x (ranks + neighbours^2)). Throws InternalError where a pair is none.
[[nodiscard]] std::vector<std::vector<RankPair>> exchange_schedule(std::vector<RankPair> pairs);

}  // namespace breccia
