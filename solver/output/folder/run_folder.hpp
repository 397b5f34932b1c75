#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "run_folder/names.hpp"

namespace breccia {

class RunLock;

/// Where a result came from: `provenance.json`.
struct Provenance {
  /// A file that the run was made from.
  struct Input {
    std::string file;    ///< as it was named
    std::string sha256;  ///< of its bytes; empty: it cannot be read
  };
  std::string run;        ///< random, of this run alone; a run that is resumed in its folder keeps it
  std::string version;    ///< of the program
  std::string commit;     ///< of the sources when the build was configured; "-dirty": changed since
  std::string libraries;  ///< with their versions
  std::string host;       ///< name of the machine
  std::string processor;  ///< model
  int cores = 0;          ///< hardware threads
  std::string compiler;   ///< name and version
  std::string flags;      ///< build type and options
  std::string started;    ///< UTC, ISO 8601
  std::vector<std::string> command_line;
  int ranks = 1;
  /// A checkpoint of another run, whose state this one started from.
  struct Parent {
    std::string file, sha256;
    std::int64_t step = 0;
    double time = 0;  ///< s
  };
  std::vector<Parent> parents;  ///< the nearest first
  std::vector<Input> inputs;    ///< case, geometry or mesh, and what a geometry includes by name
};

[[nodiscard]] Provenance::Input input_file(const std::filesystem::path& file);
/// The run in a provenance, JSON; empty: it names none.
[[nodiscard]] std::string run_in(const std::string& provenance);
/// Inputs and parents in the provenance of another run, JSON. Unreadable entries are omitted.
[[nodiscard]] std::vector<Provenance::Input> inputs_in(const std::string& provenance);
[[nodiscard]] std::vector<Provenance::Parent> parents_in(const std::string& provenance);

/// Data of the machine and the build; unknown parts are empty. Throws nothing but std::bad_alloc.
[[nodiscard]] Provenance collect_provenance(std::string version, std::vector<std::string> command_line);
[[nodiscard]] std::string provenance_json(const Provenance& provenance);

/// Names inside one run's folder.
struct RunFolder {
  std::filesystem::path root;
  std::shared_ptr<const RunLock> lock = nullptr;  ///< of the process that prepared it, locked as long as this lives

  [[nodiscard]] std::filesystem::path frames() const { return root / run_folder::kFrames; }
  [[nodiscard]] std::filesystem::path case_file() const { return root / run_folder::kCaseFile; }
  [[nodiscard]] std::filesystem::path provenance() const { return root / run_folder::kProvenance; }
  [[nodiscard]] std::filesystem::path history() const { return root / run_folder::kHistory; }
  [[nodiscard]] std::filesystem::path bodies() const { return root / run_folder::kBodies; }
  [[nodiscard]] std::filesystem::path status() const { return root / run_folder::kStatus; }
  [[nodiscard]] std::filesystem::path summary() const { return root / run_folder::kSummary; }
  [[nodiscard]] std::filesystem::path summary_text() const { return root / "summary.txt"; }
  [[nodiscard]] std::filesystem::path control() const { return root / "control"; }
  [[nodiscard]] std::filesystem::path checkpoints() const { return root / run_folder::kCheckpoints; }
  [[nodiscard]] std::filesystem::path extracts() const { return root / "extracts"; }
  [[nodiscard]] std::filesystem::path extract_steps() const { return root / "extracts.csv"; }  ///< index of extracts
};

/// `runs/<folder of the case>`, under the present folder.
[[nodiscard]] std::filesystem::path default_run_folder(const std::filesystem::path& case_file);

/// keep: refused by a command that has no option to replace them.
enum class OldResults { refuse, keep, overwrite };

/// Makes `root` ready for a run: creates it and frames/, writes case.toml and provenance.json.
/// A folder with other things in it is refused, and so is a run with results unless old_results is overwrite: then the
/// files a run writes are removed, and only those.
/// The folder is locked first (output/folder/run_lock.hpp): no other run overwrites the results of a run in progress.
/// @throws OutputError naming the path: refused, locked by another run, not a folder, no permission, disk full.
[[nodiscard]] RunFolder prepare_run_folder(const std::filesystem::path& root, const std::string& resolved_case,
                                           const Provenance& provenance, OldResults old_results);

}  // namespace breccia
