#pragma once

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <string>

#include "catalyst/channel_names.hpp"
#include "catalyst/insitu_abi.h"
#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {

/// An instant as VTK data: null if a channel was not requested. A channel has the same arrays, by name, type and
/// components, on all ranks; elements and domains are vtkUnstructuredGrid, history is vtkTable, the others vtkPolyData.
struct Frame {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  std::array<vtkSmartPointer<vtkDataObject>, BRECCIA_NUM_CHANNELS> channels{};
};

/// Processes the frames of a run. Members are collective unless stated otherwise.
class Pipeline {
 public:
  Pipeline() = default;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;
  virtual ~Pipeline() = default;

  /// Mask of the channels that it wants now, the same on all ranks; 0: nothing to do. Throws PipelineError.
  virtual std::uint32_t channels(std::int64_t step, double time) = 0;

  /// Processes a frame that has all its channels. Its requests to the solver are added to `requests`.
  /// It may throw PipelineError on some ranks only, but not between its own collective operations.
  virtual void execute(const Frame& frame, BrecciaRequests& requests) = 0;

  /// Notices since the last call that are no failures, the same on all ranks: lines that end with a newline, warnings
  /// with "warning: " in front; mostly "". Also called once after finish().
  [[nodiscard]] virtual std::string notice() { return {}; }

  /// Bytes written on this rank. Not collective.
  [[nodiscard]] virtual std::int64_t bytes_written() const { return 0; }

  /// Whether there may be pictures in its folder. Not collective.
  [[nodiscard]] virtual bool draws() const { return false; }

  /// Ends it; but for its notices it is not used any more.
  virtual void finish() {}
};

}  // namespace breccia::insitu
