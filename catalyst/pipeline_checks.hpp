#pragma once

#include <functional>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "catalyst/pipeline_choice.hpp"

namespace breccia::insitu {

/// Adds what keeps one pipeline from running. It may throw PipelineError, which is a problem as well.
using PipelineCheck = std::function<void(const PipelineChoice& choice, std::vector<std::string>& problems)>;

/// Problems of a configuration that every back end has: versions, the number of pipelines, the folder, names, two
/// pipelines of one folder; and those of each pipeline.
[[nodiscard]] std::vector<std::string> problems_of_pipelines(const BrecciaConfig& config, const PipelineCheck& check);

/// Adds a problem for each parameter that is not among those known, which it names, the nearest first, and for each of
/// another kind than required.
void check_parameters(const PipelineChoice& choice, const KnownParameters& known, std::vector<std::string>& problems);

}  // namespace breccia::insitu
