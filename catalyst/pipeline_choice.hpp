#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "catalyst/parameter.hpp"
#include "catalyst/selection.hpp"

namespace breccia::insitu {

enum class PipelineKind { extract, history, probes, script, live };

/// See BrecciaProbe.
struct Probe {
  std::string name;
  std::array<double, 3> at{}, along{}, across{};
  int points = 1, rows = 1;
};

/// A pipeline of the configuration, as found.
struct PipelineChoice {
  std::string name;  ///< as given
  PipelineKind kind = PipelineKind::extract;
  int channel = 0;             ///< of an extract
  std::filesystem::path file;  ///< of a script
  bool ready = false;          ///< a script of our own, catalyst/pipelines/NAME.py
  std::string folder;  ///< below the folder of the run: the channel, or the script's name without .py; empty: none
  std::uint32_t channels = 0;  ///< as given
  Parameters parameters;
  Selection selection;
  std::vector<Probe> probes;
};

/// Names of the pipelines that need no path: those in C++, then those of catalyst/pipelines.
[[nodiscard]] std::vector<std::string> pipeline_names();

/// Finds what a pipeline of the configuration is. Throws PipelineError when there is none of that name.
[[nodiscard]] PipelineChoice choose(const BrecciaPipeline& pipeline);

}  // namespace breccia::insitu
