#include "catalyst/script_check.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>

#include "catalyst/channel_names.hpp"
#include "catalyst/child_process.hpp"
#include "catalyst/folders.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

}  // namespace

ScriptNeeds check_script(const std::filesystem::path& script, const Selection& selection) {
  if (script.extension() != ".py") throw PipelineError(script.string() + ": a script's name ends with .py");
  if (::access(script.c_str(), R_OK) != 0) throw PipelineError(script.string() + ": " + std::strerror(errno));
  const std::filesystem::path folder = data_folder();
  // -E -s: nothing of the user's Python environment matters; -B: no files are left behind.
  std::vector<std::string> command{
      BRECCIA_PYTHON, "-E", "-s", "-B", folder / "python/check_script.py", script.string(), folder / "pipelines"};
  command.push_back(listed(selection.fields));
  command.push_back(listed(selection.point_fields));
  command.insert(command.end(), kChannelNames.begin(), kChannelNames.end());
  std::istringstream lines(output_of(command));
  ScriptNeeds needs;
  for (std::string line; std::getline(lines, line);) {
    const auto blank = line.find(' ');
    const std::string word = line.substr(0, blank);
    const std::string text = blank == std::string::npos ? std::string() : line.substr(blank + 1);
    if (word == "error")
      throw PipelineError(text.find(script.filename().string()) == std::string::npos ? script.string() + ": " + text
                                                                                     : text);
    if (word == "draws") needs.draws = true;
    if (word == "lacks") needs.lacks = text;
    if (word == "channel") needs.channels |= bit(channel_of(text));
    if (word == "problem") needs.problems.push_back(text);
    if (word == "any_parameter") needs.any_parameter = true;
    if (word == "parameter") needs.parameters[text].insert(ParameterKind::any);
    if (word == "number") needs.parameters[text].insert(ParameterKind::number);
    if (word == "text") needs.parameters[text].insert(ParameterKind::text);
  }
  if (needs.channels == 0) needs.channels = kAllChannels;
  return needs;
}

RunScripts read_scripts(const Ranks& ranks, const BrecciaConfig& config) {
  RunScripts scripts;
  scripts.channels.assign(static_cast<std::size_t>(config.num_pipelines), 0);
  std::string error;
  std::int64_t draw = 0;
  for (std::int32_t i = 0; ranks.is_root() && i < config.num_pipelines; ++i) {
    try {
      const PipelineChoice choice = choose(config.pipelines[i]);
      if (choice.kind != PipelineKind::script) continue;
      const ScriptNeeds needs = check_script(choice.file);
      scripts.channels[static_cast<std::size_t>(i)] = needs.channels;
      if (needs.draws) draw |= std::int64_t{bit(i)};
    } catch (const std::exception& failure) {
      error = failure.what();
    }
  }
  ranks.throw_agreed(error);
  for (std::uint32_t& mask : scripts.channels) mask = static_cast<std::uint32_t>(ranks.from_root(std::int64_t{mask}));
  scripts.draw = static_cast<std::uint32_t>(ranks.from_root(draw));
  return scripts;
}

}  // namespace breccia::insitu
