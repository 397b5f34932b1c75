#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// Checks between the keys of a case that single rows of the schema cannot express: groups that need a material or a
/// joint law, duplicates, exclusive choices, order of stages, files that exist. Problems carry the key; file and line
/// are those of the section. Values that were never given (empty text, zero where the range excludes it) are not
/// reported again.
/// @param needs_mesh_file  false: the elements are those of a checkpoint; the mesh file may be missing
[[nodiscard]] std::vector<Problem> validate(const Case& c, bool needs_mesh_file = true);

/// Names of the groups of a mesh, as Mesh has them.
struct GroupNames {
  std::span<const std::string> volumes, surfaces, nodes = {}, sets = {};
};

/// Compares the groups a case names with those of its mesh, and the volumes of the mesh with the materials. Each
/// problem names the group absent and lists those present, nearest first, with the line of the section that names it.
/// @param num_bodies  of the mesh, for gauges of bodies
[[nodiscard]] std::vector<Problem> check_groups(const Case& c, const GroupNames& groups, std::int64_t num_bodies = 0);

}  // namespace breccia::case_
