#pragma once

#include <string>
#include <vector>

#include "mesh/gmsh_reader.hpp"

namespace breccia {

/// Opens a solid (STEP, BREP, STL) in gmsh, gives every volume and every surface that bounds one a physical group, and
/// meshes it. To be called where gmsh is open; lengths in it are those of the file, those of STEP in metres.
///
/// Volumes are named as in the STEP or STL file, else "volume_<n>"; a name that comes again is followed by "_2", "_3".
/// Surfaces are "surface_<n>", or as the STEP file has them. Those of an STL are its parts between sharp edges (40
/// degrees). With source.glue, STEP and BREP volumes that touch get one interface, which both are meshed along.
///
/// Solids of an STL that touch along the same triangles are volumes with one interface; one inside another is cut
/// out of it. Returns what is to be stated of that, a sentence each (MeshReport::notes).
///
/// Throws InputError: no volume in it; a STEP file with a reference that leads nowhere, or with solids of which some
/// cannot be read; volumes that overlap, where they are to be glued; an STL that cannot be read, is open, crosses
/// itself or bounds no solid. What gmsh refuses it throws or logs.
[[nodiscard]] std::vector<std::string> mesh_solids(const GmshSource& source);

}  // namespace breccia
