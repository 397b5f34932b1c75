#pragma once

#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"

namespace breccia::insitu {

/// Paths of libcatalyst and of the file of its implementation, a line each. Throws PipelineError with the missing one.
[[nodiscard]] std::string found_catalyst2();

/// Everything that keeps the pipelines of a configuration from running over Catalyst 2; see preflight of
/// BrecciaInsituApi. Not collective; starts nothing.
[[nodiscard]] std::vector<std::string> catalyst2_problems_of(const BrecciaConfig& config);

}  // namespace breccia::insitu
