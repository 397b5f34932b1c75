#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "detection/equal_size/cell.hpp"
#include "generator.hpp"

namespace breccia::lab {

using Coordinate = std::int32_t;
using BodyCell = detection::Cell<3, Coordinate>;
using Cells = std::vector<BodyCell>;

/// Experiments I to VI of [Schiava, 7.2]: where the bodies stand at first, and along how many axes they move.
///   I    full raster, one body a cell, z fastest           II   raster of 100^3 bodies, every `spacing`-th cell
///   III  random in a cube of side 3 j, j = N^(1/3)          IV   all in one cell, at rest
///   V    random on a line, 4 bodies a cell                  VI   random on a plane, 1 body in 3 cells
/// Rasters and III round N to a cube j^3. The equal seeds printed for VI give distinct coordinates: see Generator.
class Placement {
 public:
  /// @throws std::invalid_argument for an experiment that is none of these.
  Placement(const std::string& experiment, std::size_t n, int spacing);

  const Cells& cells() const { return cells_; }

  /// Every moving coordinate stays or grows by one, [Schiava, eq. (7.8)]. The printed seeds -i - 1 - 10 t hold the
  /// body's own coordinate; taken for each body, all bodies of a layer would move as one, so they are those of the
  /// first body.
  void move();

 private:
  void raster(std::size_t edge, int spacing);
  void random(std::size_t n, const std::vector<std::int64_t>& seeds, double side);

  Generator generator_;
  Cells cells_;
  std::size_t num_moving_axes_ = 3;
  std::int64_t start_ = -1;
};

}  // namespace breccia::lab
