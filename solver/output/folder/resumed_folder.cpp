#include "output/folder/resumed_folder.hpp"

#include <fmt/format.h>

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

void remove_stale(const fs::path& path) {
  const std::string why = remove_file(path, Depth::file);
  if (!why.empty()) throw output_error(path, "cannot remove this file of the run so far: " + why);
}

/// The lines from which a run continues, of the length when the checkpoint was written. Checked before anything is
/// changed.
void demand_lines(const fs::path& file, std::int64_t bytes, const Checkpoint& from) {
  std::error_code error;
  const bool there = fs::is_regular_file(fs::symlink_status(file, error));
  if (there && static_cast<std::int64_t>(fs::file_size(file, error)) >= bytes && !error) return;
  Problem problem;
  problem.file = file.string();
  problem.what = there ? "this file has lost lines that were written before the checkpoint"
                       : "this file is missing, with its lines from before the checkpoint";
  problem.allowed = fmt::format(
      "the file as the run left it; or, without it, a new run: a case with [start] from = this run, step = {}",
      from.model.clock.steps);
  throw OutputError(problem);
}

}  // namespace

void demand_own_run(const RunFolder& folder, const fs::path& file, const Checkpoint& from) {
  const std::optional<std::string> own = regular_content(folder.provenance());
  if (!own || run_in(*own) == run_in(from.provenance)) return;
  throw InputError(Problem{file.string(), 0, "checkpoint",
                           "this checkpoint is of another run than the files of this folder, whose history it would "
                           "continue",
                           "checkpoints that this run has written; or a case with [start] from = this file, which "
                           "starts a new run from it",
                           ""});
}

bool is_complete(const RunFolder& folder, std::int64_t steps) {
  const auto json = json_of_file<nlohmann::json>(folder.summary());
  return json.is_object() && json.value("status", nlohmann::json()) == "complete" &&
         json.value("steps", nlohmann::json()) == steps;
}

RunFolder prepare_resumed_folder(const RunFolder& run, const fs::path& root, const Checkpoint& from,
                                 const std::string& resolved_case, const Provenance& provenance) {
  demand_plain_tree(run.extracts());
  demand_lines(run.history(), from.position.marks.history_bytes, from);
  demand_lines(run.status(), from.position.marks.status_bytes, from);
  std::error_code error;
  if (!fs::equivalent(run.root, root, error)) {
    refuse_inside(root, run.root, "this folder lies in that of the run, which would be copied into itself");
    RunFolder folder = prepare_run_folder(root, resolved_case, provenance, OldResults::keep);
    copy_regular(run.history(), folder.history());
    copy_regular(run.status(), folder.status());
    copy_tree(run.frames(), folder.frames());
    copy_tree(run.extracts(), folder.extracts());
    if (fs::exists(run.extract_steps(), error)) copy_regular(run.extract_steps(), folder.extract_steps());
    cut_extracts_back(folder.extracts(), folder.extract_steps(), from.model.clock.steps);
    return folder;
  }
  const RunFolder folder{root, std::make_shared<const RunLock>(root)};
  // Later checkpoints first: as long as one is there, the files must not be cut back to an earlier one.
  remove_checkpoints_after(folder.checkpoints(), from.model.clock.steps);
  for (const fs::path& path :
       {folder.summary(), folder.summary_text(), folder.control(), temporary_of(folder.control())})
    remove_stale(path);
  cut_extracts_back(folder.extracts(), folder.extract_steps(), from.model.clock.steps);
  write_file_atomically(folder.case_file(), resolved_case);
  fs::create_directories(folder.frames(), error);
  return folder;
}

}  // namespace breccia
