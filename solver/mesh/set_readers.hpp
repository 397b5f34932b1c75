#pragma once

#include <filesystem>

#include "mesh/mesh_bytes.hpp"

namespace breccia {

/// Reads the mesh of a universal file (.unv) as I-DEAS, Salome and gmsh write it: nodes (dataset 2411, 781), elements
/// (2412, 780) and groups of nodes and elements (2467, 2477, 2452, 2435), which become groups as mesh/set_mesh.hpp
/// states; without any group of tetrahedra those of one property are the group "volume_<property>". Other datasets and
/// elements of other shapes that are no solids are passed over. gmsh itself cannot read groups that it has written.
/// @param scale  of the file's unit, m
/// Throws InputError with the line: solids of another shape, a file that ends within a dataset, words where numbers are
/// due, labels given twice or of nothing. O(n).
[[nodiscard]] RawMesh read_unv(const std::filesystem::path& file, double scale);

/// Reads a mesh of Medit (.mesh, text): vertices, tetrahedra and triangles of first and second order, edges. Those
/// of one reference number are the groups "volume_<n>", "surface_<n>" and "curve_<n>". gmsh misreads those of
/// second order.
/// @param scale  of the file's unit, m
/// Throws InputError with the line as read_unv() does; counts that do not match. O(n).
[[nodiscard]] RawMesh read_medit(const std::filesystem::path& file, double scale);

}  // namespace breccia
