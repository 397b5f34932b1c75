#pragma once

#include <vtkCellArray.h>
#include <vtkUnsignedCharArray.h>

#include "catalyst/pipeline.hpp"

namespace breccia::insitu {

/// Turns a channel of the solver into a VTK object without copying points or arrays, which are wrapped. Connectivity is
/// VTK's own and is kept: it is built anew only when BrecciaGrid::topology, the kind of cell or a count has changed.
class ChannelToVtk {
 public:
  /// The object reads the solver's memory: it must be out of use when that memory may change. Field data: TimeValue (s)
  /// and step. Throws PipelineError when the channel is not as defined in insitu_abi.h. O(num_arrays); O(num_cells)
  /// when the topology has changed.
  [[nodiscard]] vtkSmartPointer<vtkDataObject> wrap(const BrecciaGrid& grid, std::int64_t step, double time);

  /// Connectivity of the last wrap; null before the first and for tables.
  [[nodiscard]] vtkCellArray* cells() const { return cells_; }

 private:
  void update_connectivity(const BrecciaGrid& grid);

  vtkSmartPointer<vtkCellArray> cells_;
  vtkSmartPointer<vtkUnsignedCharArray> cell_types_;  ///< of an unstructured grid
  std::int32_t cell_ = -1;
  std::int64_t num_cells_ = -1;
  std::int64_t num_points_ = -1;
  std::uint64_t topology_ = 0;
};

/// One ChannelToVtk a channel.
class FrameToVtk {
 public:
  /// Channels that the instant has not are null. Throws PipelineError naming the channel.
  [[nodiscard]] Frame wrap(const BrecciaInstant& instant);
  [[nodiscard]] const ChannelToVtk& channel(int index) const { return channels_.at(static_cast<std::size_t>(index)); }

 private:
  std::array<ChannelToVtk, BRECCIA_NUM_CHANNELS> channels_;
};

/// A new object of the same class with the same arrays, all empty.
[[nodiscard]] vtkSmartPointer<vtkDataObject> empty_like(vtkDataObject* object);

/// Sets the field data TimeValue and step.
void set_instant(vtkDataObject* object, std::int64_t step, double time);

}  // namespace breccia::insitu
