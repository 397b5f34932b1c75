#pragma once

#include "mesh/gmsh_reader.hpp"
#include "mesh/mesh_bytes.hpp"

namespace breccia {

/// The functions of the module libbreccia_gmsh.so, which alone is linked with gmsh. The program opens it at the first
/// mesh that needs gmsh: loading gmsh and the ninety libraries that it uses takes 0.1 s.
struct GmshModule {
  const char* version;                        ///< program_version() that it was built with
  void (*open)();                             ///< opens gmsh. @pre in a child process, which ends with the reading
  MeshOrProblems (*read)(const GmshSource&);  ///< as read_gmsh(), before finish_mesh. @pre check_source, open;
                                              ///< a script is written to kKeptDescriptor, a file in memory
};

/// Loads the module at the first call. Throws OutputError where it is missing or of another version.
[[nodiscard]] const GmshModule& gmsh_module();

}  // namespace breccia

extern "C" const breccia::GmshModule* breccia_gmsh_module();
