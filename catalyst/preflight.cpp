#include "catalyst/preflight.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "catalyst/display.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/script_check.hpp"

namespace breccia::insitu {
namespace {

constexpr std::int32_t kMostPipelines = 32;
constexpr std::int32_t kLastPort = 65535;

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

/// Letters to change, add or leave out between two words.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t corner = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = corner + (a[i - 1] == b[j - 1] ? 0 : 1);
      corner = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::vector<std::string> nearest_first(const std::string& word, const std::set<std::string>& known) {
  std::vector<std::string> words(known.begin(), known.end());
  std::stable_sort(words.begin(), words.end(),
                   [&](const std::string& a, const std::string& b) { return distance(word, a) < distance(word, b); });
  return words;
}

void check_parameters(const PipelineChoice& choice, const std::set<std::string>& known,
                      std::vector<std::string>& problems) {
  for (const auto& [name, value] : choice.parameters) {
    if (known.contains(name)) continue;
    std::string text = choice.name + ": knows no parameter '" + name + "'";
    if (known.empty()) text += ", it has none";
    const char* separator = "; allowed: ";
    for (const std::string& other : nearest_first(name, known)) {
      text += separator + other;
      separator = ", ";
    }
    problems.push_back(text);
  }
}

/// True when it makes pictures.
bool check_pipeline(const PipelineChoice& choice, const BrecciaConfig& config, std::vector<std::string>& problems) {
  std::set<std::string> known;
  bool draws = false;
  if (choice.kind == PipelineKind::script) {
    ScriptNeeds needs = check_script(choice.file);
    draws = needs.draws;
    known = std::move(needs.parameters);
    if (needs.any_parameter) {
      for (const auto& [name, value] : choice.parameters) known.insert(name);
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
  if (config.abi_version != BRECCIA_INSITU_ABI_VERSION)
    return {"the program and its in-situ adaptor do not belong together (interface " +
            std::to_string(config.abi_version) + " and " + std::to_string(BRECCIA_INSITU_ABI_VERSION) +
            "); build both anew"};
  std::vector<std::string> problems;
  if (config.num_pipelines < 1 || config.num_pipelines > kMostPipelines)
    problems.push_back("there must be 1 to 32 pipelines, there are " + std::to_string(config.num_pipelines));
  if (std::string problem = folder_problem(config.folder); !problem.empty()) problems.push_back(std::move(problem));
  std::map<std::string, std::string> writers;  // folder -> pipeline
  std::string drawing;
  for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
    try {
      const PipelineChoice choice = choose(config.pipelines[i]);
      const auto [writer, is_new] = writers.try_emplace(choice.folder, choice.name);
      if (!is_new) problems.push_back(choice.name + ": writes into the same folder as the pipeline " + writer->second);
      if (check_pipeline(choice, config, problems) && drawing.empty()) drawing = choice.name;
    } catch (const PipelineError& error) {
      const std::string text = error.what();
      const std::string name = config.pipelines[i].name;
      problems.push_back(text.starts_with(name) ? text : name + ": " + text);
    }
  }
  if (!drawing.empty()) {
    if (const std::string problem = display_problem(); !problem.empty()) problems.push_back(drawing + ": " + problem);
  }
  return problems;
}

}  // namespace breccia::insitu
