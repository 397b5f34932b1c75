#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "case/validate.hpp"
#include "mesh/bodies.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/raster.hpp"
#include "model/gauge_points.hpp"
#include "model/memory_demand.hpp"
#include "model/model.hpp"
#include "system/interruption.hpp"

namespace breccia {
namespace {

RasterSource raster_source(const case_::Raster& asked) {
  RasterSource source;
  source.cells = asked.cells;
  source.cell_size = asked.cell_size;
  source.boxes = asked.boxes;
  source.gap = asked.gap;
  source.origin = asked.origin;
  source.group = asked.group;
  source.single_tetrahedra = asked.single_tetrahedra;
  source.random_orientation = asked.random_orientation;
  source.seed = asked.seed;
  if (asked.slit) source.slit = RasterSource::Slit{asked.slit->lower, asked.slit->upper};
  return source;
}

GmshSource gmsh_source(const case_::Case& input) {
  const case_::MeshSource& asked = input.mesh;
  GmshSource source;
  if (!input.file.empty()) source.case_folder = input.file.has_parent_path() ? input.file.parent_path() : ".";
  source.file = asked.file;
  source.parameters = asked.parameters;
  source.scale = asked.scale;
  source.size = asked.size;
  source.glue = asked.glue;
  source.merge_nodes = asked.merge_nodes;
  for (const case_::Material& material : input.materials) source.materials.push_back(material.group);
  source.repair_inverted = asked.repair_inverted;
  source.trust = asked.trust;
  if (asked.time_limit > 0) source.time_limit = asked.time_limit;
  source.memory_limit = asked.memory_limit;
  return source;
}

double elements_of(const case_::Raster& raster) {
  double elements = raster.single_tetrahedra ? 1.0 : 24.0;
  for (std::size_t a = 0; a < 3; ++a) elements *= static_cast<double>(raster.cells[a]) * raster.boxes[a];
  return elements;
}

/// What is wrong with a raster stands in the case file.
FinishedMesh raster_of(const case_::Case& input) {
  const double elements = elements_of(*input.mesh.raster);
  demand_memory(input, elements, mesh_bytes(elements));
  try {
    return make_raster(raster_source(*input.mesh.raster));
  } catch (const InputError& error) {
    give_up_if_interrupted();  // then it is no fault of the case
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) {
      p.file = input.file.string();
      p.line = input.mesh.origin.line;
      if (p.key == "mesh") p.key = "mesh.raster";
    }
    throw InputError(std::move(problems));
  }
}

/// Entries for a group that the file has, and that nothing is in: they would do nothing.
void name_empty_groups(const MeshReport& report, std::vector<Problem>& problems) {
  const auto& empty = report.empty_groups;
  for (Problem& problem : problems)
    if (std::find(empty.begin(), empty.end(), problem.given) != empty.end())
      problem.what = "the group \"" + problem.given + "\" of the mesh holds no element, and no node of one";
}

/// Surfaces that are open when the run begins: those of the joints, and those that the first stage breaks.
std::vector<std::string> open_from_the_start(const case_::Case& input) {
  std::vector<std::string> surfaces = input.broken_surfaces;
  if (input.start || input.stages.empty()) return surfaces;
  const std::vector<std::string>& first = input.stages.front().broken_surfaces;
  surfaces.insert(surfaces.end(), first.begin(), first.end());
  return surfaces;
}

}  // namespace

FinishedMesh read_mesh(const case_::Case& input) {
  if (input.mesh.raster) return raster_of(input);
  FinishedMesh made = read_gmsh(gmsh_source(input));
  demand_memory(input, made.mesh.num_elements(), mesh_bytes(made.mesh.num_elements()));
  return made;
}

FinishedMesh build_mesh(const case_::Case& input) {
  FinishedMesh made = read_mesh(input);
  const std::vector<std::string> open = open_from_the_start(input);
  if (!open.empty()) {
    const Topology topology = build_topology(made.mesh);
    number_bodies(topology, faces_of_surfaces(made.mesh, topology, open), made.mesh);
    made.report.bodies = made.mesh.num_bodies;
  }
  std::vector<Problem> problems = case_::check_groups(
      input, {made.mesh.volume_groups, made.mesh.surface_groups, made.mesh.node_groups, made.mesh.element_sets},
      made.mesh.num_bodies);
  name_empty_groups(made.report, problems);
  for (Problem& problem : points_outside(input, made.mesh)) problems.push_back(std::move(problem));
  if (!problems.empty()) throw InputError(std::move(problems));
  return made;
}

}  // namespace breccia
