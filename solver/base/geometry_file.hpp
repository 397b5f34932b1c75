#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

/// What a file that gives the model its shape is, by the end of its name.
enum class GeometryFile {
  script,
  mesh,     ///< of gmsh
  abaqus,   ///< mesh of an input file
  unv,      ///< mesh of I-DEAS, Salome
  nastran,  ///< mesh of bulk data
  medit,    ///< mesh of Medit, INRIA
  step,
  brep,
  stl,
  unknown
};

/// The names that are taken, for messages.
inline constexpr const char* kGeometryFiles =
    ".geo, .msh of format 2.2 to 4.1, .inp, .unv, .bdf, .mesh, .step, .stp, .brep or .stl";

/// Ends of the names that are taken, each with its point.
[[nodiscard]] std::vector<std::string> geometry_endings();

/// Names in small or in large letters, as gmsh takes them: of any other it guesses what it is. O(1), throws nothing.
[[nodiscard]] GeometryFile geometry_file(const std::filesystem::path& file);

/// A solid that is meshed with elements of a chosen size: no script, no mesh.
[[nodiscard]] inline bool is_solid(GeometryFile kind) {
  return kind == GeometryFile::step || kind == GeometryFile::brep || kind == GeometryFile::stl;
}

/// What to do about a file of a known kind that is not read, by the end of its name; empty: nothing is known.
[[nodiscard]] std::string remedy_for(const std::filesystem::path& file);

/// A file that does not state the unit of its lengths.
[[nodiscard]] inline bool states_no_unit(GeometryFile kind) {
  return kind != GeometryFile::script && kind != GeometryFile::step && kind != GeometryFile::mesh &&
         kind != GeometryFile::unknown;
}

}  // namespace breccia
