#pragma once

#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"

namespace breccia::insitu {

/// Everything that keeps the pipelines of a configuration from running, as far as it shows before they do; see
/// preflight of BrecciaInsituApi. Not collective; starts neither MPI nor Python.
[[nodiscard]] std::vector<std::string> problems_of(const BrecciaConfig& config);

}  // namespace breccia::insitu
