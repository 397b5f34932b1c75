#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "detection/point_body/search.hpp"

namespace breccia::lab {

/// Contact points and tetrahedra, lengths in m.
struct Scene {
  std::string name;
  double buffer;
  std::vector<Vec3> points;
  std::vector<detection::Corners> contactors;
};

/// Made only when it is its turn.
using PointScene = std::function<Scene()>;

/// Four scenes of contact in a run, then up to `largest` (at most a million) tetrahedra of three mixtures of sizes,
/// numbered at random, and the same numbered along a curve through space.
std::vector<PointScene> point_scenes(std::size_t largest);

}  // namespace breccia::lab
