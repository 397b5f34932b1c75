#pragma once

#include "parallel/communicator.hpp"
#include "state/state.hpp"

namespace breccia {

// The model's rows of the table of fields, between the ranks' parts and the whole.

/// The rows of the whole model: sums, largest numbers and lists over all ranks. Sums are exact. Collective; the same on
/// all ranks.
/// @param part  this rank's rows (closed_fields)
[[nodiscard]] State whole_fields(const Communicator& communicator, const State& part);

/// Initial state of a rank when a run continues from the whole model: the root stores sums and lists, the other ranks
/// none.
[[nodiscard]] State part_of_whole(const State& whole, bool root);

}  // namespace breccia
