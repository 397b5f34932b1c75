#pragma once

#include <filesystem>

namespace breccia {

/// What a file that gives the model its shape is, by the end of its name.
enum class GeometryFile { script, mesh, step, brep, stl, unknown };

/// The names that are taken, for messages.
inline constexpr const char* kGeometryFiles = ".geo, .msh of format 2.2 to 4.1, .step, .stp, .brep or .stl";

/// Names in small or in large letters, as gmsh takes them: of any other it guesses what it is. O(1), throws nothing.
[[nodiscard]] GeometryFile geometry_file(const std::filesystem::path& file);

/// A solid that is meshed with elements of a chosen size: no script, no mesh.
[[nodiscard]] inline bool is_solid(GeometryFile kind) {
  return kind == GeometryFile::step || kind == GeometryFile::brep || kind == GeometryFile::stl;
}

/// A file of lengths that are nowhere said to be millimetres or metres.
[[nodiscard]] inline bool states_no_unit(GeometryFile kind) {
  return kind == GeometryFile::brep || kind == GeometryFile::stl;
}

}  // namespace breccia
