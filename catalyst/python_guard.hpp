#pragma once

#include <filesystem>
#include <string>

#include "catalyst/parameter.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/script_watch.hpp"

namespace breccia::insitu::python {

/// What scripts may know of the run.
struct About {
  std::string title;    ///< of the case
  double end = 0;       ///< s, simulated; 0: unknown
  double strength = 0;  ///< Pa; 0: unknown
};

/// Starts Python in this process and puts python/breccia_guard.py between ParaView and the scripts: what a script
/// raises is kept as one line instead of being printed, on all ranks when on any; SystemExit does not end the process;
/// what it writes to stdout and stderr goes to its log (python/breccia_output.py).
/// `pipelines` and `guard` are put on the search path of modules. Idempotent. Throws PipelineError. @pre ranks and
/// watch outlive all use of Python
void start(const std::filesystem::path& pipelines, const std::filesystem::path& guard, const Ranks& ranks,
           ScriptWatch& watch);

/// Sets the pipeline that runs from now on in breccia_insitu.py. Throws PipelineError.
void enter(const std::string& name, const std::filesystem::path& script, const std::filesystem::path& folder,
           const Parameters& parameters, const About& about);

/// What the script that runs raised since the last call: "TypeError: what (script.py:12)"; empty: nothing. Throws
/// Abandoned when other ranks have not come out of it in time.
[[nodiscard]] std::string take_error();

/// Whether ParaView can execute the script that runs: not after a failure of its import or of its catalyst_initialize.
[[nodiscard]] bool usable();

/// Adds a warning of VTK's, or an error for its log alone, to the output of the script that runs.
enum class Output { warning, log };
void add_output(const std::string& text, Output kind);

/// Lines of the script's output since the last call, on this rank; see Pipeline::notice. Collective.
[[nodiscard]] std::string take_output(const std::filesystem::path& folder);

}  // namespace breccia::insitu::python
