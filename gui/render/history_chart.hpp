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
  int look = 0;                   ///< of its quantity: colour and dash, the same in every picture
  int other = 0;                  ///< number of its run, shown by marks; 0: the run in view
  std::string run = {};           ///< its name, which stands in the legend once; empty: the run in view
  std::vector<double> time = {};  ///< s, its own; empty: that of the others
};

/// A chart over simulated time with a legend; axes carry name and unit.
class HistoryChart {
 public:
  HistoryChart();
  ~HistoryChart();
  HistoryChart(const HistoryChart&) = delete;
  HistoryChart& operator=(const HistoryChart&) = delete;
  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  /// Replaces all curves. @param time  s;  @param quantity, unit  of the values, which are shown with a prefix
  void show(const std::vector<double>& time, const std::vector<Curve>& curves, const std::string& quantity,
            const std::string& unit);
  /// To be called once it was drawn in another size: axes that had no room there have lost their range.
  void renew_range() { chart_->RecalculateBounds(); }
  void set_dark(bool dark);
  [[nodiscard]] std::size_t num_curves() const { return num_curves_; }

 private:
  struct Scale;
  void begin_picture();
  void add_line(const Curve& curve, const std::vector<double>& time, const Scale& scale);
  void add_marks(const Curve& curve, const std::vector<double>& time, const Scale& scale, bool is_named);

  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkContextScene> scene_;
  vtkNew<vtkChartXY> chart_;
  std::size_t num_curves_ = 0;
  unsigned long begins_ = 0;  ///< observer of pictures that begin
};

}  // namespace breccia::gui
