#pragma once

#include <filesystem>

#include "mesh/mesh.hpp"

namespace breccia {

/// The mesh of the model that gmsh has open, with the groups that read_gmsh() tells of.
/// @param file  for messages;  @param scale  of the model's unit of length, m
/// @param ungrouped_elements  out: tetrahedra outside every physical volume, which are left out
/// Throws InputError as read_gmsh() does for what the model holds. @pre gmsh is open
[[nodiscard]] Mesh read_gmsh_model(const std::filesystem::path& file, double scale, Index& ungrouped_elements);

}  // namespace breccia
