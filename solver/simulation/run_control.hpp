#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/folder/control.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Order of the root that its control file has requests; those for pipelines are the 32 bits below it.
inline constexpr std::uint64_t kControlOrder = std::uint64_t{1} << 32;

/// Commands from a run's control file, which the root alone reads, for all ranks.
class RunControl {
 public:
  /// @param file  nothing: the run takes no commands
  RunControl(std::optional<std::filesystem::path> file, const Communicator& communicator)
      : communicator_(communicator) {
    if (file && communicator.is_root()) file_.emplace(*file);
  }

  /// Reads the file; true on the root while there are lines not received yet.
  [[nodiscard]] bool asks();
  /// The requests, the same on all ranks. Collective.
  [[nodiscard]] std::vector<Command> receive();

 private:
  Communicator communicator_;
  std::optional<ControlFile> file_;
  std::vector<std::string> lines_;
};

}  // namespace breccia
