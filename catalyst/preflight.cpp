#include "catalyst/preflight.hpp"

#include "catalyst/display.hpp"
#include "catalyst/pipeline_checks.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/script_check.hpp"

namespace breccia::insitu {
namespace {

constexpr std::int32_t kLastPort = 65535;

/// True when it makes pictures.
bool check_pipeline(const PipelineChoice& choice, const BrecciaConfig& config, std::vector<std::string>& problems) {
  KnownParameters known;
  bool draws = false;
  if (choice.kind == PipelineKind::script) {
    ScriptNeeds needs = check_script(choice.file, choice.selection);
    if (!needs.lacks.empty()) throw PipelineError(needs.lacks);
    draws = needs.draws;
    known = std::move(needs.parameters);
    if (needs.any_parameter) {
      for (const auto& [name, value] : choice.parameters) known.try_emplace(name);
    }
    for (const std::string& problem : needs.problems) problems.push_back(choice.name + ": " + problem);
  }
  if (choice.kind == PipelineKind::live) {
    if (config.live_host == nullptr || *config.live_host == '\0')
      problems.emplace_back("live: there is no host to connect to");
    if (config.live_port < 1 || config.live_port > kLastPort)
      problems.push_back("live: the port must be 1 to 65535, it is " + std::to_string(config.live_port));
  }
  check_parameters(choice, known, problems);
  return draws;
}

}  // namespace

std::vector<std::string> problems_of(const BrecciaConfig& config) {
  std::string drawing;
  std::vector<std::string> problems =
      problems_of_pipelines(config, [&](const PipelineChoice& choice, std::vector<std::string>& found) {
        if (check_pipeline(choice, config, found) && drawing.empty()) drawing = choice.name;
      });
  if (!drawing.empty()) {
    if (const std::string problem = display_problem(); !problem.empty()) problems.push_back(drawing + ": " + problem);
  }
  return problems;
}

}  // namespace breccia::insitu
