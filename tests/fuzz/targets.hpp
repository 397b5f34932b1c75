#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace breccia::fuzz {

/// A reader that is given arbitrary bytes. It may refuse them by InputError; anything else that escapes, a crash or a
/// hang is a finding.
struct Target {
  const char* name;
  void (*run)(std::span<const std::byte> bytes);
  std::vector<std::vector<std::byte>> (*seeds)();  ///< what is accepted, to begin from
};

/// Of the case file, of --set, of quantities, of geometry scripts (their scan), of the mesh that a child process sends,
/// of its numbers under a right checksum, of geometry of every kind before gmsh opens it, of the control file, of
/// checkpoints: of the file, of its index and of its numbers under right checksums.
[[nodiscard]] const std::vector<Target>& targets();

}  // namespace breccia::fuzz
