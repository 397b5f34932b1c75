#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "output/checkpoint/checkpoint.hpp"
#include "parallel/communicator.hpp"
#include "system/surviving_process.hpp"

namespace breccia {

/// A checkpoint that appears even if the run is killed as soon as it is begun: copies of the ranks' processes write it
/// (CheckpointWriter with FileRanks). For the last one of a run, which waits for it as long as it lives.
class SurvivingCheckpoint {
 public:
  /// What the checkpoint of a killed run is reported by; of the root.
  struct Place {
    std::filesystem::path file;
    std::filesystem::path status;                   ///< status.jsonl
    int lock = -1;                                  ///< descriptor of run.lock, which the copy keeps; -1: none
    std::vector<std::filesystem::path> companions;  ///< as for CheckpointWriter
  };
  /// Collective.
  /// @param clock    of the state
  /// @param content  of this rank, taken in the copy: without MPI
  SurvivingCheckpoint(Place place, const Clock& clock, const std::function<Checkpoint()>& content,
                      const Communicator& communicator);

  /// Waits until the file is there. Collective. Throws OutputError on all ranks.
  /// @return  bytes of the file, on the root; nullopt on all ranks: a copy could not be made or has died, so that there
  ///          is no file
  [[nodiscard]] std::optional<std::uint64_t> finish();

 private:
  std::unique_ptr<SurvivingProcess> process_;
  Communicator communicator_;
};

}  // namespace breccia
