#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "catalyst/parameter.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/selection.hpp"

namespace breccia::insitu {

/// Requirements of a script by its text, found by python/check_script.py.
struct ScriptNeeds {
  bool draws = false;
  std::uint32_t channels = 0;  ///< mask of the channels that it names; all when it names none
  KnownParameters parameters;
  bool any_parameter = false;         ///< it computes names of parameters
  std::vector<std::string> problems;  ///< sources and arrays that no run has, a line each
  std::string lacks;  ///< what the interpreter that has read it lacks to run it, and what to do; empty: nothing
};

/// Reads a script, in a Python interpreter of its own (some 50 ms); no Python starts in this process. Not collective.
/// Throws PipelineError when it is missing, cannot be read or does not compile, and when there is no interpreter.
/// @param selection  of what the script is handed
[[nodiscard]] ScriptNeeds check_script(const std::filesystem::path& script, const Selection& selection = {});

/// What the scripts among the pipelines of a run need.
struct RunScripts {
  std::vector<std::uint32_t> channels;  ///< masks by pipeline; 0: no script
  std::uint32_t draw = 0;               ///< mask of the pipelines that make pictures
};

/// The first rank reads them for all: one file, one answer. Collective. Throws PipelineError, on all ranks.
[[nodiscard]] RunScripts read_scripts(const Ranks& ranks, const BrecciaConfig& config);

}  // namespace breccia::insitu
