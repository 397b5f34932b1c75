#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// What the cards of a Nastran file (.bdf) state beyond what gmsh reads of them.
struct BdfScan {
  std::int64_t tetrahedra = 0;    ///< CTETRA
  std::vector<Problem> problems;  ///< what gmsh would pass over or misread, with lines
};

/// Reads the names and first fields of the cards, in fixed and free format. Refused: no ENDDATA (the file is cut off),
/// solids of another shape, grid points in a coordinate system of their own, INCLUDE. At most ten problems. O(size).
[[nodiscard]] BdfScan scan_bdf(const std::filesystem::path& file);

}  // namespace breccia
