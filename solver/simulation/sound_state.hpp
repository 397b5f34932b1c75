#pragma once

#include <cstdint>
#include <string>

#include "output/folder/run_folder.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Last sound state of a run: the last sample of the energies that was within its limits.
struct SoundState {
  std::int64_t step = -1;   ///< states until this one; -1: none is known
  std::int64_t frame = -1;  ///< the last frame until then; -1: none
};

/// Results from before a fault, as the end of its message: the last sound checkpoint and frame by name, and how to
/// continue from there. Collective; the same on all ranks.
[[nodiscard]] std::string words_of(const SoundState& sound, const RunFolder& folder, const Communicator& communicator);

}  // namespace breccia
