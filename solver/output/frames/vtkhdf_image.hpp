#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "parallel/communicator.hpp"

namespace breccia {

/// Cells of one kind, each with points of its own: cell c has the points n c .. n c + n - 1 (n = 4, 3, 1).
enum class CellKind { tetrahedra, triangles, vertices };

/// Values of a cell array, (num_cells, components) interleaved. Integers keep their type; doubles are stored as 32-bit
/// floats, unless kept_in_64_bits: they are for display, not for computation.
using CellValues = std::variant<std::span<const double>, std::span<const std::int32_t>, std::span<const std::int64_t>>;

struct CellArray {
  std::string name;
  CellValues values;
  int components = 1;
  bool in_64_bits = false;  ///< doubles that are computed with
};

/// An unstructured grid to be stored. Views: must outlive the call.
struct GridView {
  CellKind kind = CellKind::tetrahedra;
  std::span<const double> points;  ///< (n num_cells, 3), m, kept in 64 bits
  std::vector<CellArray> arrays;
  double time = 0;        ///< s, field data "time"
  std::int64_t step = 0;  ///< field data "step"
};

/// The bytes of a VTKHDF 1.0 file (HDF5, one UnstructuredGrid, one piece) as ParaView 5.11 and later read it. Zero
/// cells are allowed. Integer arrays are shuffled and deflated (level 1); floating-point ones are left as they are
/// where deflating costs more time than it saves bytes.
/// @pre values.size() == num_cells * components for every array; points.size() a multiple of 3 n
/// O(bytes), allocates twice the size of the file. Throws OutputError when HDF5 fails (out of memory).
[[nodiscard]] std::vector<std::byte> vtkhdf_image(const GridView& grid);

/// Writes the grid of all ranks as one file with a piece a rank, in the order of ranks, under the name
/// temporary_of(path): to be renamed when all is well. The root writes the structure, then every rank its rows of every
/// dataset at their places, with plain writes that wait for no other rank; nothing is deflated. On the disk when it
/// returns. A piece may be empty. Collective.
/// @pre as above; more than one rank; arrays, kind, time and step alike on all; all ranks see one file system, which
/// keeps bytes apart that different machines write Throws OutputError that names `path` on all ranks when anything
/// fails on any; then the temporary may remain.
void write_vtkhdf_temporary(const std::filesystem::path& path, const GridView& grid, const Communicator& communicator);

}  // namespace breccia
