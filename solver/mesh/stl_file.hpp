#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/closed_surface.hpp"

namespace breccia {

/// The triangles of an STL file and the names of its solids.
struct StlFile {
  SurfaceTriangles surface;        ///< corners within 1e-8 of the file's extent are one point
  std::vector<Index> solid;        ///< (triangles) index into `names`
  std::vector<std::string> names;  ///< of the solids, as they stand there; empty: none
  Index repeated = 0;              ///< triangles that stood there before, left out
};

/// Reads an STL file: binary, or text in any common spelling: words in small and capital letters, indented or not,
/// blank lines, ends of lines of any system, a byte order mark, names of any length and with blanks, several solids.
/// A binary file may begin with "solid": where its size is that of the triangles it counts, it is binary.
/// Triangles of which two corners are one point have no area and are left out.
/// Throws InputError with the line: text that is no STL (a file that is cut off, a facet of four corners, a decimal
/// comma), text of 16-bit characters, a binary file that is cut off, numbers that are not finite; no triangle.
/// O(triangles).
[[nodiscard]] StlFile read_stl(const std::filesystem::path& file);

}  // namespace breccia
