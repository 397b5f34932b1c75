#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/checkpoint/checkpoint_columns.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "system/surviving_process.hpp"

namespace breccia {

/// A checkpoint that appears even if the run is killed while it is written.
struct Survival {
  std::filesystem::path status;  ///< status.jsonl, which reports it then; of the root
  int lock = -1;                 ///< descriptor of run.lock, which keeps the folder locked; of the root
};

/// Writes a checkpoint while the run goes on. The constructor takes the state over and lays the file out; a thread of
/// every rank writes its part; finish() makes the file appear. A run that is killed at any moment leaves the former
/// checkpoints as they were, and perhaps a temporary file.
/// With Survival a copy of the process of every rank writes its part in place of the thread, and that of the root,
/// which waits for the others, makes the file appear: once the constructor has returned on all ranks, the checkpoint
/// does not depend on the run. The copies do without MPI: a rank's leaves its checksums in the file, where the index
/// will be.
class CheckpointWriter {
 public:
  /// Collective. Throws OutputError on all ranks: folder, permission, space.
  /// @param file        to write (checkpoint_file)
  /// @param content     of this rank; the model's rows of the whole
  /// @param companions  files that must be on the disk before the checkpoint is; of the root
  /// @param survival    on all ranks or on none
  CheckpointWriter(std::filesystem::path file, Checkpoint content, const Communicator& communicator,
                   std::vector<std::filesystem::path> companions, std::optional<Survival> survival = std::nullopt);
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;
  /// Without finish() nothing remains, but with Survival the checkpoint.
  ~CheckpointWriter();

  /// Whether this rank still writes.
  [[nodiscard]] bool writing() const { return !written_; }
  /// Waits for what is still to be written; then the file is there, on the disk. Collective. Throws OutputError on all
  /// ranks: then nothing of it remains.
  void finish();

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::uint64_t bytes() const { return index_.size; }  ///< of the file, on the root

 private:
  void lay_out();
  void begin_writing();
  void begin_process(const Survival& survival);
  void write_part();
  void gather_checksums();
  void set_checksums(const std::vector<std::vector<std::uint64_t>>& of_ranks);
  void publish();
  void remove_unfinished() const;
  bool finish_process();
  // In the copy of the process (checkpoint_survival.cpp):
  void write_in_copy(const SurvivingProcess::Parent& parent, const std::filesystem::path& status);
  void publish_in_copy();
  void leave_checksums(std::uint64_t mark) const;
  [[nodiscard]] std::optional<std::vector<std::uint64_t>> checksums_left_by(std::size_t rank) const;

  std::filesystem::path file_;
  Checkpoint content_;
  Communicator communicator_;
  std::vector<std::filesystem::path> companions_;
  std::vector<CheckpointColumn> columns_;
  std::vector<Rows> rows_;  ///< (columns)
  CheckpointIndex index_;   ///< complete on the root only
  IndexedBytes index_place_;
  std::vector<std::uint64_t> sums_;  ///< (columns) of this rank's rows
  bool survives_ = false;
  std::optional<OutputError> failure_;
  std::atomic<bool> written_ = false;
  bool published_ = false;
  std::thread thread_;
  std::unique_ptr<SurvivingProcess> process_;
};

/// Removes the oldest checkpoints of a folder but for the last `keep` and the last until `sound_step`, whose state is
/// known to be sound; and what killed runs left of others.  @pre none is being written
void remove_old_checkpoints(const std::filesystem::path& folder, std::int64_t keep, std::int64_t sound_step);
/// Removes those after a step. Throws OutputError.
void remove_checkpoints_after(const std::filesystem::path& folder, std::int64_t step);

/// Removes all checkpoints of a folder and what killed runs left of others, and the folder if nothing else is in it.
/// Throws OutputError that names a checkpoint.  @pre none is being written
void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace breccia
