#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <thread>
#include <vector>

#include "render/frame_data.hpp"

/// How well elements are shaped, and how often. VTK only; everything here may be called from any thread.
namespace breccia::gui {

enum class ShapeMeasure {
  radius_ratio,  ///< 3 r_in / r_circumscribed: 1 for the regular tetrahedron, 0 for a flat one
  min_dihedral,  ///< smallest angle between two faces, degrees
  mean_edge      ///< mean of the six edges, mm
};

/// Bars of the same width. The radius ratio has those of the solver's report, from 0 to 1; others reach from the least
/// value to the largest.
struct Histogram {
  double low = 0, width = 0;
  std::vector<int> counts;
  [[nodiscard]] int bar_of(double value) const;
};

/// A number for each element of a frame, and their histogram.
struct ElementValues {
  std::vector<double> values;  ///< by row
  Histogram bars;
  std::thread::id counted_by;
};

/// @param elements  four points an element; nullptr: none. O(elements)
[[nodiscard]] ElementValues measure_shapes(vtkUnstructuredGrid* elements, ShapeMeasure measure);

/// What is seen of the elements of one bar. O(elements)
[[nodiscard]] vtkSmartPointer<vtkPolyData> elements_of_bar(const FrameData& frame, const ElementValues& of, int bar);

}  // namespace breccia::gui
