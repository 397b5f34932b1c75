#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/checkpoint/checkpoint_columns.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "output/checkpoint/checkpoint_ranks.hpp"

namespace breccia {

/// Writes a checkpoint while the run continues. The constructor copies the state and lays the file out; a thread of
/// every rank writes its part; finish() publishes the file. A run that is killed at any moment leaves the former
/// checkpoints unchanged, and possibly a temporary file.
class CheckpointWriter {
 public:
  /// Collective. Throws OutputError on all ranks: folder, permission, space.
  /// @param file        to write (checkpoint_file)
  /// @param content     of this rank; the model's rows of the whole
  /// @param companions  files that must be on the disk before the checkpoint is; of the root
  CheckpointWriter(std::filesystem::path file, Checkpoint content, const Communicator& communicator,
                   std::vector<std::filesystem::path> companions)
      : CheckpointWriter(std::make_unique<MpiRanks>(communicator), std::move(file), std::move(content),
                         std::move(companions)) {}
  CheckpointWriter(std::unique_ptr<CheckpointRanks> ranks, std::filesystem::path file, Checkpoint content,
                   std::vector<std::filesystem::path> companions);
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;
  /// Without finish() nothing remains.
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
  void write_part();
  void gather_checksums();
  void publish();
  void remove_unfinished() const;

  std::filesystem::path file_;
  Checkpoint content_;
  std::unique_ptr<CheckpointRanks> ranks_;
  std::vector<std::filesystem::path> companions_;
  std::vector<CheckpointColumn> columns_;
  std::vector<Rows> rows_;  ///< (columns)
  CheckpointIndex index_;   ///< complete on the root only
  IndexedBytes index_place_;
  std::vector<std::vector<std::byte>> structure_;  ///< (index_.structure) of the root
  std::vector<std::uint64_t> sums_;                ///< (columns) of this rank's rows
  std::optional<OutputError> failure_;
  std::atomic<bool> written_ = false;
  bool published_ = false;
  std::thread thread_;
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
