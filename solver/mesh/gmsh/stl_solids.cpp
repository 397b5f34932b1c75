#include "mesh/gmsh/stl_solids.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/index.hpp"
#include "mesh/closed_surface.hpp"
#include "mesh/gmsh/solid_groups.hpp"
#include "mesh/stl_file.hpp"

namespace breccia {
namespace {

using namespace solids;

constexpr int kTriangle3 = 2;                           // gmsh's number of this type
constexpr double kSharp = 40 * std::numbers::pi / 180;  // between the faces of an STL
constexpr const char* kMend = "a closed surface without crossings: mend it in the program that it comes from";

/// The triangles as gmsh has them: by numbers of nodes, which it keeps while it cuts them into surfaces.
class StlModel {
 public:
  StlModel(const StlFile& file, const ClosedSurfaces& parts) : file_(file), parts_(parts) {
    const int whole = gmsh::model::addDiscreteEntity(2);
    std::vector<std::size_t> nodes, corners;
    std::vector<double> coordinates;
    for (std::size_t t = 0; t < file.surface.triangles.size(); ++t) {
      // Of two triangles that are one interface the first is there for both.
      if (shares(static_cast<Index>(t)) && at(parts.twin[t]) < t) continue;
      std::array<std::size_t, 3> of_triangle{};
      for (std::size_t c = 0; c < 3; ++c)
        of_triangle[c] = node(static_cast<Index>(t), file.surface.triangles[t][c], nodes, coordinates);
      corners.insert(corners.end(), of_triangle.begin(), of_triangle.end());
      std::sort(of_triangle.begin(), of_triangle.end());
      triangle_of_.emplace(of_triangle, static_cast<Index>(t));
    }
    gmsh::model::mesh::addNodes(2, whole, nodes, coordinates);
    gmsh::model::mesh::addElementsByType(whole, kTriangle3, {}, corners);
    // What stands in the file is remeshed: its triangles are as long and thin as its program left them.
    gmsh::model::mesh::classifySurfaces(kSharp, true, true, std::numbers::pi);
    gmsh::vectorpair none;
    gmsh::model::mesh::createGeometry(none);
    for (const int tag : tags_of(2)) place(tag);
  }

  std::map<Index, std::vector<int>> of_shell, of_patch;  ///< gmsh's surfaces

 private:
  /// Solids that touch share the interface, unless each has cut some of it into other triangles.
  [[nodiscard]] bool shares(Index t) const { return parts_.mismatch.empty() && parts_.twin[at(t)] >= 0; }

  std::size_t node(Index triangle, Index point, std::vector<std::size_t>& nodes, std::vector<double>& coordinates) {
    const Index owner = parts_.mismatch.empty() ? 0 : parts_.shell[at(triangle)];
    const auto [entry, fresh] = node_of_.emplace(std::pair{owner, point}, nodes.size() + 1);
    if (fresh) {
      const Vec3& x = file_.surface.points[at(point)];
      nodes.push_back(entry->second);
      coordinates.insert(coordinates.end(), {x.x(), x.y(), x.z()});
    }
    return entry->second;
  }

  void place(int tag) {
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(kTriangle3, elements, nodes, tag);
    if (nodes.size() < 3) throw std::string("a surface of the STL file has lost its triangles");
    std::array<std::size_t, 3> corners{nodes[0], nodes[1], nodes[2]};
    std::sort(corners.begin(), corners.end());
    const auto found = triangle_of_.find(corners);
    if (found == triangle_of_.end()) throw std::string("the surfaces of the STL file could not be found again");
    const std::size_t t = at(found->second);
    of_patch[parts_.patch[t]].push_back(tag);
    of_shell[parts_.shell[t]].push_back(tag);
    if (shares(found->second)) of_shell[parts_.shell[at(parts_.twin[t])]].push_back(tag);
  }

  const StlFile& file_;
  const ClosedSurfaces& parts_;
  std::map<std::pair<Index, Index>, std::size_t> node_of_;
  std::map<std::array<std::size_t, 3>, Index> triangle_of_;
};

/// Makes the volumes of gmsh's surfaces. Returns the names of the solids.
std::vector<std::string> add_solids(const StlFile& file, const ClosedSurfaces& parts, const StlModel& model) {
  std::map<Index, std::string> name_of_shell;
  for (std::size_t t = 0; t < parts.shell.size(); ++t)
    name_of_shell.emplace(parts.shell[t], file.names[at(file.solid[t])]);
  Names taken;
  std::vector<std::string> names;
  std::vector<int> tags;
  for (const std::vector<Index>& solid : parts.solids) {
    std::vector<int> loops;
    loops.reserve(solid.size());
    for (const Index shell : solid) loops.push_back(gmsh::model::geo::addSurfaceLoop(model.of_shell.at(shell)));
    tags.push_back(gmsh::model::geo::addVolume(loops));
    const std::string name = given_name(name_of_shell.at(solid.front()));
    names.push_back(
        taken.free(name.empty() || name == "Created by Gmsh" ? "volume_" + std::to_string(tags.back()) : name));
  }
  gmsh::model::geo::synchronize();
  for (std::size_t i = 0; i < tags.size(); ++i) add_group(3, {tags[i]}, names[i]);
  int number = 0;
  for (const auto& [patch, surfaces] : model.of_patch)
    add_group(2, surfaces, taken.free("surface_" + std::to_string(++number)));
  return names;
}

void add_notes(const StlFile& file, const ClosedSurfaces& parts, const std::vector<std::string>& names,
               std::vector<std::string>& notes) {
  for (const ClosedSurfaces::Inclusion& one : parts.inclusions)
    notes.push_back("\"" + names[at(one.inner)] + "\" lies inside \"" + names[at(one.outer)] +
                    "\" and is cut out of it: two volumes that touch (mesh.glue = true joins them); for a hole its "
                    "triangles would face into it");
  if (parts.num_holes > 0)
    notes.push_back(std::to_string(parts.num_holes) + (parts.num_holes == 1
                                                           ? " shell inside a solid faces inwards: it is a hole"
                                                           : " shells inside solids face inwards: they are holes"));
  if (file.repeated > 0)
    notes.push_back(std::to_string(file.repeated) + (file.repeated == 1 ? " triangle stands" : " triangles stand") +
                    " in the file twice: one of each is read");
}

}  // namespace

void open_stl(const GmshSource& source, std::vector<std::string>& notes) {
  const StlFile file = read_stl(source.file);
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::max()), upper = -lower;
  for (const Vec3& point : file.surface.points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  demand_extent(source, upper - lower);
  const ClosedSurfaces parts = take_apart(file.surface, kSharp);
  if (!parts.fault.empty()) refuse(source, parts.fault, kMend);
  if (source.glue && !parts.mismatch.empty())
    refuse(source,
           "solids touch along a face that each cuts into other triangles, and cannot be glued" + parts.mismatch,
           "the same triangles on both sides, the solids as STEP, or mesh.glue = false");
  const StlModel model(file, parts);
  add_notes(file, parts, add_solids(file, parts, model), notes);
}

}  // namespace breccia
