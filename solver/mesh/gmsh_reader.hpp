#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/finish.hpp"

namespace breccia {

/// A mesh file, or a geometry script or a solid that gmsh meshes.
struct GmshSource {
  std::filesystem::path file;  ///< of base/geometry_file.hpp: a script, a solid, a mesh of gmsh or of another program
  std::filesystem::path case_folder;  ///< files beneath it may be included, as those beneath the file's; empty: none
  std::map<std::string, double>
      parameters;          ///< numbers set before the .geo runs: names in DefineConstant or Exists, or with a `Name
                           ///< "Group/label"`
  double scale = 1.0;      ///< file units to m; beside the unit that a STEP file states
  double size = 0;         ///< m, edge of the elements of a solid; 0: a tenth of the root of its box's volume
  bool glue = false;       ///< conforming interfaces between volumes are glued
  double merge_nodes = 0;  ///< m, FinishOptions::merge_nodes
  std::vector<std::string> materials{};  ///< physical volumes that have one, where some overlap (material_groups.hpp)
  bool repair_inverted = true;           ///< swap two corners of negative elements; false refuses them
  bool trust = false;                    ///< the script may run programs and write files, as in gmsh itself
  double time_limit = 3600;              ///< s, wall, after which reading is given up
  double memory_limit = 0.8;             ///< share of this machine's memory that reading may take
};

/// Reads or makes the mesh and finishes it (mesh/finish.hpp).
///
/// Volume groups: the physical volumes by ascending tag, unnamed ones as "volume_<tag>", but for those that carry no
/// material where some overlap: these are element sets; tetrahedra outside them are left out and counted. Without any
/// physical volume every volume becomes a group "volume_<tag>". Surface groups: the physical surfaces, unnamed ones as
/// "surface_<tag>". Node groups: the physical curves and points, "curve_<tag>", "point_<tag>"; nodes of no element are
/// left out. Volumes are those of the geometry, by ascending tag: partitions of one are one. Element source ids are
/// gmsh's. A .geo is meshed on one thread, from gmsh's fixed random seed: the same file and parameters give the same
/// mesh; so is a solid; for its groups see mesh/gmsh/solids.hpp. A STEP file states the unit of its lengths.
///
/// The file is read by a child process without the right to run, write or connect to anything (system/confinement.hpp),
/// and to read anything outside the folders of the file and of the case (system/file_access.hpp, where the kernel has
/// Landlock), unless the source is trusted; and within the limits of time and memory, never more than the memory that
/// is available: any failure of the child ends in an InputError.
/// A file FILE.opt beside a mesh, which gmsh takes commands from, is refused unless the source is trusted.
///
/// Throws InputError with all problems of the step that fails: file missing, unreadable or of another kind; parameters
/// of anything but a .geo, unknown to it or not finite; a size of anything but a solid; errors gmsh reports, with file
/// and line where it names them; elements other than tetrahedra and triangles; a volume in two physical volumes
/// with a material; two groups of one name; some partitions of a mesh without the others; no tetrahedra; those of
/// finish_mesh; gmsh crashed, ended, passed a limit or tried what it may not.
/// @pre this process does not have gmsh open itself
[[nodiscard]] FinishedMesh read_gmsh(const GmshSource& source);

}  // namespace breccia
