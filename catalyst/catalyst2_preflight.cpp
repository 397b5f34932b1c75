#include "catalyst/catalyst2_preflight.hpp"

#include "catalyst/catalyst2_library.hpp"
#include "catalyst/pipeline_checks.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/script_check.hpp"

namespace breccia::insitu {
namespace {

constexpr const char* kOtherBackend = "the adaptor with ParaView linked, insitu.backend = \"paraview\"";

/// Refuses what Catalyst 2 cannot do, with any implementation. Throws PipelineError.
void demand_possible(const PipelineChoice& choice, bool is_paraview) {
  if (is_paraview && !choice.selection.fields.empty())
    throw PipelineError(
        std::string("ParaView's implementation of Catalyst 2 reads all scripts with the arrays of one of "
                    "them, so that none can have fields of its own; that needs ") +
        kOtherBackend);
  if (!choice.selection.point_fields.empty())
    throw PipelineError(std::string("values at points, point_data, are not passed to Catalyst 2; use ") +
                        kOtherBackend);
  switch (choice.kind) {
    case PipelineKind::probes:
      throw PipelineError(std::string("samples are not made by Catalyst 2; that needs ") + kOtherBackend);
    case PipelineKind::live:
      throw PipelineError(std::string("the live link is not Catalyst 2's; it needs ") + kOtherBackend);
    case PipelineKind::extract:
    case PipelineKind::history:
      if (is_paraview)
        throw PipelineError(std::string("this recording is not made by ParaView's implementation of Catalyst 2; it "
                                        "needs ") +
                            kOtherBackend + ", or a script with an extractor for the channel");
      return;
    case PipelineKind::script:
      if (choice.ready && !is_paraview)
        throw PipelineError("is a script for ParaView, and CATALYST_IMPLEMENTATION_NAME names another implementation");
  }
}

}  // namespace

std::string found_catalyst2() {
  const Catalyst2Library library;
  return "libcatalyst " + library.file().string() + "\nimplementation '" + library.implementation() + "' " +
         library.implementation_file().string();
}

std::vector<std::string> catalyst2_problems_of(const BrecciaConfig& config) {
  bool is_paraview = true;
  std::string missing;
  try {
    const Catalyst2Library library;
    is_paraview = library.is_paraview();
    static_cast<void>(library.implementation_file());
  } catch (const PipelineError& error) {
    missing = error.what();
  }
  std::vector<std::string> problems =
      problems_of_pipelines(config, [&](const PipelineChoice& choice, std::vector<std::string>& found) {
        // Without libcatalyst it is not known whose implementation it would be.
        if (missing.empty()) demand_possible(choice, is_paraview);
        if (choice.kind != PipelineKind::script) return check_parameters(choice, {}, found);
        ScriptNeeds needs = check_script(choice.file);
        for (const std::string& problem : needs.problems) found.push_back(choice.name + ": " + problem);
        // A user's script may get parameters in other ways, and compute their names.
        for (const auto& [name, value] : choice.parameters)
          if (!choice.ready) needs.parameters.try_emplace(name);
        check_parameters(choice, needs.parameters, found);
      });
  if (!missing.empty()) problems.insert(problems.begin(), missing);
  return problems;
}

}  // namespace breccia::insitu
