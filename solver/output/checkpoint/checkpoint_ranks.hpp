#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace breccia {

/// What the ranks that write a checkpoint exchange. All functions but rank() and size() are collective.
class CheckpointRanks {
 public:
  CheckpointRanks(int rank, int size) : rank_(rank), size_(size) {}
  CheckpointRanks(const CheckpointRanks&) = delete;
  CheckpointRanks& operator=(const CheckpointRanks&) = delete;
  virtual ~CheckpointRanks() = default;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }

  using Numbers = std::vector<std::uint64_t>;
  /// What each rank gave, by rank, on all ranks.
  [[nodiscard]] virtual std::vector<Numbers> all_gather(std::span<const std::uint64_t> mine) = 0;
  /// Where `work` throws an OutputError on one rank, all throw it.
  virtual void agree(const std::function<void()>& work) = 0;
  /// Names what comes, for the message of a wait that lasts too long.
  virtual void set_phase(const char* /*phase*/) {}
  /// Whether a thread may write while the caller continues.
  [[nodiscard]] virtual bool may_use_thread() const { return false; }

 private:
  int rank_, size_;
};

/// The ranks of a run.
class MpiRanks final : public CheckpointRanks {
 public:
  explicit MpiRanks(const Communicator& communicator)
      : CheckpointRanks(communicator.rank(), communicator.size()), communicator_(communicator) {}
  [[nodiscard]] std::vector<Numbers> all_gather(std::span<const std::uint64_t> mine) override {
    return communicator_.all_gather(mine);
  }
  void agree(const std::function<void()>& work) override { communicator_.agree(work); }
  void set_phase(const char* phase) override { communicator_.set_phase(phase); }
  [[nodiscard]] bool may_use_thread() const override { return true; }

 private:
  Communicator communicator_;
};

/// Copies of the processes of a run (system/surviving_process.hpp), which have no MPI: they exchange small files beside
/// the checkpoint, `.step_000000001234.h5.RANK.NUMBER.tmp`, in which each leaves what it gives.
class FileRanks final : public CheckpointRanks {
 public:
  /// @param file   the checkpoint
  /// @param token  of this checkpoint of this process alone, the same on all ranks: files of others are not read
  FileRanks(int rank, int size, std::filesystem::path file, std::uint64_t token);
  ~FileRanks() override;  ///< the root removes the files when all have read them

  /// Throws OutputError where a rank does not leave its file: a copy that died, or was not made.
  [[nodiscard]] std::vector<Numbers> all_gather(std::span<const std::uint64_t> mine) override;
  void agree(const std::function<void()>& work) override;

 private:
  [[nodiscard]] std::filesystem::path file_of(int rank, std::uint64_t number) const;
  void leave(std::span<const std::uint64_t> mine);
  [[nodiscard]] Numbers wait_for(int rank);
  [[nodiscard]] std::optional<Numbers> left_by(int rank) const;

  std::filesystem::path file_;
  std::uint64_t token_;
  std::uint64_t number_ = 0;  ///< exchanges so far
  bool lost_ = false;         ///< a rank
};

}  // namespace breccia
