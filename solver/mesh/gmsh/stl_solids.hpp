#pragma once

#include <string>
#include <vector>

#include "mesh/gmsh_reader.hpp"

namespace breccia {

/// Gives the model that gmsh has open the volumes and surfaces of an STL file, with their physical groups, as
/// mesh/gmsh/solids.hpp states. Solids that touch along the same triangles share the surface there; a solid inside
/// another is cut out of it, and a shell that faces inwards is a hole: `notes` states both.
/// Throws InputError: what read_stl() and take_apart() refuse; solids to be glued that touch along a face which each
/// cuts into other triangles.
void open_stl(const GmshSource& source, std::vector<std::string>& notes);

}  // namespace breccia
