#pragma once

#include <string>

#include "mesh/gmsh_reader.hpp"

namespace breccia {

/// What can be told without gmsh: the file is there, of a known kind and format; scale and size are lengths; every
/// parameter is finite and one that the script takes. Throws InputError.
void check_source(const GmshSource& source);

/// What may be done about a mesh that wants more than to be read.
inline constexpr const char* kTrustAdvice =
    "statements of geometry and mesh alone; or --trust-geometry, if you know who made it and what it does";

/// True for a script (.geo), false for a mesh file or a solid.
[[nodiscard]] bool is_script(const GmshSource& source);

/// True for a name that gmsh's script language takes as a variable.
[[nodiscard]] bool is_identifier(const std::string& name);

}  // namespace breccia
