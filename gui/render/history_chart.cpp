#include "render/history_chart.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkCallbackCommand.h>
#include <vtkChartLegend.h>
#include <vtkContextActor.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "render/prefixed_unit.hpp"

namespace breccia::gui {
namespace {

using Colour = std::array<unsigned char, 3>;

constexpr std::array<Colour, 8> kColours{{{0, 114, 178},
                                          {213, 94, 0},
                                          {0, 158, 115},
                                          {204, 121, 167},
                                          {230, 159, 0},
                                          {86, 180, 233},
                                          {140, 140, 140},
                                          {200, 30, 30}}};
/// Distinguishes curves without colour.
constexpr std::array kPens{vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DASH_DOT_LINE, vtkPen::DOT_LINE};
/// Of the runs that are compared with.
constexpr std::array kMarks{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS,
                            vtkPlotPoints::PLUS};

const Colour& colour_of(int look) { return kColours[static_cast<std::size_t>(look) % kColours.size()]; }

/// Quantities of one colour have other dashes, as have those that follow each other.
int pen_of(int look) {
  const auto n = static_cast<std::size_t>(look);
  return kPens[(n + n / kColours.size()) % kPens.size()];
}

/// @param each  so many rows are left out between those that are taken, less one
vtkSmartPointer<vtkDoubleArray> column(const std::string& name, const std::vector<double>& values, double size,
                                       std::size_t each = 1) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  for (std::size_t i = 0; i < values.size(); i += each) array->InsertNextValue(values[i] / size);
  return array;
}

double largest(const std::vector<double>& values) {
  double found = 0;
  for (const double x : values)
    if (std::isfinite(x)) found = std::max(found, std::abs(x));
  return found;
}

bool is_drawn(const Curve& curve, const std::vector<double>& time) {
  return curve.values.size() == time.size() && time.size() >= 2;  // a line needs two points
}

}  // namespace

/// Units in which numbers are shown, in SI.
struct HistoryChart::Scale {
  double time = 1, value = 1;
};

HistoryChart::HistoryChart() {
  vtkNew<vtkContextActor> actor;
  scene_ = actor->GetScene();
  scene_->AddItem(chart_);
  scene_->SetRenderer(renderer_);
  renderer_->AddActor(actor);
  chart_->SetShowLegend(true);
  chart_->GetLegend()->SetInline(false);  // beside the curves, not over them
  chart_->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  chart_->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  chart_->SetBorders(20, 20, 16, 10);  // at the right: half of the last label
  vtkNew<vtkCallbackCommand> begin;
  begin->SetClientData(this);
  begin->SetCallback(
      [](vtkObject*, unsigned long, void* chart, void*) { static_cast<HistoryChart*>(chart)->begin_picture(); });
  begins_ = renderer_->AddObserver(vtkCommand::StartEvent, begin);
  set_dark(false);
}

HistoryChart::~HistoryChart() { renderer_->RemoveObserver(begins_); }

/// An axis to which title and legend leave no length gets NaN as its range, and VTK warns for each curve.
void HistoryChart::begin_picture() {
  constexpr int kWidth = 240, kHeight = 90;  // pixels
  const int* size = renderer_->GetSize();
  chart_->SetVisible(size[0] >= kWidth && size[1] >= kHeight);
}

void HistoryChart::add_line(const Curve& curve, const std::vector<double>& time, const Scale& scale) {
  constexpr float kOwn = 2, kOther = 1;  // pixels
  vtkNew<vtkTable> table;
  table->AddColumn(column("time", time, scale.time));
  table->AddColumn(column(curve.name, curve.values, scale.value));
  vtkPlot* line = chart_->AddPlot(vtkChart::LINE);
  line->SetInputData(table, 0, 1);
  const Colour& colour = colour_of(curve.look);
  line->SetColor(colour[0], colour[1], colour[2], 255);
  line->GetPen()->SetLineType(pen_of(curve.look));
  line->SetWidth(curve.other == 0 ? kOwn : kOther);
  line->SetLegendVisibility(curve.other == 0);
}

/// A few points of the curve of another run: marks on all of them would hide it.
/// @param is_named  it brings the name of its run into the legend
void HistoryChart::add_marks(const Curve& curve, const std::vector<double>& time, const Scale& scale, bool is_named) {
  constexpr std::size_t kMarksOfACurve = 12;
  const std::size_t each = std::max<std::size_t>(1, time.size() / kMarksOfACurve);
  vtkNew<vtkTable> table;
  table->AddColumn(column("time", time, scale.time, each));
  table->AddColumn(column(curve.run, curve.values, scale.value, each));
  auto* marks = vtkPlotPoints::SafeDownCast(chart_->AddPlot(vtkChart::POINTS));
  marks->SetInputData(table, 0, 1);
  const Colour& colour = colour_of(curve.look);
  marks->SetColor(colour[0], colour[1], colour[2], 255);
  marks->SetMarkerStyle(kMarks[static_cast<std::size_t>(curve.other - 1) % kMarks.size()]);
  marks->SetMarkerSize(8);
  marks->SetLegendVisibility(is_named);
}

void HistoryChart::show(const std::vector<double>& time, const std::vector<Curve>& curves, const std::string& quantity,
                        const std::string& unit) {
  chart_->ClearPlots();
  num_curves_ = 0;
  double end = 0, most = 0;
  for (const Curve& curve : curves) {
    end = std::max(end, largest(curve.time.empty() ? time : curve.time));
    most = std::max(most, largest(curve.values));
  }
  const PrefixedUnit of_time = prefixed_unit(end, "s"), of_values = prefixed_unit(most, unit);
  const Scale scale{of_time.size, of_values.size};
  chart_->GetAxis(vtkAxis::BOTTOM)->SetTitle("time [" + of_time.name + "]");
  chart_->GetAxis(vtkAxis::LEFT)->SetTitle(unit.empty() ? quantity : quantity + " [" + of_values.name + "]");
  std::set<int> named;
  for (const Curve& curve : curves) {
    const std::vector<double>& own = curve.time.empty() ? time : curve.time;
    if (!is_drawn(curve, own)) continue;
    add_line(curve, own, scale);
    if (curve.other > 0) add_marks(curve, own, scale, named.insert(curve.other).second);
    ++num_curves_;
  }
  chart_->RecalculateBounds();
}

void HistoryChart::set_dark(bool dark) {
  const double paper = dark ? 0.13 : 1.0, ink = dark ? 0.92 : 0.1;
  renderer_->SetBackground(paper, paper, paper);
  for (const int side : {vtkAxis::LEFT, vtkAxis::BOTTOM}) {
    vtkAxis* axis = chart_->GetAxis(side);
    axis->GetTitleProperties()->SetColor(ink, ink, ink);
    axis->GetTitleProperties()->SetBold(0);
    axis->GetTitleProperties()->SetFontSize(12);
    axis->GetLabelProperties()->SetColor(ink, ink, ink);
    axis->GetLabelProperties()->SetFontSize(11);
    axis->GetPen()->SetColorF(ink, ink, ink);
    axis->GetGridPen()->SetColorF(0.5, 0.5, 0.5, 0.3);
  }
  chart_->GetLegend()->GetLabelProperties()->SetColor(ink, ink, ink);
  chart_->GetLegend()->GetLabelProperties()->SetFontSize(11);
  chart_->GetLegend()->GetBrush()->SetColorF(paper, paper, paper, 0.8);
}

}  // namespace breccia::gui
