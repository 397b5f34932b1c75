#pragma once

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Bytes that a mesh and what is known of it as a whole take, at least. O(1)
[[nodiscard]] double mesh_bytes(double elements);

/// Bytes that a run of a model takes at least, all its ranks together: what `breccia check` finds for one rank.
/// O(groups + elements).
[[nodiscard]] double model_bytes(const Model& model);

/// Refuses what would fill the memory that this machine has available, before it is asked for.
/// @param elements  for the message;  @param bytes  that will be asked for
/// Throws InputError.
void demand_memory(const case_::Case& input, double elements, double bytes);

}  // namespace breccia
