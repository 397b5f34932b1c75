#include "output/resumed_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "output/atomic_file.hpp"
#include "output/checkpoint_writer.hpp"
#include "output/extracts_cut.hpp"
#include "output/run_lock.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

void remove_stale(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw output_error(path, "cannot remove this file of the run so far", error.value());
}

/// Files are linked where that can be done, since those of frames and extracts are written once.
void copy_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::exists(from, error)) return;
  fs::create_directories(to, error);
  for (const auto& entry : fs::recursive_directory_iterator(from, error)) {
    const fs::path target = to / fs::relative(entry.path(), from, error);
    if (entry.is_directory(error)) {
      fs::create_directories(target, error);
      continue;
    }
    const bool written_once = entry.path().extension() == ".vtkhdf";
    if (written_once) fs::create_hard_link(entry.path(), target, error);
    if (!written_once || error) fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing, error);
    if (error) throw output_error(target, "cannot copy this file of the run so far", error.value());
  }
  if (error) throw output_error(to, "cannot copy this folder of the run so far", error.value());
}

void copy_lines(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) throw output_error(to, "cannot copy this file of the run so far", error.value());
}

/// The lines that a run goes on from, as long as they were when the checkpoint was written. Looked at before anything
/// is changed.
void demand_lines(const fs::path& file, std::int64_t bytes, const Checkpoint& from) {
  std::error_code error;
  const bool there = fs::is_regular_file(file, error);
  if (there && static_cast<std::int64_t>(fs::file_size(file, error)) >= bytes && !error) return;
  Problem problem;
  problem.file = file.string();
  problem.what = there ? "this file has lost lines that were written before the checkpoint"
                       : "this file is gone, with its lines from before the checkpoint";
  problem.allowed = fmt::format(
      "the file as the run left it; or, without it, a new run: a case with [start] from = this run, step = {}",
      from.model.clock.steps);
  throw OutputError(problem);
}

}  // namespace

bool is_complete(const RunFolder& folder, std::int64_t steps) {
  std::ifstream file(folder.summary());
  const auto json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  return json.is_object() && json.value("status", nlohmann::json()) == "complete" &&
         json.value("steps", nlohmann::json()) == steps;
}

RunFolder prepare_resumed_folder(const RunFolder& run, const fs::path& root, const Checkpoint& from,
                                 const std::string& resolved_case, const Provenance& provenance) {
  demand_lines(run.history(), from.position.marks.history_bytes, from);
  demand_lines(run.status(), from.position.marks.status_bytes, from);
  std::error_code error;
  if (!fs::equivalent(run.root, root, error)) {
    RunFolder folder = prepare_run_folder(root, resolved_case, provenance, OldResults::keep);
    copy_lines(run.history(), folder.history());
    copy_lines(run.status(), folder.status());
    copy_folder(run.frames(), folder.frames());
    copy_folder(run.extracts(), folder.extracts());
    cut_extracts_back(folder.extracts(), from.model.clock.steps);
    return folder;
  }
  const RunFolder folder{root, std::make_shared<const RunLock>(root)};
  // Later checkpoints first: as long as one is there, the files must not be cut back to an earlier one.
  remove_checkpoints_after(folder.checkpoints(), from.model.clock.steps);
  for (const fs::path& path :
       {folder.summary(), folder.summary_text(), folder.control(), temporary_of(folder.control())})
    remove_stale(path);
  cut_extracts_back(folder.extracts(), from.model.clock.steps);
  write_file_atomically(folder.case_file(), resolved_case);
  fs::create_directories(folder.frames(), error);
  return folder;
}

}  // namespace breccia
