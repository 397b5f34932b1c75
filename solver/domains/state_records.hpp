#pragma once

#include "domains/domain.hpp"
#include "state/records.hpp"
#include "state/state_hash.hpp"

namespace breccia {

// Between the state in the layout of the kernels and its records, element by element.

/// All that this rank's originals remember, ascending by element; between two steps. O(elements + lists).
[[nodiscard]] Records records_of(const Domain& domain);

/// Nodes, element fields and joints as the records have them, with the links of the joints. Contact takes its own
/// (ContactSearch). @pre records of the elements of model.mesh; state and derived as at rest
void restore(const Records& records, const Model& model, State& state, Derived& derived);

/// After begin_stage of a stage that had begun before: displacements count from where they did.
void restore_holds(Domain& domain, const Records& records);

/// Hash of the whole state, the same for any number of ranks: every field of the table that is marked as hashed, of all
/// originals of all ranks, and those of the model. Collective. O(elements), no second copy of the state.
[[nodiscard]] StateHash hash_of(const Domain& domain);

}  // namespace breccia
