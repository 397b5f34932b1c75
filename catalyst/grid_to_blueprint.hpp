#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalyst/conduit.hpp"
#include "catalyst/insitu_abi.h"

namespace breccia::insitu {

/// Turns channels of the solver into meshes of the Conduit Mesh Blueprint, each rank's part a domain. Points, corners
/// and arrays are views of the solver's memory: pointer, count, offset and stride. A channel whose cells have their own
/// points in turn has no corners: then they are 0, 1, 2, ..., of which there is one array for all channels.
/// A table becomes points at the origin, a row each, with the columns as their fields.
class GridToBlueprint {
 public:
  /// Fills the mesh `data`. What it points to must stay until the tree is out of use; the corners of the next calls
  /// may lie elsewhere, so keep this object, and do not make the next tree before the last one is out of use.
  /// Throws PipelineError when the channel is not as defined in insitu_abi.h. O(num_arrays), mostly.
  void fill(const ConduitFunctions& conduit, ConduitNode* data, const BrecciaGrid& grid, int rank, std::int64_t step,
            double time);

  /// Makes room for the corners of a grid without any, for all of a tree before the first fill.
  void reserve(const BrecciaGrid& grid);

 private:
  std::vector<std::int32_t> in_turn_;
  std::vector<double> origin_;
};

/// What a channel is like on a rank without cells: kind of cell, names, types and components of the arrays.
class EmptyGrid {
 public:
  explicit EmptyGrid(const BrecciaGrid& like);
  EmptyGrid(const EmptyGrid&) = delete;
  EmptyGrid& operator=(const EmptyGrid&) = delete;
  [[nodiscard]] BrecciaGrid grid() const;

 private:
  std::int32_t cell_;
  std::vector<std::string> names_;
  std::vector<BrecciaArray> arrays_;
};

}  // namespace breccia::insitu
