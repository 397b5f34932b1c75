#pragma once

#include "parallel/communicator.hpp"

namespace breccia {

/// Warns on stderr where ranks share cores: it works, slowly. Collective.
void warn_of_oversubscription(const Communicator& world);

}  // namespace breccia
