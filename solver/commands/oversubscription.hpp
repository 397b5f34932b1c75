#pragma once

#include "case/case.hpp"
#include "model/model.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Refuses a model whose parts would fill the memory of a machine, before they are made; a rank that is alone has done
/// so (model/memory_demand.hpp). Collective. Throws InputError, on all ranks.
/// @param model  on the root; may be null elsewhere
void demand_memory_of_ranks(const case_::Case& input, const Model* model, const Communicator& world);

/// Warns on stderr where ranks share cores: it works, slowly. Collective.
void warn_of_oversubscription(const Communicator& world);

}  // namespace breccia
