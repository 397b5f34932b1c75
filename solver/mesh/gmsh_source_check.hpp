#pragma once

#include <cstdint>
#include <string>

#include "mesh/gmsh_reader.hpp"

namespace breccia {

/// Checks without opening the file: it exists, a regular file with a name of a known kind, and no larger than the
/// memory that reading it may take. Throws InputError. O(1)
/// @param memory  bytes
void check_file(const GmshSource& source, std::uint64_t memory);

/// Checks without gmsh: the file is of the format that its name states; scale and size are lengths; every parameter is
/// finite and one that the script takes. Reads the whole file, so that only a process within bounds
/// calls it. Throws InputError. @pre check_file
void check_source(const GmshSource& source);

/// What may be done about a mesh that wants more than to be read.
inline constexpr const char* kTrustAdvice =
    "statements of geometry and mesh alone; or --trust-geometry, if you know who made it and what it does";

/// What a mesh may read.
inline constexpr const char* kReadAdvice =
    "files beneath the folder of the mesh or of the case; or --trust-geometry, if you know who made it";

/// True for a script (.geo), false for a mesh file or a solid.
[[nodiscard]] bool is_script(const GmshSource& source);

/// True for a name that gmsh's script language takes as a variable.
[[nodiscard]] bool is_identifier(const std::string& name);

}  // namespace breccia
