#include "output/folder/run_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/folder_tree.hpp"
#include "output/folder/json_text.hpp"
#include "output/folder/run_lock.hpp"
#include "output/insitu/extracts_cut.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "breccia";

/// True for a folder in which a run was prepared: its provenance names this program.
bool is_run(const RunFolder& folder) {
  const auto json = json_of_file<nlohmann::json>(folder.provenance());
  return json.is_object() && json.value("program", nlohmann::json()) == kProgram;
}

/// Every file in the folder that a run wrote as a result, but for extracts and checkpoints.
std::vector<fs::path> results_in(const RunFolder& folder) {
  std::vector<fs::path> results;
  std::error_code error;
  for (const fs::path& path :
       {folder.history(), folder.bodies(), temporary_of(folder.bodies()), folder.status(), folder.summary(),
        temporary_of(folder.summary()), folder.summary_text(), temporary_of(folder.summary_text()),
        folder.extract_steps(), temporary_of(folder.extract_steps()), folder.control(),
        temporary_of(folder.control())}) {
    if (fs::exists(fs::symlink_status(path, error))) results.push_back(path);
  }
  fs::directory_iterator entries(folder.frames(), error);
  if (error) return results;
  for (const fs::directory_entry& entry : entries) {
    if (is_frame_file(entry.path().filename().string())) results.push_back(entry.path());
  }
  return results;
}

/// Nothing but the lock of a run that never began.
bool holds_nothing(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw output_error(folder, "cannot read this folder", error.value());
  return std::all_of(begin(entries), end(entries),
                     [&](const fs::directory_entry& entry) { return entry.path() == lock_file(folder); });
}

void refuse(const fs::path& path, const std::string& what, const std::string& allowed) {
  Problem problem;
  problem.file = path.string();
  problem.what = what;
  problem.allowed = allowed;
  throw OutputError(problem);
}

}  // namespace

std::filesystem::path default_run_folder(const fs::path& case_file) {
  return fs::path("runs") / fs::absolute(case_file).lexically_normal().parent_path().filename();
}

std::vector<Provenance::Input> inputs_in(const std::string& provenance) {
  std::vector<Provenance::Input> inputs;
  try {
    const auto json = json_of_text<nlohmann::json>(provenance);
    for (const auto& entry : json.at("inputs")) inputs.push_back({entry.at("file"), entry.at("sha256")});
  } catch (const nlohmann::json::exception&) {
    return inputs;
  }
  return inputs;
}

std::string run_in(const std::string& provenance) {
  const auto json = nlohmann::json::parse(provenance, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("run") || !json["run"].is_string()) return {};
  return json["run"].get<std::string>();
}

std::vector<Provenance::Parent> parents_in(const std::string& provenance) {
  std::vector<Provenance::Parent> parents;
  try {
    const auto json = json_of_text<nlohmann::json>(provenance);
    for (const auto& entry : json.at("parents"))
      parents.push_back({entry.at("file"), entry.at("sha256"), entry.at("step"), entry.at("time")});
  } catch (const nlohmann::json::exception&) {
    return parents;
  }
  return parents;
}

std::string provenance_json(const Provenance& provenance) {
  nlohmann::ordered_json json;
  json["program"] = kProgram;
  json["version"] = provenance.version;
  json["run"] = provenance.run;
  json["started"] = provenance.started;
  json["command_line"] = provenance.command_line;
  json["commit"] = provenance.commit;
  json["libraries"] = provenance.libraries;
  json["ranks"] = provenance.ranks;
  json["inputs"] = nlohmann::json::array();
  for (const Provenance::Input& input : provenance.inputs)
    json["inputs"].push_back({{"file", input.file}, {"sha256", input.sha256}});
  for (const Provenance::Parent& parent : provenance.parents)
    json["parents"].push_back(
        {{"file", parent.file}, {"sha256", parent.sha256}, {"step", parent.step}, {"time", parent.time}});
  json["host"] = provenance.host;
  json["processor"] = provenance.processor;
  json["cores"] = provenance.cores;
  json["compiler"] = provenance.compiler;
  json["flags"] = provenance.flags;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

RunFolder prepare_run_folder(const fs::path& root, const std::string& resolved_case, const Provenance& provenance,
                             OldResults old_results) {
  RunFolder folder{root};
  create_folder(root);
  demand_plain_folder(folder);
  if (!holds_nothing(root) && !is_run(folder)) {
    refuse(root, "this folder holds other things than a run of breccia",
           "an empty or new folder, or one of an earlier run");
  }
  folder.lock = std::make_shared<const RunLock>(root);
  const std::vector<fs::path> results = results_in(folder);
  const auto exists = [](const fs::path& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
  };
  const bool has_results = !results.empty() || exists(folder.extracts()) || exists(folder.checkpoints());
  if (has_results && old_results != OldResults::overwrite) {
    refuse(root, "this folder holds the results of an earlier run",
           old_results == OldResults::keep ? "another folder (-o)"
                                           : "another folder (-o), or -f (--overwrite) to replace them");
  }
  if (has_results && old_results == OldResults::overwrite) {
    remove_extracts(folder.extracts(), folder.extract_steps());
    remove_checkpoints(folder.checkpoints());
    for (const fs::path& path : results) {
      const std::string why = remove_file(path, path.parent_path() == root ? Depth::file : Depth::subfolder);
      if (!why.empty()) throw output_error(path, "cannot remove this old result: " + why);
    }
  }
  // Provenance first: it marks the folder as ours, should the rest fail.
  write_file_atomically(folder.provenance(), provenance_json(provenance));
  write_file_atomically(folder.case_file(), resolved_case);
  create_folder(folder.frames());
  return folder;
}

}  // namespace breccia
