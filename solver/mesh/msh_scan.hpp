#pragma once

#include <filesystem>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// Faults of a .msh file of format 2.2 to 4.1, ASCII or binary, that gmsh passes over, losing what follows: sections
/// that hold more or less than their headings state or have no end, totals that are not those of the blocks, and, in
/// format 2, nodes or elements that share a number. One problem a section, with the line in an ASCII file; after a
/// section that cannot be followed to its end no other is read.
/// Sections of other names, and elements of a type that is unknown here, are left to gmsh.
/// O(n log n) in the numbers of a section, of which there are no more than the file has bytes for. Throws nothing.
[[nodiscard]] std::vector<Problem> msh_faults(const std::filesystem::path& file);

}  // namespace breccia
