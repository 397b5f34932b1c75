#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace breccia {

/// The element that holds a point.
struct HoldingElement {
  Index element = -1;               ///< of the mesh; -1: none
  std::array<double, 4> weights{};  ///< of its corners: barycentric coordinates
};

/// A point that is outside by less than this share of the heights of an element counts as within.
inline constexpr double kOutside = 1e-6;

/// The element of each point, m; of several that meet there, the one with the lowest id. The same bits for any piece of
/// a mesh with the element. O(elements log points)
[[nodiscard]] std::vector<HoldingElement> holding_elements(const Mesh& mesh, std::span<const Vec3> points);

}  // namespace breccia
