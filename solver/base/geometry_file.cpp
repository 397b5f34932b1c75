#include "base/geometry_file.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace breccia {
namespace {

constexpr std::array<std::pair<const char*, GeometryFile>, 11> kNames{{
    {".inp", GeometryFile::abaqus},
    {".unv", GeometryFile::unv},
    {".bdf", GeometryFile::nastran},
    {".nas", GeometryFile::nastran},
    {".mesh", GeometryFile::medit},
    {".step", GeometryFile::step},
    {".stp", GeometryFile::step},
    {".brep", GeometryFile::brep},
    {".stl", GeometryFile::stl},
    {".geo", GeometryFile::script},
    {".msh", GeometryFile::mesh},
}};

/// Names are taken in small and in large letters only: gmsh, which reads some of them, takes others for a script.
std::string extension_of(const std::filesystem::path& file) {
  std::string name = file.extension().string();
  const bool large = std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  if (large)
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return name;
}

}  // namespace

GeometryFile geometry_file(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& name) { return extension == name.first; });
  if (found == kNames.end()) return GeometryFile::unknown;
  const bool small_only = found->second == GeometryFile::script || found->second == GeometryFile::mesh;
  return small_only && extension != file.extension() ? GeometryFile::unknown : found->second;
}

std::vector<std::string> geometry_endings() {
  std::vector<std::string> endings;
  for (const auto& [ending, kind] : kNames) endings.emplace_back(ending);
  return endings;
}

std::string remedy_for(const std::filesystem::path& file) {
  constexpr const char* kMeshio = "convert it, as with `meshio convert FILE FILE.msh` (package python3-meshio)";
  constexpr const char* kSolid = "save it as STEP in the program that it comes from: it holds no solids";
  constexpr std::array<std::pair<const char*, const char*>, 25> kKnown{
      {{".vtu", kMeshio},
       {".vtk", kMeshio},
       {".med", kMeshio},
       {".cgns", kMeshio},
       {".e", kMeshio},
       {".exo", kMeshio},
       {".ex2", kMeshio},
       {".xdmf", kMeshio},
       {".h5m", kMeshio},
       {".su2", kMeshio},
       {".cdb", "write it as .inp, .bdf or .unv in the program that it comes from"},
       {".dat", "name it .bdf where it is bulk data of Nastran, .inp where it is an input file of Abaqus"},
       {".k", "write it as .inp, .bdf or .unv in the program that it comes from"},
       {".key", "write it as .inp, .bdf or .unv in the program that it comes from"},
       {".neu", "write it as .inp, .bdf or .unv in the program that it comes from"},
       {".vol", kMeshio},
       {".node", kMeshio},
       {".ele", kMeshio},
       {".igs", kSolid},
       {".iges", kSolid},
       {".obj", "save it as STL in the program that it comes from"},
       {".ply", "save it as STL in the program that it comes from"},
       {".off", "save it as STL in the program that it comes from"},
       {".geo_unrolled", "name it .geo"},
       {".vtp", "save it as STL, as ParaView does"}}};
  const std::string extension = extension_of(file);
  for (const auto& [name, remedy] : kKnown)
    if (extension == name) return remedy;
  return {};
}

}  // namespace breccia
