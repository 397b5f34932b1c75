#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "output/run_position.hpp"
#include "parallel/communicator.hpp"
#include "state/records.hpp"
#include "state/state.hpp"

namespace breccia {

/// A run between two steps: all data from which it continues with bitwise identical results.
struct Checkpoint {
  Records mine;                        ///< this rank's originals
  State model;                         ///< the model's rows, of the whole model; alike on all ranks
  RunPosition position;                ///< alike on all ranks, but for the marks
  std::vector<std::byte> whole_model;  ///< domains/piece_mesh.hpp: pack; on the root
  std::string case_text;               ///< resolved; on the root
  std::string provenance;              ///< JSON; on the root
};

/// Names of checkpoints in a folder: step_000001234567.h5.
[[nodiscard]] std::filesystem::path checkpoint_file(const std::filesystem::path& folder, std::int64_t step);
struct CheckpointEntry {
  std::int64_t step = 0;
  std::filesystem::path file;
};
/// Those in a folder, the latest first; none if there is no such folder.
[[nodiscard]] std::vector<CheckpointEntry> checkpoints_in(const std::filesystem::path& folder);

/// Reads a checkpoint written by any number of ranks; every bit of the file is verified. Each element is assigned to
/// one rank, in any distribution. Collective.
/// Throws InputError, on all ranks, with the fault of the file.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace breccia
