#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// What the text of a STEP file (ISO 10303-21) states beyond the shapes that OpenCASCADE makes of it.
struct StepScan {
  std::int64_t solids = 0;        ///< instances of manifold, faceted and hollow solids
  std::vector<Problem> problems;  ///< references to instances that the file does not have, numbers given twice
};

/// Reads the instances of a STEP file and what they refer to. OpenCASCADE leaves out, without a word, a body of which a
/// reference leads nowhere. At most ten problems, with their lines. O(n log n) in the references. Throws nothing.
[[nodiscard]] StepScan scan_step(const std::filesystem::path& file);

}  // namespace breccia
