#include "mesh/gmsh/solids.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "mesh/gmsh/solid_groups.hpp"
#include "mesh/gmsh/stl_solids.hpp"
#include "mesh/step_scan.hpp"

namespace breccia {
namespace {

using namespace solids;

/// All edges of about the requested size, or of one that gives some thousand elements.
void set_size(const GmshSource& source) {
  std::array<double, 6> box{};
  gmsh::model::getBoundingBox(-1, -1, box[0], box[1], box[2], box[3], box[4], box[5]);
  const Vec3 extent(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
  demand_extent(source, extent);
  const double size = source.size > 0 ? source.size / source.scale : 0.1 * std::cbrt(extent.prod());
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

/// A reference of another kind than is due there: OpenCASCADE leaves the body out.
void demand_all_solids(const GmshSource& source, std::int64_t in_file, std::size_t read) {
  if (in_file <= static_cast<std::int64_t>(read)) return;
  refuse(source, "holds " + std::to_string(in_file) + " solids, of which " + std::to_string(read) + " can be read",
         "a whole file: save it again in the program that it comes from, without unused and damaged solids");
}

void open_cad(const GmshSource& source) {
  StepScan scan;
  if (geometry_file(source.file) == GeometryFile::step) scan = scan_step(source.file);
  if (!scan.problems.empty()) throw InputError(std::move(scan.problems));
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");  // a STEP file states its unit
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
  demand_all_solids(source, scan.solids, volumes.size());
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

}  // namespace

std::vector<std::string> mesh_solids(const GmshSource& source) {
  std::vector<std::string> notes;
  geometry_file(source.file) == GeometryFile::stl ? open_stl(source, notes) : open_cad(source);
  set_size(source);
  gmsh::model::mesh::generate(3);
  return notes;
}

}  // namespace breccia
