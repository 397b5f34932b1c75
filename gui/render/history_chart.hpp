#pragma once

#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace breccia::gui {

/// One curve over time.
struct Curve {
  std::string name;
  std::vector<double> values;
  std::vector<double> time = {};  ///< s, its own; empty: that of the others
};

/// A chart over simulated time with a legend; axes carry name and unit.
class HistoryChart {
 public:
  HistoryChart();
  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  /// Replaces all curves. @param time  s
  void show(const std::vector<double>& time, const std::vector<Curve>& curves, const std::string& value_axis);
  void set_dark(bool dark);
  [[nodiscard]] vtkIdType num_curves() const { return chart_->GetNumberOfPlots(); }

 private:
  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkContextScene> scene_;
  vtkNew<vtkChartXY> chart_;
};

}  // namespace breccia::gui
