#include "mesh/gmsh_solids.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "mesh/closed_surface.hpp"

namespace breccia {
namespace {

constexpr int kTriangle3 = 2;                           // gmsh's number of this type
constexpr double kSharp = 40 * std::numbers::pi / 180;  // between the faces of an STL
constexpr const char* kMend = "a closed surface without crossings: mend it in the program that it comes from";

[[noreturn]] void refuse(const GmshSource& source, const std::string& what, const std::string& allowed) {
  throw InputError(Problem{source.file.string(), 0, "mesh.file", what, allowed, ""});
}

/// Names of physical groups, each once.
class Names {
 public:
  std::string free(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i) name = wanted + "_" + std::to_string(i);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

/// The name that a person gave, out of a label "Shapes/assembly/part"; empty: none, or one that OpenCASCADE made up.
std::string given_name(const std::string& label) {
  const std::string name = label.substr(label.rfind('/') + 1);
  const bool made_up = name.starts_with("Open CASCADE STEP translator") || name == "SOLID" || name == "COMPOUND";
  return made_up || name == "*" ? std::string() : name;
}

void add_group(int dimension, const std::vector<int>& entities, const std::string& name) {
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, entities), name);
}

std::vector<int> tags_of(int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities) tags.push_back(entity.second);
  std::sort(tags.begin(), tags.end());
  return tags;
}

/// Every edge of about the size that was asked for, or of one that gives some thousand elements.
void set_size(const GmshSource& source) {
  std::array<double, 6> box{};
  gmsh::model::getBoundingBox(-1, -1, box[0], box[1], box[2], box[3], box[4], box[5]);
  const double volume = (box[3] - box[0]) * (box[4] - box[1]) * (box[5] - box[2]);
  const double size = source.size > 0 ? source.size / source.scale : 0.1 * std::cbrt(volume);
  for (const char* name : {"Mesh.CharacteristicLengthMin", "Mesh.CharacteristicLengthMax"})
    gmsh::option::setNumber(name, size);
  gmsh::option::setNumber("Mesh.CharacteristicLengthFromPoints", 0);
  gmsh::option::setNumber("Mesh.CharacteristicLengthExtendFromBoundary", 0);
}

// --- STEP and BREP
// -----------------------------------------------------------------------------------------------------

/// Volumes that touch get one interface. Returns their names by the new tags.
std::map<int, std::string> join_volumes(const GmshSource& source, const std::map<int, std::string>& before) {
  gmsh::vectorpair whole, made;
  for (const auto& [tag, name] : before) whole.emplace_back(3, tag);
  std::vector<gmsh::vectorpair> parts;
  gmsh::model::occ::fragment(whole, {}, made, parts);
  gmsh::model::occ::synchronize();
  std::map<int, std::string> after;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const std::string& name = before.at(whole[i].second);
    for (const auto& [dimension, tag] : parts[i]) {
      if (dimension != 3) continue;
      const auto [entry, fresh] = after.emplace(tag, name);
      if (!fresh)
        refuse(source, "the volumes \"" + entry->second + "\" and \"" + name + "\" overlap",
               "volumes that touch at most, where mesh.glue = true joins them");
    }
  }
  return after;
}

void open_cad(const GmshSource& source) {
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");  // a STEP file says what its lengths are
  gmsh::open(source.file.string());
  Names names;
  std::map<int, std::string> volumes;
  for (const int tag : tags_of(3)) {
    std::string label;
    gmsh::model::getEntityName(3, tag, label);
    const std::string name = given_name(label);
    volumes[tag] = names.free(name.empty() ? "volume_" + std::to_string(tag) : name);
  }
  if (const std::size_t faces = tags_of(2).size(); volumes.empty())
    refuse(source, faces == 0 ? "holds no solid" : "holds no solid, only " + std::to_string(faces) + " faces",
           "solids: let the program that it comes from sew the faces");
  if (source.glue && volumes.size() > 1) volumes = join_volumes(source, volumes);
  std::map<std::string, std::vector<int>> groups;
  gmsh::vectorpair solids, faces;
  for (const auto& [tag, name] : volumes) {
    groups[name].push_back(tag);
    solids.emplace_back(3, tag);
  }
  for (const auto& [tag, name] : volumes) {  // in the order of the tags
    const auto group = groups.find(name);
    if (group != groups.end()) add_group(3, group->second, name);
    groups.erase(name);
  }
  gmsh::model::getBoundary(solids, faces, false, false, false);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const auto& [dimension, tag] : faces) {
    std::string label;
    gmsh::model::getEntityName(2, tag, label);
    const std::string name = given_name(label);
    add_group(2, {tag}, names.free(name.empty() ? "surface_" + std::to_string(tag) : name));
  }
}

// --- STL
// -----------------------------------------------------------------------------------------------------

using Point = std::array<double, 3>;

/// The triangles of the file, as they are before gmsh cuts them into surfaces, and the name of the solid of each.
struct StlFile {
  SurfaceTriangles surface;
  std::vector<std::string> names;
  std::map<Point, Index> index_of;  ///< by coordinates, which gmsh keeps to the last bit

