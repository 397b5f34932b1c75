#pragma once

#include <filesystem>

#include "mesh/mesh_bytes.hpp"

namespace breccia {

/// Reads the mesh of an Abaqus input file (.inp): *NODE, *ELEMENT of tetrahedra (C3D4, C3D10), triangles (S3, STRI65,
/// M3D3, R3D3 ...) and lines (T3D2, B31 ...), *NSET and *ELSET with GENERATE and names of sets, *SURFACE of faces,
/// sets, nodes; *SOLID SECTION, *PART, *INSTANCE with its translation and rotation, *INCLUDE. Sets become groups as
/// mesh/set_mesh.hpp states; where an assembly has several instances, those of a part are named INSTANCE.SET. Names are
/// compared without regard to case. Other keywords, and elements of other shapes that are no solids, are passed over.
/// @param scale  of the file's unit, m
/// Throws InputError with up to ten problems and their lines: solids of another shape, keywords that generate nodes or
/// elements, words where numbers are due, labels given twice, elements whose nodes and sets whose members the file
/// does not have. O(n log n).
[[nodiscard]] RawMesh read_inp(const std::filesystem::path& file, double scale);

}  // namespace breccia
