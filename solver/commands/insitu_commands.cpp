#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/reader.hpp"
#include "commands/commands.hpp"
#include "commands/terminal.hpp"
#include "output/folder/control.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/run_folder.hpp"
#include "output/insitu/insitu_config.hpp"
#include "output/insitu/insitu_plugin.hpp"
#include "system/atomic_file.hpp"

namespace breccia {

int control_command(const ControlCommand& asked) {
  const Command command = parse_command(asked.command);
  if (command.kind == Command::Kind::refused)
    throw InputError(Problem{"", 0, asked.command, command.complaint, "", ""});
  print_lines(ask_run(asked.folder, command.text, asked.patience) + ": done\n");
  return 0;
}

namespace {

/// Of NAME=VALUE.
std::map<std::string, case_::Setting> settings_of(const std::vector<std::string>& assignments) {
  std::map<std::string, case_::Setting> settings;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    settings[assignment.substr(0, equals)] = case_::read_setting(assignment.substr(equals + 1));
  }
  return settings;
}

}  // namespace

int replay_command(const ReplayCommand& asked, const Communicator& world) {
  const std::filesystem::path folder =
      std::filesystem::absolute(asked.folder.empty() ? asked.run / "replay" : asked.folder);
  case_::Case input;
  input.title = "replay of " + asked.run.string();
  for (const std::string& name : asked.pipelines) {
    case_::Pipeline& pipeline = input.insitu.pipelines.emplace_back();
    pipeline.name = case_::is_script(name) ? std::filesystem::absolute(name).string() : name;
    pipeline.parameters = settings_of(asked.parameters);
  }
  world.agree([&] {
    if (!world.is_root()) return;
    demand_plain_folder(RunFolder{asked.run});
    refuse_inside(folder, RunFolder{asked.run}.extracts(), "this folder lies in that of the records to be replayed");
    if (asked.folder.empty()) demand_plain_tree(folder);
    create_folder(folder);
  });
  std::optional<InSituPlugin> plugin;
  world.agree([&] { plugin.emplace(case_::InSituBackend::paraview); });
  const InSituConfig config(input, folder, world);
  const auto checked = [&](auto&& call) {
    std::int32_t result = 0;
    const std::string text = answer_of([&](char* words, std::size_t size) { result = call(words, size); });
    world.agree([&] {
      if (result != 0) throw InputError(insitu_problems({}, text));
    });
    return text;
  };
  static_cast<void>(
      checked([&](char* words, std::size_t size) { return plugin->api().preflight(&config.get(), words, size); }));
  const std::string records = std::filesystem::absolute(RunFolder{asked.run}.extracts()).string();
  const std::string notices = checked(
      [&](char* words, std::size_t size) { return plugin->api().replay(&config.get(), records.c_str(), words, size); });
  if (!world.is_root()) return 0;
  for_each_notice(notices, [](const std::string& line, bool warns) {
    if (warns) return print_warning(line);
    print_lines(line + "\n");
  });
  print_lines("results in " + folder.string() + "\n");
  return 0;
}

int insitu_info_command() {
  bool usable = false;
  std::optional<OutputError> first;
  for (const auto& [name, backend] : {std::pair{"paraview", case_::InSituBackend::paraview},
                                      std::pair{"catalyst2", case_::InSituBackend::catalyst2}}) {
    try {
      const InSituPlugin plugin(backend);
      const std::string found = plugin.found();
      print_lines(fmt::format("{}: {}\n{}\n", name, found, InSituPlugin::place(backend).string()));
      usable = true;
    } catch (const OutputError& error) {
      print_lines(fmt::format("{}: not usable: {}\n", name, error.what()));
      if (!first) first = error;
    }
  }
  if (!usable) throw OutputError(*first);
  return 0;
}

}  // namespace breccia