  /// Adds the triangles of a surface of gmsh's.
  void add(int tag) {
    std::string name;
    gmsh::model::getEntityName(2, tag, name);
    for (const std::array<Point, 3>& triangle : triangles_of(tag)) {
      std::array<Index, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        const Point& x = triangle[c];
        const auto [entry, fresh] = index_of.emplace(x, static_cast<Index>(surface.points.size()));
        if (fresh) surface.points.emplace_back(x[0], x[1], x[2]);
        corners[c] = entry->second;
      }
      surface.triangles.push_back(corners);
      names.push_back(name);
    }
  }

  static std::vector<std::array<Point, 3>> triangles_of(int tag) {
    std::vector<std::size_t> elements, nodes, all;
    std::vector<double> coordinates, unused;
    gmsh::model::mesh::getElementsByType(kTriangle3, elements, nodes, tag);
    gmsh::model::mesh::getNodes(all, coordinates, unused, 2, tag, true);
    std::map<std::size_t, Point> place;
    for (std::size_t n = 0; n < all.size(); ++n)
      place[all[n]] = {coordinates[3 * n], coordinates[3 * n + 1], coordinates[3 * n + 2]};
    std::vector<std::array<Point, 3>> triangles(elements.size());
    for (std::size_t t = 0; t < elements.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) triangles[t][c] = place.at(nodes[3 * t + c]);
    return triangles;
  }
};

/// Where the first triangle of one of gmsh's surfaces was in the file.
Index place_in_file(const StlFile& file, const std::map<std::array<Index, 3>, Index>& triangle_of, int tag) {
  const std::vector<std::array<Point, 3>> triangles = StlFile::triangles_of(tag);
  if (triangles.empty()) return -1;
  std::array<Index, 3> corners{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found = file.index_of.find(triangles.front()[c]);
    if (found == file.index_of.end()) return -1;
    corners[c] = found->second;
  }
  std::sort(corners.begin(), corners.end());
  const auto found = triangle_of.find(corners);
  return found == triangle_of.end() ? -1 : found->second;
}

/// Makes the volumes of gmsh's surfaces.
void add_solids(const StlFile& file, const ClosedSurfaces& parts) {
  std::map<std::array<Index, 3>, Index> triangle_of;
  for (std::size_t t = 0; t < file.surface.triangles.size(); ++t) {
    std::array<Index, 3> corners = file.surface.triangles[t];
    std::sort(corners.begin(), corners.end());
    triangle_of.emplace(corners, static_cast<Index>(t));
  }
  std::map<Index, std::vector<int>> of_shell, of_patch;
  std::map<Index, std::string> name_of_shell;
  for (const int tag : tags_of(2)) {
    const Index t = place_in_file(file, triangle_of, tag);
    if (t < 0) throw std::string("the surfaces of the STL file could not be found again");
    const auto at = static_cast<std::size_t>(t);
    of_shell[parts.shell[at]].push_back(tag);
    of_patch[parts.patch[at]].push_back(tag);
    name_of_shell.emplace(parts.shell[at], file.names[at]);
  }
  Names names;
  std::vector<std::pair<int, std::string>> volumes;
  for (const std::vector<Index>& solid : parts.solids) {
    std::vector<int> loops;
    loops.reserve(solid.size());
    for (const Index shell : solid) loops.push_back(gmsh::model::geo::addSurfaceLoop(of_shell.at(shell)));
    const int tag = gmsh::model::geo::addVolume(loops);
    const std::string name = given_name(name_of_shell.at(solid.front()));
    volumes.emplace_back(
        tag, names.free(name.empty() || name == "Created by Gmsh" ? "volume_" + std::to_string(tag) : name));
  }
  gmsh::model::geo::synchronize();
  for (const auto& [tag, name] : volumes) add_group(3, {tag}, name);
  int number = 0;
  for (const auto& [patch, surfaces] : of_patch)
    add_group(2, surfaces, names.free("surface_" + std::to_string(++number)));
}

void open_stl(const GmshSource& source) {
  gmsh::open(source.file.string());
  StlFile file;
  for (const int tag : tags_of(2)) file.add(tag);
  const ClosedSurfaces parts = take_apart(file.surface, kSharp);
  if (!parts.fault.empty()) refuse(source, parts.fault, kMend);
  // What stands in the file is remeshed: its triangles are as long and thin as its program left them.
  gmsh::model::mesh::classifySurfaces(kSharp, true, true, std::numbers::pi);
  gmsh::vectorpair none;
  gmsh::model::mesh::createGeometry(none);
  add_solids(file, parts);
}

}  // namespace

void mesh_solids(const GmshSource& source) {
  geometry_file(source.file) == GeometryFile::stl ? open_stl(source) : open_cad(source);
  set_size(source);
  gmsh::model::mesh::generate(3);
}

}  // namespace breccia
