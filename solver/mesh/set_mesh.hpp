#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh_bytes.hpp"

namespace breccia {

/// A mesh as programs for finite elements write it: elements of several shapes, and sets of nodes, elements and faces.
struct SetMesh {
  struct Element {
    std::int64_t label;  ///< in the file
    int corners;         ///< 4: tetrahedron, 3: triangle, 2: line
    std::array<Index, 4> nodes;
  };
  struct Set {
    std::string name;
    std::vector<Index> elements, nodes;
    std::vector<std::array<Index, 3>> faces;  ///< corners
    bool material = false;                    ///< the file gives its elements a material
  };
  std::vector<Vec3> nodes;  ///< in the unit of the file
  std::vector<Element> elements;
  std::vector<Set> sets;
  bool higher_order = false;       ///< elements had nodes between their corners
  std::vector<std::string> notes;  ///< of MeshReport
};

/// The tetrahedra as bodies, the sets as groups. Volume groups: the sets with tetrahedra that have a material, then the
/// others in their order, each where none of its tetrahedra is in a group before it; of sets with the same tetrahedra
/// the last one; a set that overlaps a group is a node group. Tetrahedra of no set are the group "rest", or "volume_1"
/// where no set has any. Triangles and faces of a set are a surface group, its lines and nodes a node group. Sets of
/// one name are one group of a kind. A body is what shares nodes within a group. Triangles and lines that no set names
/// are left out.
/// @param scale  of the file's unit, m.  O(n log n). @pre indices are valid
[[nodiscard]] RawMesh raw_mesh(const SetMesh& mesh, const std::filesystem::path& file, double scale);

}  // namespace breccia
