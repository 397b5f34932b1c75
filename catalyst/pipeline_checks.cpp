#include "catalyst/pipeline_checks.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>

#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {
namespace {

constexpr std::int32_t kMostPipelines = 32;

/// "" when files can be made in the folder; permissions alone do not tell (root, read-only and full file systems).
std::string folder_problem(const char* folder) {
  const std::string path = folder == nullptr ? "" : folder;
  if (path.empty() || path[0] != '/')
    return "the folder of in-situ output must be an absolute path, it is '" + path + "'";
  std::string probe = path + "/.writable_XXXXXX";
  const int descriptor = ::mkstemp(probe.data());
  if (descriptor < 0) return path + ": cannot be written into: " + std::strerror(errno);
  ::close(descriptor);
  ::unlink(probe.c_str());
  return {};
}

}  // namespace

void check_parameters(const PipelineChoice& choice, const std::set<std::string>& known,
                      std::vector<std::string>& problems) {
  for (const auto& [name, value] : choice.parameters) {
    if (known.contains(name)) continue;
    std::string text = choice.name + ": knows no parameter '" + name + "'";
    if (known.empty()) text += ", it has none";
    const char* separator = "; allowed: ";
    for (const std::string& other : known) {
      text += separator + other;
      separator = ", ";
    }
    problems.push_back(text);
  }
}

std::vector<std::string> problems_of_pipelines(const BrecciaConfig& config, const PipelineCheck& check) {
  if (config.abi_version != BRECCIA_INSITU_ABI_VERSION)
    return {"the program and its in-situ adaptor do not belong together (interface " +
            std::to_string(config.abi_version) + " and " + std::to_string(BRECCIA_INSITU_ABI_VERSION) +
            "); build both anew"};
  std::vector<std::string> problems;
  if (config.num_pipelines < 1 || config.num_pipelines > kMostPipelines)
    problems.push_back("there must be 1 to 32 pipelines, there are " + std::to_string(config.num_pipelines));
  if (std::string problem = folder_problem(config.folder); !problem.empty()) problems.push_back(std::move(problem));
  std::map<std::string, std::string> writers;  // folder -> pipeline
  for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
    try {
      const PipelineChoice choice = choose(config.pipelines[i]);
      const auto [writer, is_new] = writers.try_emplace(choice.folder, choice.name);
      if (!is_new) problems.push_back(choice.name + ": writes into the same folder as the pipeline " + writer->second);
      check(choice, problems);
    } catch (const PipelineError& error) {
      const std::string text = error.what();
      const std::string name = config.pipelines[i].name;
      problems.push_back(text.starts_with(name) ? text : name + ": " + text);
    }
  }
  return problems;
}

}  // namespace breccia::insitu
