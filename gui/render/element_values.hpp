#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "render/element_quantity.hpp"
#include "render/frame_data.hpp"

/// Numbers of the elements and joints of a frame, and how often they occur. VTK only; everything here may be called
/// from any thread.
namespace breccia::gui {

enum class Measure {
  radius_ratio,    ///< 3 r_in / r_circumscribed: 1 for the regular tetrahedron, 0 for a flat one
  min_dihedral,    ///< smallest angle between two faces, degrees
  mean_edge,       ///< mean of the six edges, mm
  first_quantity,  ///< those from here to `opening` are made by measure_of
  opening = first_quantity + kNumQuantities,  ///< of damaged joints, um
  slip,                                       ///< of damaged joints, um
  damage                                      ///< of damaged joints
};

/// With their names for people, units among them.
[[nodiscard]] const std::vector<std::pair<Measure, std::string>>& measures();
[[nodiscard]] Measure measure_of(Quantity quantity);
/// Whether it is of the damaged joints; else it is of the elements.
[[nodiscard]] bool is_of_joints(Measure measure);

/// Bars of the same width. Those of the radius ratio are those of the solver's report, from 0 to 1, those of the damage
/// reach from 0 to 1 as well; others reach from the least value to the largest.
struct Histogram {
  double low = 0, width = 0;
  std::vector<int> counts;
  [[nodiscard]] int bar_of(double value) const;
};

struct ElementValues {
  Measure measure = Measure::radius_ratio;
  std::vector<double> values;  ///< by row of the elements or joints; empty: not in the frame
  Histogram bars;
  std::thread::id counted_by;
};

/// O(elements)
[[nodiscard]] ElementValues values_of(const FrameData& frame, Measure measure);

/// What is seen of the elements or joints of one bar. O(elements)
[[nodiscard]] vtkSmartPointer<vtkPolyData> faces_of_bar(const FrameData& frame, const ElementValues& of, int bar);

}  // namespace breccia::gui
