#pragma once

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Bytes that a mesh and what is known of it as a whole take, at least. O(1)
[[nodiscard]] double mesh_bytes(double elements);

/// Bytes that a run of a model takes at least, all its ranks together: what `breccia check` finds for one rank.
/// O(groups + elements).
[[nodiscard]] double model_bytes(const Model& model);

/// Refuses demands beyond the available memory of this machine, before the allocation.
/// @param elements  for the message;  @param bytes  to be allocated
/// Throws InputError.
void demand_memory(const case_::Case& input, double elements, double bytes);

}  // namespace breccia
