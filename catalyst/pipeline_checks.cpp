#include "catalyst/pipeline_checks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include "catalyst/pipeline_error.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

constexpr std::int32_t kMostPipelines = 32;

/// "" when files can be made in the folder; permissions alone are not sufficient (root, read-only and full file
/// systems).
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

std::vector<std::string> nearest_first(const std::string& word, const KnownParameters& known) {
  std::vector<std::string> words;
  for (const auto& [name, kinds] : known) words.push_back(name);
  std::stable_sort(words.begin(), words.end(),
                   [&](const std::string& a, const std::string& b) { return distance(word, a) < distance(word, b); });
  return words;
}

}  // namespace

void check_parameters(const PipelineChoice& choice, const KnownParameters& known, std::vector<std::string>& problems) {
  for (const auto& [name, value] : choice.parameters) {
    if (const auto asked = known.find(name); asked != known.end()) {
      const std::string begin = choice.name + ": the parameter '" + name + "' is a ";
      if (asked->second.contains(ParameterKind::text) && !value.text)
        problems.push_back(begin + "text; given: " + exact(value.number));
      if (asked->second.contains(ParameterKind::number) && !value.is_number())
        problems.push_back(begin + "number, or a text with a unit; given: \"" + one_line(*value.text) + "\"");
      continue;
    }
    std::string text = choice.name + ": has no parameter '" + name + "'";
    if (known.empty()) text += ", it has none";
    const char* separator = "; allowed: ";
    for (const std::string& other : nearest_first(name, known)) {
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
