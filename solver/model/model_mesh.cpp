#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "case/problem_at.hpp"
#include "case/validate.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/raster.hpp"
#include "model/model.hpp"

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

GmshSource gmsh_source(const case_::MeshSource& asked) {
  GmshSource source;
  source.file = asked.file;
  source.parameters = asked.parameters;
  source.scale = asked.scale;
  source.size = asked.size;
  source.glue = asked.glue;
  source.repair_inverted = asked.repair_inverted;
  source.trust = asked.trust;
  source.time_limit = asked.time_limit;
  source.memory_limit = asked.memory_limit;
  return source;
}

/// What is wrong with a raster stands in the case file.
FinishedMesh raster_of(const case_::Case& input) {
  try {
    return make_raster(raster_source(*input.mesh.raster));
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) {
      p.file = input.file.string();
      p.line = input.mesh.origin.line;
      if (p.key == "mesh") p.key = "mesh.raster";
    }
    throw InputError(std::move(problems));
  }
}

/// Constraints and forces on what has no node: they would do nothing.
std::vector<Problem> conditions_of_nothing(const case_::Case& input, const MeshReport& report) {
  const auto is_empty = [&](const std::string& name) {
    for (const auto* groups : {&report.volume_groups, &report.surface_groups, &report.node_groups}) {
      const auto found = std::find_if(groups->begin(), groups->end(), [&](const auto& g) { return g.name == name; });
      if (found != groups->end()) return found->count == 0;  // the first that has the name is meant
    }
    return false;
  };
  std::vector<Problem> problems;
  const auto demand = [&](const auto& entry) {
    if (!is_empty(entry.group)) return;
    problems.push_back(case_::problem_at(input, entry.origin, "group", "this group holds no node of any element",
                                         "a group with nodes of meshed physical volumes", entry.group));
  };
  for (const case_::Stage& stage : input.stages) {
    for (const case_::Constraint& entry : stage.constraints) demand(entry);
    for (const case_::Force& entry : stage.forces) demand(entry);
  }
  return problems;
}

}  // namespace

FinishedMesh read_mesh(const case_::Case& input) {
  return input.mesh.raster ? raster_of(input) : read_gmsh(gmsh_source(input.mesh));
}

FinishedMesh build_mesh(const case_::Case& input) {
  FinishedMesh made = read_mesh(input);
  std::vector<Problem> problems = case_::check_groups(
      input, {made.mesh.volume_groups, made.mesh.surface_groups, made.mesh.node_groups}, made.mesh.num_bodies);
  if (problems.empty()) problems = conditions_of_nothing(input, made.report);
  if (!problems.empty()) throw InputError(std::move(problems));
  return made;
}

}  // namespace breccia
