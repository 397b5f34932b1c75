#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh_bytes.hpp"

namespace breccia {

/// The mesh of the model that gmsh has open, with the groups of read_gmsh().
/// @param file  for messages;  @param scale  of the model's unit of length, m
/// @param materials  names of the groups that carry one
/// Elements of higher order are read by their corners, which a note states; their other nodes are left out.
/// Throws InputError as read_gmsh() does for what the model holds. @pre gmsh is open
[[nodiscard]] RawMesh read_gmsh_model(const std::filesystem::path& file, double scale,
                                      const std::vector<std::string>& materials);

}  // namespace breccia
