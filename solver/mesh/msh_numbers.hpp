#pragma once

#include <filesystem>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// Nodes and elements of a .msh file of format 2 that share a number, one problem a section: gmsh keeps the last of
/// them and loses the others without a word. A section that is not as expected is passed over: gmsh judges it.
/// O(n log n) in the numbers of a section, of which there are no more than the file has bytes for.
[[nodiscard]] std::vector<Problem> repeated_numbers(const std::filesystem::path& file);

}  // namespace breccia
