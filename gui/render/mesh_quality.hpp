#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <string>
#include <vector>

/// Shapes of the elements of a mesh at rest, to be seen. VTK only.
namespace breccia::gui {

enum class ShapeMeasure {
  radius_ratio,  ///< 3 r_in / r_circumscribed: 1 for the regular tetrahedron, 0 for a flat one
  min_dihedral,  ///< smallest angle between two faces, degrees
  mean_edge      ///< mean of the six edges, mm
};

struct MeshShapes {
  vtkSmartPointer<vtkUnstructuredGrid> elements;  ///< nullptr: the file cannot be read
  /// By measure and element.
  std::array<std::vector<double>, 3> values;
  [[nodiscard]] const std::vector<double>& of(ShapeMeasure measure) const {
    return values[static_cast<std::size_t>(measure)];
  }
};

/// @param file  VTKHDF, four points an element. O(elements)
[[nodiscard]] MeshShapes measure_shapes(const std::string& file);
[[nodiscard]] MeshShapes measure_shapes(const vtkSmartPointer<vtkUnstructuredGrid>& elements);

/// Bars of the same width. The radius ratio has those of the solver's report, from 0 to 1; others reach from the least
/// value to the largest.
struct Histogram {
  double low = 0, width = 0;
  std::vector<int> counts;
  [[nodiscard]] int bar_of(double value) const;
};
[[nodiscard]] Histogram histogram_of(const MeshShapes& shapes, ShapeMeasure measure);

/// All faces of the elements of one bar. O(elements)
[[nodiscard]] vtkSmartPointer<vtkPolyData> elements_of_bar(const MeshShapes& shapes, ShapeMeasure measure, int bar);

}  // namespace breccia::gui
