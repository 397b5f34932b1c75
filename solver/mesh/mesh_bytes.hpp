#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// A mesh as read, before finish_mesh, on its way from the process that reads it.
struct RawMesh {
  Mesh mesh;
  Index ungrouped_elements = 0;    ///< tetrahedra outside every physical volume, left out
  std::vector<std::string> notes;  ///< MeshReport::notes
};

/// Note on elements with nodes between their corners.
inline constexpr const char* kHigherOrderNote =
    "elements of second or higher order are read by their corners: mid-side nodes are ignored, mass and volume are "
    "those of straight edges";

/// A mesh, or why there is none.
using MeshOrProblems = std::variant<RawMesh, std::vector<Problem>>;

[[nodiscard]] std::vector<std::byte> bytes_of(const MeshOrProblems& read);

/// The reverse of bytes_of. The sender is not trusted: every length is checked against the size before memory is
/// allocated, and every index against its list.
/// Throws InputError when the bytes are anything but a whole mesh or a whole list of problems. O(bytes).
[[nodiscard]] MeshOrProblems mesh_of(std::span<const std::byte> bytes);

}  // namespace breccia
